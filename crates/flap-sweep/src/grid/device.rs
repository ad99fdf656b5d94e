//! Reads the design whose parameters a grid file varies: a preset, or a device file with its section
//! `[params]`. The module also reads the section `[params]` of grid files.

use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use flap_core::parameter::Preset;
use flap_core::simulate::Simulator;
use toml::de::DeTable;

use super::diagnostic::{self, Problems};
use super::lookup::Lookup;
use super::table::{self, Entry};
use super::{resonance, uncertainty, value};
use crate::input::{self, MOST_BYTES};
use crate::notation::nearest;
use crate::plan::uncertainty::Uncertainty;
use crate::plan::{Robot, Source, Value, WithUnits};

/// Keys of a device.
const DEVICE_KEYS: [&str; 5] = ["description", "preset", "device", "params", "correlation"];

/// The design whose parameters the grid file varies.
pub(super) struct Base {
    pub(super) robot: Robot,
    /// The preset of the design, or the preset on which the device of the design is based.
    pub(super) preset: &'static Preset,
    pub(super) values: Vec<Value>,
    /// Parameters whose values have units in the file.
    pub(super) with_units: WithUnits,
    pub(super) uncertainty: Uncertainty,
    /// The devices of the design: the device that the grid file names, the device on which this device is
    /// based, and so on.
    pub(super) devices: Vec<Source>,
}

/// Reads devices from files, or from texts that were recorded with results.
#[derive(Clone, Copy)]
pub(super) struct Reader<'r> {
    pub(super) models: &'r [&'static dyn Simulator],
    /// Names and texts of the devices that were recorded with results. If this field is `None`, devices are
    /// read from files.
    pub(super) recorded: Option<&'r [Source]>,
}

