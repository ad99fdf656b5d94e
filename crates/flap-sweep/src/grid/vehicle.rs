//! The section `[vehicle]`: wings, their places, and what differs between them.

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::Simulator as _;
use flap_core::vehicle::{Mount, Vehicle, VehicleError};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::device::{Base, Reader};
use super::lookup::Lookup;
use super::problems::Problems;
use super::table::{self, Entry};
use super::{uncertainty, value};
use crate::plan::Value;
use crate::resonance::DRIVE_FREQUENCY;

pub(super) const KEYS: [&str; 3] = ["about", "total_mass", "wings"];
pub(super) const WING_KEYS: [&str; 7] =
    ["name", "mirrored", "position", "plane", "preset", "device", "params"];
pub(super) const PLANE_KEYS: [&str; 3] = ["roll", "pitch", "yaw"];

/// The axes of the body, last parts of names of parameters.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Makes a vehicle of the design `base` if the section is there. `None`, with a report, if it cannot be made.
pub(super) fn read(
    root: &[Entry<'_>],
    base: Base,
    reader: Reader<'_>,
    problems: &mut Problems,
) -> Option<Base> {
    let Some(section) = table::find(root, "vehicle") else { return Some(base) };
    let entries = table::section(section, problems);
    table::check_keys(&entries, &KEYS, "in [vehicle]", problems);
    let wings = wings(section, &entries, problems)?;
    let mounts: Option<Vec<Mount>> = wings.iter().map(|wing| mount(wing, problems)).collect();
    let vehicle = match Vehicle::of(base.simulator, &mounts?) {
        Ok(vehicle) => vehicle,
        Err(error) => {
            report(&error, section, &wings, problems);
            return None;
        }
    };
    let shared = base.values.len();
    let mut own =
        Own { vehicle, sets_frequency: sets_frequency(root), shared: base, problems, models: reader };
    let of_vehicle = |parameter: &Parameter| match parameter.kind {
        Kind::Following(_, follows) if parameter.default.is_nan() => Value::Follows(follows),
        _ => Value::Given(parameter.default),
    };
    own.shared.values.extend(vehicle.parameters()[shared..].iter().map(of_vehicle));
    if let Some(entry) = table::find(&entries, "about") {
        own.vector(entry, |axis| format!("about_{axis}"));
    }
    if let Some(entry) = table::find(&entries, "total_mass") {
        own.number("total_mass", entry);
    }
    for (index, wing) in wings.iter().enumerate() {
        own.wing(index, wing);
    }
    Some(Base { simulator: vehicle, vehicle: Some(vehicle), ..own.shared })
}

/// A wing's table, and its entries.
type WingTable<'t> = (&'t Spanned<DeValue<'t>>, Vec<Entry<'t>>);

/// The tables of the wings.
fn wings<'t>(
    section: &Entry<'t>,
    entries: &[Entry<'t>],
    problems: &mut Problems,
) -> Option<Vec<WingTable<'t>>> {
    const HELP: &str = "write [[vehicle.wings]] above the keys of each wing, such as name = \"left\"";
    let Some(entry) = table::find(entries, "wings") else {
        problems.report(section.key_span.clone(), "a vehicle has one wing or more").help(HELP);
        return None;
    };
    let tables: Option<Vec<(&Spanned<DeValue<'t>>, &DeTable<'t>)>> =
        entry.value.get_ref().as_array().and_then(|list| {
            list.iter().map(|item| item.get_ref().as_table().map(|table| (item, table))).collect()
        });
    let Some(tables) = tables.filter(|tables| !tables.is_empty()) else {
        problems.report(entry.value.span(), "`wings` must be a list of tables, one for each wing").help(HELP);
        return None;
    };
    let mut wings = Vec::new();
    for (item, table) in tables {
        let entries = table::entries(table);
        table::check_keys(&entries, &WING_KEYS, "in [[vehicle.wings]]", problems);
        wings.push((item, entries));
    }
    Some(wings)
}

/// Name and side of a wing.
fn mount((item, entries): &WingTable<'_>, problems: &mut Problems) -> Option<Mount> {
    let Some(name) = table::find(entries, "name") else {
        problems.report(item.span(), "the wing has no `name`").help("write name = \"left\"");
        return None;
    };
    let name = value::text("name", name.value, problems)?.to_owned();
    let mirrored = match table::find(entries, "mirrored") {
        None => false,
        Some(entry) => {
            let mirrored = entry.value.get_ref().as_bool();
            if mirrored.is_none() {
                problems
                    .report(entry.value.span(), "`mirrored` must be true or false")
                    .note("a mirrored wing is the image of the one at its position, behind the plane of x and z")
                    .help("there is no other plane: write mirrored = true for a wing on the right");
            }
            mirrored?
        }
    };
    Some(Mount { name, mirrored })
}

/// Reports a vehicle that cannot be made, at the wing concerned.
fn report(error: &VehicleError, section: &Entry<'_>, wings: &[WingTable<'_>], problems: &mut Problems) {
    let wanted = match error {
        VehicleError::Name(name) | VehicleError::SameName(name) => Some(name),
        VehicleError::Clash { wing, .. } => Some(wing),
        VehicleError::NoWings | VehicleError::ManyWings(_) | VehicleError::NoLoads(_) => None,
    };
    let names = wings.iter().filter_map(|(_, entries)| table::find(entries, "name"));
    let place = names.rev().find(|name| name.value.get_ref().as_str() == wanted.map(String::as_str));
    let span = place.map_or(section.key_span.clone(), |name| name.value.span());
    problems.report(span, error.to_string());
}

