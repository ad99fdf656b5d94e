//! Reads the designs whose parameters a grid file varies. Several designs, as in `device = ["a.toml",
//! "b.toml"]`, form an axis.

use std::ops::Range;
use std::path::Path;

use flap_core::parameter::Preset;
use toml::Spanned;
use toml::de::DeValue;

use super::axes::Placed;
use super::device::{self, Base, Reader};
use super::diagnostic::Problems;
use super::table::{self, Entry};
use super::vehicle::{self, VehicleSettings};
use crate::plan::axes::{Axis, Values};
use crate::plan::uncertainty::Uncertainty;
use crate::plan::{Differences, Value};

/// The designs whose parameters the grid file varies, without the wings of the section `[vehicle]`.
pub(super) struct Designs {
    /// The list contains at least one design, and all designs have the same model.
    pub(super) bases: Vec<Base>,
    /// Names of the designs, if the designs form an axis.
    names: Option<Names>,
}

/// Names of the designs along an axis.
struct Names {
    /// The key `device` or `preset` of the grid file, which is also the name of the axis.
    key: &'static str,
    key_span: Range<usize>,
    labels: Vec<String>,
}

/// The designs of a grid with their wings: the first design, and the parameter values in which the designs
/// differ.
pub(super) struct Start {
    /// The first design. If a parameter has different values in the designs, the first design contains no
    /// value for this parameter.
    pub(super) base: Base,
    /// Values of each design.
    pub(super) designs: Vec<Vec<Value>>,
    /// Preset of each design.
    pub(super) presets: Vec<&'static Preset>,
    pub(super) differences: Differences,
    /// The axis along which the design changes, if the grid has a list of designs.
    pub(super) axis: Option<Placed>,
}

/// Reads the designs that the key `preset` or `device` of a grid file names. If the designs have mistakes,
/// reports the mistakes and returns `None`.
pub(super) fn read(root: &[Entry<'_>], reader: Reader<'_>, problems: &mut Problems) -> Option<Designs> {
    let Some((key, entry, list)) = listed(root) else {
        return Some(Designs { bases: vec![reader.base(root, problems)?], names: None });
    };
    device::check_description(root, problems);
    if list.is_empty() {
        problems
            .report(entry.value.span(), format!("the list of `{key}` has no values"))
            .label("empty list")
            .help(format!("list at least one {key}, or write one without brackets"));
        return None;
    }
    let mut bases: Vec<Option<Base>> = Vec::new();
    for value in list {
        let key_span = entry.key_span.clone();
        bases.push(reader.base(&[Entry { key, key_span, value }], problems));
    }
    let bases = bases.into_iter().collect::<Option<Vec<Base>>>()?;
    let labels = labels(key, list, problems)?;
    let model = bases[0].robot.name();
    let mut designs = bases.iter().zip(list);
    if let Some((base, value)) = designs.find(|(base, _)| base.robot.name() != model) {
        let other = base.robot.name();
        problems
            .report(
                value.span(),
                format!("this {key} has the model {other}, but the first has the model {model}"),
            )
            .related(list[0].span(), format!("the model {model}"))
            .help("designs along an axis have the same model: write a grid file for each model");
        return None;
    }
    Some(Designs { bases, names: Some(Names { key, key_span: entry.key_span.clone(), labels }) })
}

type List<'t> = [Spanned<DeValue<'t>>];

/// If the key `device` or `preset` has a list as its value, returns the key, its entry and the list.
fn listed<'e, 't>(root: &'e [Entry<'t>]) -> Option<(&'static str, &'e Entry<'t>, &'e List<'t>)> {
    let mut begins = ["device", "preset"].into_iter().filter_map(|key| Some((key, table::find(root, key)?)));
    let (key, entry) = begins.next()?;
    let list = entry.value.get_ref().as_array()?;
    // Two keys are a mistake, which is reported elsewhere.
    begins.next().is_none().then_some((key, entry, list))
}

