//! Reads the section `[vehicle]`: the wings of a vehicle, their positions, and the differences between the
//! wings.

use std::ops::Range;

use std::sync::Arc;

use flap_core::body::BodyParameters;
use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::Simulator as _;
use flap_core::vehicle::{MOST_WINGS, Mount, Vehicle, VehicleError};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::device::{Base, Reader};
use super::diagnostic::Problems;
use super::lookup::Lookup;
use super::table::{self, Entry};
use super::{uncertainty, value};
use crate::plan::uncertainty::Correlation;
use crate::plan::{Robot, Value};
use crate::resonance::DRIVE_FREQUENCY;
use crate::vehicle::BodyRows;
use crate::vehicle::control::Input;

pub(super) const KEYS: [&str; 10] = [
    "about",
    "damping",
    "trim",
    "total_mass",
    "body_inertia_roll",
    "body_inertia_pitch",
    "body_inertia_yaw",
    "body_inertia_product",
    "gravity",
    "wings",
];
pub(super) const WING_KEYS: [&str; 7] =
    ["name", "mirrored", "position", "plane", "preset", "device", "params"];
pub(super) const PLANE_KEYS: [&str; 3] = ["roll", "pitch", "yaw"];

/// Names of the body axes, which are the last parts of parameter names such as `about_x`.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The only allowed value of the key `trim`, for rows at hover.
pub(super) const HOVER: &str = "hover";

/// Name of the group of drive parameters, in the list of parameters of a model. If a wing has its own design,
/// the drive parameters of this design are ignored.
const DRIVE: &str = "drive";

/// Contents of the section `[vehicle]` that are necessary for reading the other sections of a grid file.
#[derive(Default)]
pub(super) struct VehicleSettings {
    /// Parameters that the section `[vehicle]` sets, with the positions of their keys in the file.
    pub(super) set: Vec<(usize, Range<usize>)>,
    /// Position of the key `damping`, if the rows contain the damping matrix.
    damping: Option<Range<usize>>,
    /// Position of the key `trim`, if the rows are computed at hover.
    trim: Option<Range<usize>>,
    /// Messages about wings whose design has a different drive frequency from the vehicle, each with a
    /// position in the file.
    frequencies: Vec<(Range<usize>, String)>,
}

/// Name of the parameter for the mass of the vehicle, which determines the lift at hover.
const TOTAL_MASS: &str = "total_mass";

impl VehicleSettings {
    /// Adds the messages about drive frequencies that `other` contains. `other` is the result of reading the
    /// section `[vehicle]` for a different design.
    pub(super) fn append(&mut self, other: VehicleSettings) {
        self.frequencies.extend(other.frequencies);
    }

    /// If the section `[vehicle]` requests rows at hover or with the damping matrix, returns the object that
    /// computes these rows.
    ///
    /// `is_set` returns true for a parameter with a value. `varied` contains the parameters of axes, and
    /// `derived` contains the parameters that formulas determine.
    pub(super) fn body_rows(
        &self,
        base: &Base,
        is_set: impl Fn(usize) -> bool,
        varied: &[usize],
        derived: &[usize],
        problems: &mut Problems,
    ) -> Option<BodyRows> {
        let asked = self.trim.as_ref().or(self.damping.as_ref())?;
        let Some(vehicle) = base.robot.vehicle().filter(|_| !base.robot.has_designs()) else {
            problems
                .report(asked.clone(), "rows at hover, and rows with the damping matrix, are for one design")
                .help("write a grid file for each device");
            return None;
        };
        let index = |name: &str| Parameter::index(vehicle.parameters(), name);
        if index(BodyParameters::MOTION[0]).is_none() {
            problems
                .report(asked.clone(), format!("the model {} has no motion of the body", vehicle.name()))
                .help("remove damping and trim, or choose a preset of another model");
            return None;
        }
        let inputs = self.trim.as_ref().map(|trim| {
            if !index(TOTAL_MASS).is_some_and(is_set) {
                problems
                    .report(trim.clone(), "rows at hover require total_mass")
                    .help("write total_mass = \"85 mg\" in [vehicle]");
            }
            let values: Vec<f64> = base.values.iter().map(|value| value.in_point()).collect();
            let inputs = Input::usual(vehicle, &values);
            let kinds = [(varied, "varies", "the section of its axis"), (derived, "is derived", "[derived]")];
            for (of_kind, verb, section) in kinds {
                for input in inputs.iter().filter(|input| of_kind.contains(&input.parameter)) {
                    let name = vehicle.parameters()[input.parameter].name;
                    problems
                        .report(trim.clone(), format!("the search for hover changes {name}, which {verb}"))
                        .help(format!("remove {name} from {section}"));
                }
            }
            inputs
        });
        Some(BodyRows::new(Arc::clone(vehicle), inputs, self.damping.is_some()))
    }

