//! Expressions in a grid file, and the names that they may use.

use flap_core::parameter::{Kind as ParameterKind, Parameter};
use flap_core::simulate::Column;
use flap_core::vehicle::of_all_wings;

use super::problems::Problems;
use super::table::{self, Entry};
use super::value;
use crate::grid::diagnostic::Diagnostic;
use crate::notation::expression::{Expression, ExpressionError, Kind, Meaning, Problem, Scope};
use crate::plan::Value;
use crate::plan::formula::OwnMeasure;

/// The prefix of a parameter's name that stands for its value in the preset.
const PRESET: &str = "preset.";

/// The prefix that stands for its value in the device.
const DEVICE: &str = "device.";

/// The others that a drive frequency follows that is to be the resonance.
const RESONANCE: &str = "the resonance of each design, which [measure] has as resonance_hz";

/// The names of parameters, of their values in the preset, and of measures. Values stand in this order: the
/// parameters, the model's measures, the user's own.
pub(super) struct Names<'n> {
    pub(super) parameters: &'n [Parameter<'n>],
    /// The values of the preset.
    pub(super) preset: Vec<Value>,
    /// The values of the device, if the grid begins with one.
    pub(super) device: Option<Vec<Value>>,
    /// For each parameter without a value of its own, the others that it follows.
    pub(super) unset: Vec<Option<&'static str>>,
    /// The model's measures, without the user's own.
    pub(super) columns: Vec<Column>,
    /// True if the model's measures may be used: not before a point is run.
    pub(super) are_measured: bool,
    /// The user's own measures that may be used.
    pub(super) own: Vec<OwnMeasure>,
}

/// The others that a parameter follows, in words, if it has no value of its own.
pub(super) fn followed(value: Value) -> Option<&'static str> {
    match value {
        Value::Given(_) => None,
        Value::Follows(follows) => Some(follows),
        Value::Resonance => Some(RESONANCE),
    }
}

impl Names<'_> {
    fn parameter(&self, name: &str) -> Option<usize> {
        Parameter::index(self.parameters, name)
    }

    /// The parameter whose value one has: a wing's own that is not set has that of all wings.
    pub(super) fn standing(&self, index: usize) -> usize {
        let shared = of_all_wings(self.parameters, index).filter(|_| self.unset[index].is_some());
        shared.unwrap_or(index)
    }

    fn of_parameter(&self, index: usize) -> Meaning {
        let index = self.standing(index);
        match (&self.parameters[index].kind, self.unset[index]) {
            (ParameterKind::Choice(options), _) => Meaning::Choice(index, options),
            (_, Some(follows)) => Meaning::Unset(follows),
            (_, None) => Meaning::Number(index),
        }
    }

    /// The meaning of a parameter's value in a design that does not change: the preset or the device.
    fn of_fixed(&self, design: &[Value], index: usize) -> Option<Meaning> {
        if let ParameterKind::Choice(_) = self.parameters[index].kind {
            return None;
        }
        let shared = of_all_wings(self.parameters, index).filter(|_| design[index].given().is_none());
        let value = design[shared.unwrap_or(index)];
        value.given().map(Meaning::Constant).or_else(|| followed(value).map(Meaning::Unset))
    }

    fn of_measure(&self, name: &str) -> Option<Meaning> {
        let first = self.parameters.len();
        if !self.are_measured {
            return None;
        }
        if let Some(place) = self.columns.iter().position(|column| column.name == name) {
            return Some(Meaning::Number(first + place));
        }
        let place = self.own.iter().position(|own| own.name == name)?;
        let index = first + self.columns.len() + place;
        Some(match self.own[place].kind() {
            Kind::Number => Meaning::Number(index),
            Kind::Condition => Meaning::Condition(index),
        })
    }
}

impl Scope for Names<'_> {
    fn meaning(&self, name: &str) -> Option<Meaning> {
        if let Some(name) = name.strip_prefix(PRESET) {
            return self.parameter(name).and_then(|index| self.of_fixed(&self.preset, index));
        }
        if let (Some(name), Some(device)) = (name.strip_prefix(DEVICE), &self.device) {
            return self.parameter(name).and_then(|index| self.of_fixed(device, index));
        }
        self.parameter(name).map(|index| self.of_parameter(index)).or_else(|| self.of_measure(name))
    }

    fn names(&self) -> Vec<String> {
        let parameters = self.parameters.iter().map(|parameter| parameter.name.to_owned());
        let fixed = [(PRESET, Some(&self.preset)), (DEVICE, self.device.as_ref())];
        let fixed = fixed.into_iter().filter_map(|(prefix, design)| design.map(|design| (prefix, design)));
        let fixed = fixed.flat_map(|(prefix, design)| {
            let constant =
                |index: &usize| matches!(self.of_fixed(design, *index), Some(Meaning::Constant(_)));
            let named = move |index: usize| prefix.to_owned() + self.parameters[index].name;
            (0..self.parameters.len()).filter(constant).map(named).collect::<Vec<_>>()
        });
        let columns = self.columns.iter().filter(|_| self.are_measured).map(|column| column.name.clone());
        let own = self.own.iter().map(|own| own.name.clone());
        parameters.chain(fixed).chain(columns).chain(own).collect()
    }
}

/// The expression that `entry` holds, which must be of the kind `wanted` and known before points are run. `None`, with
/// reports, if it is not.
pub(super) fn read(
    entry: &Entry<'_>,
    names: &Names<'_>,
    wanted: Kind,
    problems: &mut Problems,
) -> Option<Expression> {
    let errors = match check(entry, names, problems) {
        Ok(Some(expression)) if expression.kind() != wanted => {
            let length = entry.value.get_ref().as_str().map_or(0, str::len);
            vec![ExpressionError { span: 0..length, problem: Problem::Mismatch(wanted) }]
        }
        Ok(expression) => return expression,
        Err(errors) => errors,
    };
    for error in &errors {
        let diagnostic = report(entry, error, problems);
        if let Problem::UnknownName { name, .. } = &error.problem
            && names.columns.iter().any(|column| column.name == *name)
        {
            diagnostic.help.clear();
            diagnostic.help("it is measured when a point has run: only [measure] can use it");
        }
    }
    None
}

/// The expression that `entry` holds; `None`, with a report, if it holds something else.
///
/// # Errors
/// The mistakes in the expression, not reported yet.
pub(super) fn check(
    entry: &Entry<'_>,
    names: &Names<'_>,
    problems: &mut Problems,
) -> Result<Option<Expression>, Vec<ExpressionError>> {
    if let Some(text) = entry.value.get_ref().as_str() {
        return Expression::parse(text, names).map(Some);
    }
    let found = table::kind(entry.value.get_ref());
    problems
        .report(entry.value.span(), format!("`{}` must be an expression in quotes, not {found}", entry.key))
        .help("expressions look like \"2 * preset.drive_frequency\"");
    Ok(None)
}

/// Reports a mistake in the expression of `entry`, at its place in the file.
pub(super) fn report<'p>(
    entry: &Entry<'_>,
    error: &ExpressionError,
    problems: &'p mut Problems,
) -> &'p mut Diagnostic {
    let text = entry.value.get_ref().as_str().unwrap_or_default();
    let span = value::inside(problems.text(), entry.value.span(), text, &error.span);
    let diagnostic = problems.report(span, error.message());
    if let Some(help) = error.help() {
        diagnostic.help(help);
    }
    diagnostic
}
