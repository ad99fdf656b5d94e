//! The key `preset`: the model, and the values that its parameters start from.

use flap_core::parameter::Preset;
use flap_core::simulate::Simulator;

use super::keys::KEYS;
use super::problems::Problems;
use super::table::{self, Entry};
use super::value;
use crate::notation::nearest;

type Chosen = (&'static dyn Simulator, &'static Preset);

/// The preset that the file names, with its model.
pub(super) fn read(
    root: &[Entry<'_>],
    models: &[&'static dyn Simulator],
    problems: &mut Problems,
) -> Option<Chosen> {
    let all: Vec<Chosen> =
        models.iter().flat_map(|model| model.presets().iter().map(|preset| (*model, preset))).collect();
    let Some(entry) = table::find(root, "preset") else {
        if root.iter().any(|entry| is_slip(entry.key)) {
            // The unknown key is reported, with the one that was meant.
            return None;
        }
        let message = if root.is_empty() { "the file is empty" } else { "`preset` is missing" };
        let diagnostic = problems.report(0..0, message).note(list(&all));
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
            .note(list(&all))
            .did_you_mean(name, all.iter().map(|(_, preset)| preset.name));
    }
    chosen
}

/// True if a key at the top of the file is a slip for one that says what to start from.
fn is_slip(key: &str) -> bool {
    let meant = nearest(key, KEYS).filter(|_| !KEYS.contains(&key));
    meant.is_some_and(|meant| ["preset", "device"].contains(&meant))
}

fn list(all: &[Chosen]) -> String {
    let named: Vec<String> =
        all.iter().map(|(model, preset)| format!("{} ({})", preset.name, model.name())).collect();
    format!("presets, with their models: {}", named.join(", "))
}
