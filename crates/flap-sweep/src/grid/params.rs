//! The section `[params]`: single values on top of the preset.

use std::ops::Range;

use flap_core::parameter::Parameter;

use super::lookup::Lookup;
use super::problems::Problems;
use super::resonance;
use super::table::{self, Entry};
use super::{uncertainty, value};
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