/// True if the grid sets or varies the drive frequency of all wings.
fn sets_frequency(root: &[Entry<'_>]) -> bool {
    ["params", "axes", "derived"].iter().any(|section| {
        let section = table::find(root, section).and_then(|entry| entry.value.get_ref().as_table());
        section.is_some_and(|table| table.contains_key(DRIVE_FREQUENCY))
    })
}

/// The values of a vehicle, in which those of its wings are put.
struct Own<'o> {
    vehicle: &'static Vehicle,
    sets_frequency: bool,
    /// The design of all wings, with the values of the vehicle.
    shared: Base,
    problems: &'o mut Problems,
    models: Reader<'o>,
}

impl Own<'_> {
    /// A parameter of the vehicle.
    fn number(&mut self, name: &str, entry: &Entry<'_>) {
        let parameters = self.vehicle.parameters();
        let Some(index) = Parameter::index(parameters, name) else { return };
        let (value, error) = uncertainty::of_parameter(&parameters[index], entry, self.problems);
        if let Some(value) = value {
            self.shared.values[index] = Value::Given(value);
        }
        self.shared.uncertainty.set(index, error);
    }

    /// Three lengths along the axes of the body.
    fn vector(&mut self, entry: &Entry<'_>, name: impl Fn(&str) -> String) {
        let list = entry.value.get_ref().as_array().filter(|list| list.len() == 3);
        let Some(list) = list else {
            self.problems
                .report(entry.value.span(), format!("`{}` must be a list of three lengths", entry.key))
                .note("along x, forward; y, to the left; and z, upwards")
                .help(format!("write {} = [\"0 mm\", \"4 mm\", \"0 mm\"]", entry.key));
            return;
        };
        for (axis, item) in AXES.into_iter().zip(list) {
            let part = Entry { key: entry.key, key_span: entry.key_span.clone(), value: item };
            self.number(&name(axis), &part);
        }
    }

    /// Place, design and parameters of a wing.
    fn wing(&mut self, index: usize, (_, entries): &WingTable<'_>) {
        let name = &self.vehicle.mounts()[index].name;
        if let Some(entry) = table::find(entries, "position") {
            self.vector(entry, |axis| format!("{name}_position_{axis}"));
        }
        if let Some(entry) = table::find(entries, "plane") {
            let angles = table::section(entry, self.problems);
            if table::check_keys(&angles, &PLANE_KEYS, "in the plane of a wing", self.problems) {
                for angle in &angles {
                    self.number(&format!("{name}_plane_{}", angle.key), angle);
                }
            }
        }
        if table::find(entries, "preset").is_some() || table::find(entries, "device").is_some() {
            self.design(index, entries);
        }
        if let Some(entry) = table::find(entries, "params") {
            for entry in table::section(entry, self.problems) {
                self.own_parameter(index, &entry);
            }
        }
    }

    /// The preset or the device of a wing: its numbers that differ from those of all wings.
    fn design(&mut self, index: usize, entries: &[Entry<'_>]) {
        let Some(begin) = table::find(entries, "preset").or_else(|| table::find(entries, "device")) else {
            return;
        };
        let span = begin.value.span();
        let Some(design) = self.models.base(entries, self.problems) else { return };
        let (model, name) = (self.vehicle.model(), &self.vehicle.mounts()[index].name);
        if design.simulator.name() != model.name() {
            let message = format!(
                "the wing `{name}` is of the model {}, the vehicle of the model {}",
                design.simulator.name(),
                model.name()
            );
            self.problems
                .report(span, message)
                .help("the wings of a vehicle are of one model: choose a preset of it");
            return;
        }
        for (place, parameter) in model.parameters().iter().enumerate() {
            let (own, shared) = (design.values[place], self.shared.values[place]);
            if own == shared {
                continue;
            }
            if Vehicle::may_differ(parameter) {
                if let (Value::Given(_), Some(target)) =
                    (own, self.vehicle.own_parameter(index, parameter.name))
                {
                    self.shared.values[target] = own;
                    self.shared.uncertainty.set(target, design.uncertainty.error(place));
                }
            } else if parameter.name != DRIVE_FREQUENCY {
                let message = format!("the wing `{name}` has another `{}` than the vehicle", parameter.name);
                let help = "choices are the same for all wings of a vehicle";
                self.problems.report(span.clone(), message).help(help);
            } else if !self.sets_frequency {
                let shown = |value: Value| value.given().map_or_else(String::new, value::shown);
                let message = format!(
                    "the wing `{name}` flaps at {} Hz, the vehicle at {} Hz",
                    shown(own),
                    shown(shared)
                );
                let help = "the wings of a vehicle have one frequency: set drive_frequency under [params]";
                self.problems.report(span.clone(), message).help(help);
            }
        }
        self.shared.devices.extend(design.devices);
    }

    /// A parameter that a wing has of its own.
    fn own_parameter(&mut self, index: usize, entry: &Entry<'_>) {
        let model = self.vehicle.model();
        let mut lookup = Lookup { simulator: model, models: self.models.models, problems: self.problems };
        let Some((_, parameter)) = lookup.parameter(entry) else { return };
        let Some(target) = self.vehicle.own_parameter(index, parameter.name) else {
            let what = if parameter.name == DRIVE_FREQUENCY { "one frequency" } else { "the same choices" };
            self.problems
                .report(entry.key_span.clone(), format!("`{}` cannot differ between wings", parameter.name))
                .help(format!("the wings of a vehicle have {what}: set it under [params] of the grid file"));
            return;
        };
        let name = self.vehicle.parameters()[target].name;
        self.number(name, entry);
    }
}
