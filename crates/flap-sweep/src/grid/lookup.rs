//! Finds parameters by name, and explains why a vehicle has no parameter with a given name.

use std::ops::Range;

use flap_core::parameter::Parameter;
use flap_core::simulate::Simulator;
use flap_core::vehicle::{DIFFERENCE, Vehicle, of_all_wings};

use super::diagnostic::{Diagnostic, Problems};
use super::table::Entry;
use crate::plan::Robot;

/// A robot whose parameters are looked up by name, and the list to which unknown names are added as mistakes.
pub(super) struct Lookup<'l> {
    pub(super) robot: &'l Robot,
    pub(super) models: &'l [&'static dyn Simulator],
    pub(super) problems: &'l mut Problems,
}

impl<'l> Lookup<'l> {
    /// Returns the parameter called `name` and the index of this parameter. If the name is unknown, reports a
    /// mistake at the position `span`.
    pub(super) fn named(&mut self, name: &str, span: Range<usize>) -> Option<(usize, &'l Parameter<'l>)> {
        let known = self.robot.parameters();
        let found = Parameter::index(known, name).map(|index| (index, &known[index]));
        if found.is_none() {
            self.report_unknown(name, span, known);
        }
        found
    }

    /// Returns the parameter that the key of `entry` names, and the index of this parameter.
    pub(super) fn parameter(&mut self, entry: &Entry<'_>) -> Option<(usize, &'l Parameter<'l>)> {
        self.named(entry.key, entry.key_span.clone())
    }

    fn report_unknown(&mut self, name: &str, span: Range<usize>, known: &[Parameter<'_>]) {
        let model = self.robot.name();
        let owners: Vec<&str> = self
            .models
            .iter()
            .filter(|other| Parameter::index(other.parameters(), name).is_some())
            .map(|other| other.name())
            .collect();
        let message = format!("model `{model}` has no parameter `{name}`");
        let diagnostic = self.report(span, message).label("unknown parameter");
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

    /// Adds a mistake at the position `span` of the file, as [`Problems::report`] does.
    pub(super) fn report(&mut self, span: Range<usize>, message: impl Into<String>) -> &mut Diagnostic {
        self.problems.report(span, message)
    }

    /// Returns the name of parameter number `index`.
    pub(super) fn name(&self, index: usize) -> &'l str {
        self.robot.parameters()[index].name
    }
}

/// Explains why a vehicle has no parameter called `name`. `parameters` are the parameters of the vehicle.
///
/// The function explains the absence of three kinds of parameters. The kinds are parameters of one wing that
/// all wings have in common, phases, and left-right differences without wings on both sides. For all other
/// names, or if `parameters` are not the parameters of a vehicle, returns `None`.
pub fn why_absent(parameters: &[Parameter], name: &str) -> Option<String> {
    if !parameters.iter().any(|known| known.name == "about_x") {
        return None;
    }
    if is_phase(parameters, name) {
        return Some(
            "you cannot set a phase between wings: it would not change any mean force or torque".to_owned(),
        );
    }
    parameters.iter().enumerate().find_map(|(index, known)| {
        let first = name.strip_suffix(known.name)?.strip_suffix('_')?;
        if !Vehicle::may_differ(known) && (first == DIFFERENCE || is_wing(parameters, first)) {
            return Some(format!("`{0}` is common to all wings: write `{0}`", known.name));
        }
        let has_own = (0..parameters.len()).any(|own| of_all_wings(parameters, own) == Some(index));
        (first == DIFFERENCE && has_own).then(|| {
            "a left-right difference requires wings on both sides: some with mirrored = true, and some without"
                .to_owned()
        })
    })
}

fn is_wing(parameters: &[Parameter], name: &str) -> bool {
    parameters.iter().any(|known| known.name.strip_suffix("_position_x") == Some(name))
}

/// Returns true if `name` means a phase of the drive: of all wings, of one wing, or a left-right difference
/// of phases.
fn is_phase(parameters: &[Parameter], name: &str) -> bool {
    let Some(first) = name.strip_suffix("phase_difference").or(name.strip_suffix("phase")) else {
        return false;
    };
    let first = first.strip_suffix("drive_").unwrap_or(first);
    first.is_empty()
        || first.strip_suffix('_').is_some_and(|first| first == DIFFERENCE || is_wing(parameters, first))
}
