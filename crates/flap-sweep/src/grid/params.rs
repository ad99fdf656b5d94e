//! The section `[params]`: single values on top of the preset.

use std::ops::Range;

use flap_core::parameter::Parameter;
use flap_core::simulate::Simulator;

use super::problems::Problems;
use super::resonance;
use super::table::{self, Entry};
use super::uncertainty;
use crate::plan::Value;
use crate::plan::uncertainty::Uncertainty;

/// The model in which parameters are looked up, and the list in which unknown ones are reported.
pub(super) struct Lookup<'l> {
    pub(super) simulator: &'static dyn Simulator,
    pub(super) models: &'l [&'static dyn Simulator],
    pub(super) problems: &'l mut Problems,
}

impl Lookup<'_> {
    /// The parameter called `name`, with its index; a name that is not known is reported at `span`.
    pub(super) fn named(&mut self, name: &str, span: Range<usize>) -> Option<(usize, &'static Parameter)> {
        let known = self.simulator.parameters();
        let found = Parameter::index(known, name).map(|index| (index, &known[index]));
        if found.is_none() {
            self.report_unknown(name, span, known);
        }
        found
    }

    /// The parameter that `entry` is for, with its index.
    pub(super) fn parameter(&mut self, entry: &Entry<'_>) -> Option<(usize, &'static Parameter)> {
        self.named(entry.key, entry.key_span.clone())
    }

    fn report_unknown(&mut self, name: &str, span: Range<usize>, known: &[Parameter]) {
        let model = self.simulator.name();
        let owners: Vec<&str> = self
            .models
            .iter()
            .filter(|other| Parameter::index(other.parameters(), name).is_some())
            .map(|other| other.name())
            .collect();
        let diagnostic = self
            .problems
            .report(span, format!("model `{model}` has no parameter `{name}`"))
            .label("unknown parameter")
            .did_you_mean(name, known.iter().map(|parameter| parameter.name));
        if !owners.is_empty() {
            diagnostic.note(format!("it is a parameter of the model {}", owners.join(" and ")));
        }
        if diagnostic.help.is_empty() {
            diagnostic.help("`flap params` lists the parameters of every model");
        }
    }

    /// The name of parameter number `index`.
    pub(super) fn name(&self, index: usize) -> &'static str {
        self.simulator.parameters()[index].name
    }
}

/// Puts the values of `[params]` into `base`, and their standard errors into `errors`. Returns which parameters the section
/// names, and where.
pub(super) fn read(
    entry: Option<&Entry<'_>>,
    base: &mut [Value],
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
        let (value, error) = uncertainty::of_parameter(parameter, &entry, lookup.problems);
        if let Some(value) = value {
            base[index] = Value::Given(value);
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