impl Reader<'_> {
    /// Returns the design that the key `preset` or `device` at the top of a file names. If there is no design, reports
    /// a mistake and returns `None`.
    pub(super) fn base(self, root: &[Entry<'_>], problems: &mut Problems) -> Option<Base> {
        self.of_file(root, &mut Vec::new(), problems)
    }

    /// Returns the design that a grid file or a device describes. `chain` contains the paths of the devices
    /// that were read before this file. Each device in `chain` is based on the next device.
    fn of_file(self, root: &[Entry<'_>], chain: &mut Vec<PathBuf>, problems: &mut Problems) -> Option<Base> {
        check_description(root, problems);
        let Some(entry) = table::find(root, "device") else {
            let (model, preset) = read_preset(root, self.models, problems)?;
            let values = Value::of_preset(model.parameters(), preset);
            return Some(Base {
                robot: Robot::of_wing(model),
                preset,
                values,
                with_units: WithUnits::default(),
                uncertainty: Uncertainty::default(),
                devices: Vec::new(),
            });
        };
        if let Some(preset) = table::find(root, "preset") {
            problems
                .report(
                    preset.key_span.clone(),
                    "a design starts from a preset or from a device, not from both",
                )
                .related(entry.key_span.clone(), "the device")
                .help("keep one of them: a device names its own preset");
            return None;
        }
        let name = value::text("device", entry.value, problems)?;
        let path = problems.beside(name);
        if chain.contains(&path) {
            let names: Vec<String> =
                chain.iter().chain([&path]).map(|path| path.display().to_string()).collect();
            problems
                .report(entry.value.span(), format!("the device refers to itself: {}", names.join(" → ")))
                .help("start one of them from a preset");
            return None;
        }
        let name = path.display().to_string();
        let text = match self.recorded {
            None => input::text(&path, MOST_BYTES).map_err(|error| error.to_string()),
            Some(devices) => {
                let found = devices.iter().find(|device| device.name == name);
                found.map(|device| device.text.clone()).ok_or_else(|| "it was not recorded".to_owned())
            }
        };
        let text = match text {
            Ok(text) => text,
            Err(reason) => {
                problems
                    .report(entry.value.span(), format!("{name}: {reason}"))
                    .note("the path is relative to the folder of the file that names it")
                    .help("`flap device new PRESET > mybee.toml` writes a device");
                return None;
            }
        };
        chain.push(path);
        let source = Source { name, text };
        let mut own = Problems::new(Arc::new(source.clone()));
        let base = self.device(&source.text, chain, &mut own);
        problems.absorb(own);
        let mut base = base?;
        base.devices.insert(0, source);
        Some(base)
    }

    /// Returns the design that the text of a device file describes.
    fn device(self, text: &str, chain: &mut Vec<PathBuf>, problems: &mut Problems) -> Option<Base> {
        let (root, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            diagnostic::report_syntax(&errors, problems);
            return None;
        }
        let root = table::entries(root.get_ref());
        for entry in root.iter().filter(|entry| !DEVICE_KEYS.contains(&entry.key)) {
            table::report_unknown_key(entry, &DEVICE_KEYS, "in a device", problems)
                .help("axes, samples and settings go into the grid file that names the device");
        }
        let mut base = self.of_file(&root, chain, problems)?;
        base.set(&root, self.models, problems);
        Some(base)
    }
}

/// If the value of the key `description` is not text, reports a mistake.
pub(super) fn check_description(root: &[Entry<'_>], problems: &mut Problems) {
    if let Some(description) = table::find(root, "description") {
        value::text("description", description.value, problems);
    }
}

impl Base {
    /// Applies the sections `[params]` and `[[correlation]]` of a file to the design.
    ///
    /// Returns the parameters in `[params]`, with the positions of the parameters in the file.
    pub(super) fn set(
        &mut self,
        root: &[Entry<'_>],
        models: &[&'static dyn Simulator],
        problems: &mut Problems,
    ) -> Vec<(usize, Range<usize>)> {
        let mut lookup = Lookup { robot: &self.robot, models, problems };
        let mut set = Vec::new();
        let params = table::find(root, "params").map(|entry| table::section(entry, lookup.problems));
        for entry in params.unwrap_or_default() {
            let Some((index, parameter)) = lookup.parameter(&entry) else {
                continue;
            };
            set.push((index, entry.key_span.clone()));
            // No value: the resonance is computed later.
            if resonance::sets_resonance(&entry) {
                self.uncertainty.set(index, None);
                continue;
            }
            let (number, error) = uncertainty::of_parameter(parameter, &entry, lookup.problems);
            if let Some(number) = number {
                self.values[index] = Value::Given(number);
                self.with_units.note(index, value::has_units(entry.value));
            }
            self.uncertainty.set(index, error);
        }
        uncertainty::correlations(table::find(root, "correlation"), &mut self.uncertainty, &mut lookup);
        set
    }
}

type ModelPreset = (&'static dyn Simulator, &'static Preset);

/// Returns the preset that the file names, and the model of the preset.
pub(super) fn read_preset(
    root: &[Entry<'_>],
    models: &[&'static dyn Simulator],
    problems: &mut Problems,
) -> Option<ModelPreset> {
    let all: Vec<ModelPreset> =
        models.iter().flat_map(|model| model.presets().iter().map(|preset| (*model, preset))).collect();
    let Some(entry) = table::find(root, "preset") else {
        if root.iter().any(|entry| is_misspelt_start(entry.key)) {
            // The misspelt key is reported elsewhere, with the correct one.
            return None;
        }
        let message = if root.is_empty() { "the file is empty" } else { "`preset` is missing" };
        let diagnostic = problems.report(0..0, message).note(presets_and_models(&all));
        if let Some((_, first)) = all.first() {
            diagnostic.help(format!("start the file with a preset, such as: preset = \"{}\"", first.name));
        }
        return None;
    };
    let name = value::text("preset", entry.value, problems)?;
    let chosen = all.iter().find(|(_, preset)| preset.name == name).copied();
    if chosen.is_none() {
        problems
            .report(entry.value.span(), format!("there is no preset `{name}`"))
            .label("unknown preset")
            .note(presets_and_models(&all))
            .did_you_mean(name, all.iter().map(|(_, preset)| preset.name));
    }
    chosen
}

/// Returns true if a key at the top of the file is a misspelling of `preset` or `device`.
fn is_misspelt_start(key: &str) -> bool {
    let meant = nearest(key, table::KEYS).filter(|_| !table::KEYS.contains(&key));
    meant.is_some_and(|meant| ["preset", "device"].contains(&meant))
}

fn presets_and_models(all: &[ModelPreset]) -> String {
    let named: Vec<String> =
        all.iter().map(|(model, preset)| format!("{} ({})", preset.name, model.name())).collect();
    format!("presets, with their models: {}", named.join(", "))
}