    /// Reports wings whose design has a different drive frequency from the vehicle. If the grid file sets the
    /// drive frequency of all wings, nothing is reported.
    pub(super) fn report_frequencies(
        self,
        parameters: &[Parameter],
        sets: impl Fn(usize) -> bool,
        problems: &mut Problems,
    ) {
        if Parameter::index(parameters, DRIVE_FREQUENCY).is_some_and(sets) {
            return;
        }
        for (span, message) in self.frequencies {
            let help = "the wings of a vehicle have one frequency: set drive_frequency under [params]";
            problems.report(span, message).help(help);
        }
    }
}

/// If the grid file has the section `[vehicle]`, turns the design `base` into a vehicle with the wings of
/// this section. If a vehicle is impossible, reports a mistake and returns `None`.
pub(super) fn read(
    root: &[Entry<'_>],
    base: Base,
    reader: Reader<'_>,
    problems: &mut Problems,
) -> Option<(Base, VehicleSettings)> {
    let Some(section) = table::find(root, "vehicle") else { return Some((base, VehicleSettings::default())) };
    let entries = table::section(section, problems);
    table::check_keys(&entries, &KEYS, "in [vehicle]", problems);
    let wings = wings(section, &entries, problems)?;
    let mounts: Option<Vec<Mount>> = wings.iter().map(|wing| mount(wing, problems)).collect();
    let vehicle = match Vehicle::of(base.robot.model(), &mounts?) {
        Ok(vehicle) => Arc::new(vehicle),
        Err(error) => {
            report(&error, section, &wings, problems);
            return None;
        }
    };
    let shared = base.values.len();
    let mut vehicle_reader = VehicleReader {
        vehicle: &vehicle,
        shared: base,
        settings: VehicleSettings::default(),
        problems,
        reader,
    };
    let of_vehicle = |parameter: &Parameter| match parameter.kind {
        Kind::Following(_, follows) if parameter.default.is_nan() => Value::Follows(follows),
        _ => Value::Given(parameter.default),
    };
    vehicle_reader.shared.values.extend(vehicle.parameters()[shared..].iter().map(of_vehicle));
    if let Some(entry) = table::find(&entries, "about") {
        vehicle_reader.vector(entry, |axis| format!("about_{axis}"));
    }
    if let Some(entry) = table::find(&entries, "damping") {
        match entry.value.get_ref().as_bool() {
            Some(true) => vehicle_reader.settings.damping = Some(entry.key_span.clone()),
            Some(false) => {}
            None => {
                vehicle_reader
                    .problems
                    .report(entry.value.span(), "`damping` must be true or false")
                    .help("write damping = true for rows with the damping matrix");
            }
        }
    }
    if let Some(entry) = table::find(&entries, "trim")
        && value::option("trim", &[HOVER], entry.value, vehicle_reader.problems).is_some()
    {
        vehicle_reader.settings.trim = Some(entry.key_span.clone());
    }
    for name in KEYS.into_iter().filter(|key| !["about", "damping", "trim", "wings"].contains(key)) {
        if let Some(entry) = table::find(&entries, name) {
            vehicle_reader.number(name, entry);
        }
    }
    for (index, wing) in wings.iter().enumerate() {
        vehicle_reader.wing(index, wing);
    }
    let (shared, settings) = (vehicle_reader.shared, vehicle_reader.settings);
    Some((Base { robot: Robot::of_vehicle(vehicle), ..shared }, settings))
}

/// Returns the parameters in `chosen` that affect no wing, because each wing has its own value of the
/// parameter.
///
/// `is_own` returns true for each parameter of one wing that the grid file sets.
pub(super) fn unreached(
    vehicle: &Vehicle,
    chosen: &[usize],
    is_own: impl Fn(usize) -> bool,
) -> Vec<&'static Parameter<'static>> {
    let shared = vehicle.model().parameters().iter().enumerate();
    let reaches_none = |parameter: &Parameter| {
        let own = |wing| vehicle.own_parameter(wing, parameter.name);
        (0..vehicle.mounts().len()).all(|wing| own(wing).is_some_and(&is_own))
    };
    let unreached = shared.filter(|(index, parameter)| chosen.contains(index) && reaches_none(parameter));
    unreached.map(|(_, parameter)| parameter).collect()
}

/// Table of a wing, and the entries of the table.
type WingTable<'t> = (&'t Spanned<DeValue<'t>>, Vec<Entry<'t>>);

