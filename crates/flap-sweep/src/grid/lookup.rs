//! Parameters by name.

use std::ops::Range;

use flap_core::parameter::Parameter;
use flap_core::simulate::Simulator;

use super::absent::why_absent;
use super::problems::Problems;
use super::table::Entry;

/// The model in which parameters are looked up, and the list in which unknown ones are reported.
pub(super) struct Lookup<'l> {
    pub(super) simulator: &'l dyn Simulator,
    pub(super) models: &'l [&'static dyn Simulator],
    pub(super) problems: &'l mut Problems,
}

impl<'l> Lookup<'l> {
    /// The parameter called `name`, with its index; a name that is not known is reported at `span`.
    pub(super) fn named(&mut self, name: &str, span: Range<usize>) -> Option<(usize, &'l Parameter<'l>)> {
        let known = self.simulator.parameters();
        let found = Parameter::index(known, name).map(|index| (index, &known[index]));
        if found.is_none() {
            self.report_unknown(name, span, known);
        }
        found
    }

    /// The parameter that `entry` is for, with its index.
    pub(super) fn parameter(&mut self, entry: &Entry<'_>) -> Option<(usize, &'l Parameter<'l>)> {
        self.named(entry.key, entry.key_span.clone())
    }

    fn report_unknown(&mut self, name: &str, span: Range<usize>, known: &[Parameter<'_>]) {
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
            .label("unknown parameter");
        if let Some(reason) = why_absent(known, name) {
            diagnostic.help(reason);
            return;
        }
        diagnostic.did_you_mean(name, known.iter().map(|parameter| parameter.name));
        if !owners.is_empty() {
            let models = if owners.len() == 1 { "model" } else { "models" };
            diagnostic.note(format!("it is a parameter of the {models} {}", owners.join(" and ")));
        }
        if diagnostic.help.is_empty() {
            diagnostic.help("`flap models` lists the parameters of every model");
        }
    }

    /// The name of parameter number `index`.
    pub(super) fn name(&self, index: usize) -> &'l str {
        self.simulator.parameters()[index].name
    }
}