/// Returns the labels that stand for the designs in rows of results. A label is the name of a preset, or the
/// file name of a device without folder and ending.
fn labels(key: &str, list: &List<'_>, problems: &mut Problems) -> Option<Vec<String>> {
    let mut labels: Vec<String> = Vec::new();
    for value in list {
        let name = value.get_ref().as_str().unwrap_or_default();
        let stem = Path::new(name).file_stem().and_then(|stem| stem.to_str());
        let label = stem.filter(|_| key == "device").unwrap_or(name);
        if let Some(same) = labels.iter().position(|other| other == label) {
            let help = if key == "device" {
                "rows name a device by its file, without folder and ending: rename one of the files"
            } else {
                "remove one of them"
            };
            problems
                .report(value.span(), format!("two values of `{key}` have the label `{label}`"))
                .related(list[same].span(), "the first of them")
                .help(help);
            return None;
        }
        // Results have no types: a column of words must not look like numbers or conditions.
        let is_other = label.parse::<f64>().is_ok() || ["true", "false"].contains(&label);
        if is_other || label.contains(['"', '\'', ',']) || label.chars().any(char::is_control) {
            problems
                .report(value.span(), format!("`{label}` cannot be the label of a device in rows"))
                .note("a label is text without quotes and commas, and not a number, `true` or `false`")
                .help("rows name a device by its file, without folder and ending: rename the file");
            return None;
        }
        labels.push(label.to_owned());
    }
    Some(labels)
}

impl Designs {
    /// Adds the wings of the section `[vehicle]` to each design, and compares the designs. If the section has
    /// mistakes, reports the mistakes and returns `None`.
    pub(super) fn start(
        self,
        root: &[Entry<'_>],
        reader: Reader<'_>,
        problems: &mut Problems,
    ) -> Option<(Start, VehicleSettings)> {
        let mut bases = self.bases.into_iter();
        let (first, mut settings) = vehicle::read(root, bases.next()?, reader, problems)?;
        let mut all = vec![first];
        for base in bases {
            // Mistakes in the section do not depend on the design.
            if !problems.is_empty() {
                return None;
            }
            let (base, more) = vehicle::read(root, base, reader, problems)?;
            settings.append(more);
            all.push(base);
        }
        Some((Start::new(all, self.names)?, settings))
    }
}

impl Start {
    fn new(bases: Vec<Base>, names: Option<Names>) -> Option<Start> {
        let designs: Vec<Vec<Value>> = bases.iter().map(|base| base.values.clone()).collect();
        let presets = bases.iter().map(|base| base.preset).collect();
        let Some(Names { key, key_span, labels }) = names else {
            let base = bases.into_iter().next()?;
            return Some(Start { base, designs, presets, differences: Differences::default(), axis: None });
        };
        let have_units = |parameter: usize| bases.iter().all(|base| base.with_units.contain(parameter));
        let mut differences = Differences { design: designs[0].len(), values: Vec::new() };
        let mut with_units = Vec::new();
        for parameter in 0..differences.design {
            let values: Vec<f64> = designs.iter().map(|design| design[parameter].in_point()).collect();
            if values.iter().any(|value| value.to_bits() != values[0].to_bits()) {
                differences.values.push((parameter, values));
                with_units.push((parameter, have_units(parameter)));
            }
        }
        let mut devices = Vec::new();
        for device in bases.iter().flat_map(|base| &base.devices) {
            if !devices.contains(device) {
                devices.push(device.clone());
            }
        }
        let count = labels.len();
        let first = bases.into_iter().next()?;
        let mut base = Base {
            robot: first.robot.with_designs(key, labels),
            // Standard errors belong to one device.
            uncertainty: Uncertainty::default(),
            devices,
            ..first
        };
        for (parameter, has_unit) in with_units {
            let unset = designs.iter().map(|design| design[parameter]).find(|value| value.given().is_none());
            base.values[parameter] = unset.unwrap_or(Value::OfDesign);
            base.with_units.note(parameter, Some(has_unit));
        }
        base.values.push(Value::Given(0.0));
        let numbers = Values::List((0..count).map(|number| number as f64).collect());
        let axis = Placed {
            axis: Axis::new(vec![(differences.design, numbers)]),
            span: key_span.clone(),
            keys: vec![key_span],
            with_units: vec![None],
        };
        Some(Start { base, designs, presets, differences, axis: Some(axis) })
    }
}