/// Returns the tables `[[vehicle.wings]]` of a grid file, one for each wing.
fn wings<'t>(
    section: &Entry<'t>,
    entries: &[Entry<'t>],
    problems: &mut Problems,
) -> Option<Vec<WingTable<'t>>> {
    const HELP: &str = "write [[vehicle.wings]] above the keys of each wing, such as name = \"left\"";
    let Some(entry) = table::find(entries, "wings") else {
        problems.report(section.key_span.clone(), "a vehicle needs at least one wing").help(HELP);
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

/// Returns the name of a wing, and whether the wing is mirrored.
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
                    .note("a mirrored wing is the mirror image, in the x-z plane, of a wing at its position")
                    .help("write mirrored = true for a wing on the right");
            }
            mirrored?
        }
    };
    Some(Mount { name, mirrored })
}

/// Reports why a vehicle cannot be created, at the position of the wing that causes the mistake.
fn report(error: &VehicleError, section: &Entry<'_>, wings: &[WingTable<'_>], problems: &mut Problems) {
    let wanted = match error {
        VehicleError::Name(name) | VehicleError::SameName(name) => Some(name),
        VehicleError::Clash { wing, .. } => Some(wing),
        VehicleError::NoWings | VehicleError::ManyWings(_) | VehicleError::NoLoads(_) => None,
    };
    let names = wings.iter().filter_map(|(_, entries)| table::find(entries, "name"));
    let mut named =
        names.filter(|name| name.value.get_ref().as_str() == wanted.map(String::as_str)).collect::<Vec<_>>();
    let one_too_many = match error {
        VehicleError::ManyWings(_) => wings.get(MOST_WINGS).map(|(item, _)| item.span()),
        _ => None,
    };
    let last = named.pop().map(|name| name.value.span());
    let span = one_too_many.or(last).unwrap_or(section.key_span.clone());
    let diagnostic = problems.report(span, error.to_string()).help(remedy(error));
    if let (VehicleError::SameName(_), Some(first)) = (error, named.first()) {
        diagnostic.related(first.value.span(), "the first of them");
    }
}

/// Returns advice for a vehicle that cannot be created.
fn remedy(error: &VehicleError) -> &'static str {
    match error {
        VehicleError::NoWings => {
            "write [[vehicle.wings]] above the keys of each wing, such as name = \"left\""
        }
        VehicleError::ManyWings(_) => "remove this wing and those below it",
        VehicleError::Name(_) => "write a name such as \"left\" or \"front_right\"",
        VehicleError::SameName(_) => "give each wing a name of its own, such as \"left\" and \"right\"",
        VehicleError::Clash { .. } => "give the wing another name",
        VehicleError::NoLoads(_) => "choose a preset of another model: `flap models` lists them",
    }
}

/// Returns true if the table of a wing sets `parameter` under `params`.
fn sets(entries: &[Entry<'_>], parameter: &str) -> bool {
    let params = table::find(entries, "params").and_then(|entry| entry.value.get_ref().as_table());
    params.is_some_and(|params| params.contains_key(parameter))
}

/// Reads the values of a vehicle and its wings.
struct VehicleReader<'o> {
    vehicle: &'o Vehicle,
    /// The design that all wings have in common, with the additional parameters of the vehicle.
    shared: Base,
    settings: VehicleSettings,
    problems: &'o mut Problems,
    reader: Reader<'o>,
}

