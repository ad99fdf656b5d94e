//! The preset of a grid file, and the section `[params]`: single values on top of it.

use std::ops::Range;

use flap_core::parameter::{Parameter, Preset};
use flap_core::simulate::Simulator;

use super::lookup::Lookup;
use super::problems::Problems;
use super::table::KEYS;
use super::table::{self, Entry};
use super::{resonance, uncertainty, value};
use crate::notation::nearest;
use crate::plan::uncertainty::Uncertainty;
use crate::plan::{Value, WithUnits};

/// Puts the values of `[params]` into `base`, whether they have units into `with_units`, and their standard errors into `errors`.
/// Returns which parameters the section names, and where.
pub(super) fn read(
    entry: Option<&Entry<'_>>,
    base: &mut [Value],
    with_units: &mut WithUnits,
    errors: &mut Uncertainty,
    lookup: &mut Lookup<'_>,
) -> Vec<(usize, Range<usize>)> {
    let mut set = Vec::new();
    for entry in entry.map(|entry| table::section(entry, lookup.problems)).unwrap_or_default() {
        let Some((index, parameter)) = lookup.parameter(&entry) else {
            continue;
        };
        report_both_names(parameter, &entry, index, &set, lookup.problems);
        set.push((index, entry.key_span.clone()));
        // Not a value: the resonance is searched for.
        if resonance::is_asked_for(&entry) {
            continue;
        }
        let (number, error) = uncertainty::of_parameter(parameter, &entry, lookup.problems);
        if let Some(number) = number {
            base[index] = Value::Given(number);
            with_units.note(index, value::has_units(entry.value));
        }
        errors.set(index, error);
    }
    set
}

/// Reports a parameter that the section sets by its name and by its former name.
fn report_both_names(
    parameter: &Parameter,
    entry: &Entry<'_>,
    index: usize,
    set: &[(usize, Range<usize>)],
    problems: &mut Problems,
) {
    if let Some((_, before)) = set.iter().find(|(other, _)| *other == index) {
        let message = format!("`{}` is set twice: `{}` is its former name", parameter.name, parameter.former);
        let diagnostic = problems.report(entry.key_span.clone(), message).label("again here");
        diagnostic.related(before.clone(), "first here").help("keep one of them");
    }
}

type Chosen = (&'static dyn Simulator, &'static Preset);

/// The preset that the file names, with its model.
pub(super) fn read_preset(
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
