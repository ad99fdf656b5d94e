//! Reads the section `[gradient]`, which requests derivatives of measures with respect to parameters as
//! columns.

use std::ops::Range;

use flap_core::parameter::Parameter;

use super::diagnostic::Problems;
use super::formula::Names;
use super::table::{self, Entry};
use super::value;
use crate::derivative::Per;
use crate::notation::expression::Kind;
use crate::plan::Robot;
use crate::plan::formula::Derived;
use crate::plan::gradient::{Gradient, check};
use crate::vehicle::BodyRows;

pub(super) const KEYS: [&str; 2] = ["of", "with_respect_to"];

/// Returns the derivatives that the section `[gradient]` requests. `names` contains the measures of rows, and
/// `derived` contains the derived parameters.
pub(super) fn read(
    entry: Option<&Entry<'_>>,
    robot: &Robot,
    names: &Names<'_>,
    derived: &Derived,
    at_resonance: bool,
    body: Option<&BodyRows>,
    problems: &mut Problems,
) -> Option<Gradient> {
    let entry = entry?;
    let entries = table::section(entry, problems);
    table::check_keys(&entries, &KEYS, "in [gradient]", problems);
    if at_resonance {
        problems
            .report(entry.key_span.clone(), "rows at the resonance of each design have no derivatives")
            .note("the resonance changes with the design, and flap does not compute this change")
            .help("set drive_frequency, or remove [gradient]");
    }
    if let Err(error) = robot.gradients() {
        problems.report(entry.key_span.clone(), error.to_string());
    }
    for key in KEYS {
        if table::find(&entries, key).is_none() {
            let help = format!("write {key} = [\"…\"] under [gradient]");
            problems.report(entry.key_span.clone(), format!("[gradient] lacks `{key}`")).help(help);
        }
    }
    let of = table::find(&entries, "of")?;
    let with_respect_to = table::find(&entries, "with_respect_to")?;
    let of = value::names(of, "a list of names", "", problems).into_iter();
    let of = of.filter_map(|(name, span)| measure(name, span, names, problems)).collect();
    let by = value::names(with_respect_to, "a list of names", "", problems).into_iter();
    let by = by.filter_map(|(name, span)| parameter(name, span, names, derived, body, problems));
    Some(Gradient { of, with_respect_to: by.collect(), per: Per::Cent })
}

/// Returns the index of the measure `name` in a list that contains the model's measures and then the user's
/// measures.
fn measure(name: &str, span: Range<usize>, names: &Names<'_>, problems: &mut Problems) -> Option<usize> {
    let columns = names.columns.iter().map(|column| column.name.as_str());
    let own = names.own.iter().map(|own| own.name.as_str());
    let index = columns.clone().chain(own.clone()).position(|known| known == name);
    let Some(index) = index else {
        problems.report(span, format!("there is no measure `{name}`")).did_you_mean(name, columns.chain(own));
        return None;
    };
    let own = index.checked_sub(names.columns.len()).map(|place| &names.own[place]);
    if own.is_some_and(|own| own.kind() != Kind::Number) {
        problems.report(span, format!("`{name}` is true or false, and has no derivatives"));
        return None;
    }
    Some(index)
}

/// Returns the index of the parameter `name`. If derivatives with respect to this parameter are impossible,
/// reports a mistake and returns `None`.
fn parameter(
    name: &str,
    span: Range<usize>,
    names: &Names<'_>,
    derived: &Derived,
    body: Option<&BodyRows>,
    problems: &mut Problems,
) -> Option<usize> {
    let Some(index) = Parameter::index(names.parameters, name) else {
        problems
            .report(span, format!("there is no parameter `{name}`"))
            .did_you_mean(name, names.parameters.iter().map(|parameter| parameter.name));
        return None;
    };
    let is_derived = derived.parameters().any(|derived| derived == index);
    let standing = names.standing(index);
    let is_input = body.is_some_and(|body| body.has_input(standing));
    let Err(reason) = check(&names.parameters[index], is_derived, is_input, names.unset[standing]) else {
        return Some(index);
    };
    let diagnostic = problems.report(span, format!("`{name}` {reason}"));
    if !reason.help().is_empty() {
        diagnostic.help(reason.help());
    }
    None
}