impl VehicleReader<'_> {
    /// Reads the value of a parameter of the vehicle.
    fn number(&mut self, name: &str, entry: &Entry<'_>) {
        let parameters = self.vehicle.parameters();
        let Some(index) = Parameter::index(parameters, name) else { return };
        let help = if name == "total_mass" {
            "write total_mass = \"85 mg\", or leave it out if it is not known".to_owned()
        } else {
            format!("write a finite number in {}, or text with a unit", parameters[index].unit)
        };
        let (number, error) = uncertainty::of_parameter(&parameters[index], entry, self.problems);
        if let Some(number) = number {
            self.shared.values[index] = Value::Given(number);
            self.shared.with_units.note(index, value::has_units(entry.value));
        } else if let Some(newest) = self.problems.newest().filter(|newest| newest.help.is_empty()) {
            newest.help(help);
        }
        self.settings.set.push((index, entry.key_span.clone()));
        self.shared.uncertainty.set(index, error);
    }

    /// Reads a list of three lengths, along the x, y and z axes of the body.
    fn vector(&mut self, entry: &Entry<'_>, name: impl Fn(&str) -> String) {
        let list = entry.value.get_ref().as_array().filter(|list| list.len() == 3);
        let Some(list) = list else {
            self.problems
                .report(entry.value.span(), format!("`{}` must be a list of three lengths", entry.key))
                .note("x points forward, y to the left, z upwards")
                .help(format!("write {} = [\"0 mm\", \"4 mm\", \"0 mm\"]", entry.key));
            return;
        };
        for (axis, item) in AXES.into_iter().zip(list) {
            let part = Entry { key: entry.key, key_span: entry.key_span.clone(), value: item };
            self.number(&name(axis), &part);
        }
    }

    /// Reads the position, the stroke plane, the design and the parameters of a wing.
    fn wing(&mut self, index: usize, (_, entries): &WingTable<'_>) {
        let name = &self.vehicle.mounts()[index].name;
        if let Some(entry) = table::find(entries, "position") {
            self.vector(entry, |axis| format!("{name}_position_{axis}"));
        }
        if let Some(entry) = table::find(entries, "plane") {
            self.plane(name, entry);
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

    /// Reads the orientation of a wing's stroke plane.
    fn plane(&mut self, wing: &str, entry: &Entry<'_>) {
        const HELP: &str = "write plane = { roll = \"5 deg\", pitch = \"0 deg\", yaw = \"0 deg\" }, or those that are not zero";
        let Some(angles) = entry.value.get_ref().as_table() else {
            let found = table::kind(entry.value.get_ref());
            let message = format!("`plane` must be a table of angles, not {found}");
            self.problems.report(entry.value.span(), message).help(HELP);
            return;
        };
        for angle in table::entries(angles) {
            if PLANE_KEYS.contains(&angle.key) {
                self.number(&format!("{wing}_plane_{}", angle.key), &angle);
                continue;
            }
            let place = "in the plane of a wing";
            let diagnostic = table::report_unknown_key(&angle, &PLANE_KEYS, place, self.problems);
            if diagnostic.help.is_empty() {
                diagnostic.help(HELP);
            }
        }
    }

    /// Reads the preset or device of a wing. The wing gets all numbers of this preset or device except the
    /// drive parameters.
    fn design(&mut self, index: usize, entries: &[Entry<'_>]) {
        let Some(begin) = table::find(entries, "preset").or_else(|| table::find(entries, "device")) else {
            return;
        };
        let span = begin.value.span();
        let Some(design) = self.reader.base(entries, self.problems) else { return };
        let (model, name) = (self.vehicle.model(), &self.vehicle.mounts()[index].name);
        if design.robot.name() != model.name() {
            let message = format!(
                "the wing `{name}` has the model {}, but the vehicle has the model {}",
                design.robot.name(),
                model.name()
            );
            self.problems
                .report(span, message)
                .help("all wings of a vehicle have the same model: choose a preset of this model");
            return;
        }
        for (place, parameter) in model.parameters().iter().enumerate() {
            let (own, shared) = (design.values[place], self.shared.values[place]);
            if parameter.name == DRIVE_FREQUENCY && own != shared {
                let shown = |value: Value| value.given().map_or_else(String::new, value::shown);
                let (own, shared) = (shown(own), shown(shared));
                let message = format!("the wing `{name}` flaps at {own} Hz, but the vehicle at {shared} Hz");
                self.settings.frequencies.push((span.clone(), message));
            }
            if parameter.group == DRIVE {
                continue;
            }
            if !Vehicle::may_differ(parameter) {
                if own != shared {
                    let message = format!(
                        "the wing `{name}` and the vehicle have different values of `{}`",
                        parameter.name
                    );
                    let help = "all wings of a vehicle have the same choices";
                    self.problems.report(span.clone(), message).help(help);
                }
                continue;
            }
            let Some(target) = self.vehicle.own_parameter(index, parameter.name) else { continue };
            match (own, shared) {
                (Value::Given(_), _) => {
                    self.shared.values[target] = own;
                    self.shared.with_units.note(target, Some(design.with_units.contain(place)));
                    self.shared.uncertainty.set(target, design.uncertainty.error(place));
                }
                (_, Value::Given(_)) if !sets(entries, parameter.name) => {
                    let message = format!(
                        "`{0}` is not set in the design of the wing `{name}`, but set in the design of the vehicle",
                        parameter.name
                    );
                    let help =
                        format!("give it a value under [vehicle.wings.params]: {} = ...", parameter.name);
                    self.problems.report(span.clone(), message).help(help);
                }
                _ => {}
            }
        }
        for Correlation { between, coefficient } in design.uncertainty.correlations() {
            let own = |place: usize| {
                let target = self.vehicle.own_parameter(index, model.parameters()[place].name)?;
                self.shared.uncertainty.error(target).map(|_| target)
            };
            if let [Some(one), Some(other)] = between.map(own) {
                let between = [one, other];
                self.shared.uncertainty.correlate(Correlation { between, coefficient: *coefficient });
            }
        }
        self.shared.devices.extend(design.devices);
    }

    /// Reads a parameter that applies to one wing only.
    fn own_parameter(&mut self, index: usize, entry: &Entry<'_>) {
        let model = self.vehicle.model();
        let robot = Robot::of_wing(model);
        let mut lookup = Lookup { robot: &robot, models: self.reader.models, problems: self.problems };
        let Some((place, _)) = lookup.parameter(entry) else { return };
        let parameter = &model.parameters()[place];
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
