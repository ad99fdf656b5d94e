//! Reads the expressions in the sections `[derived]`, `[where]` and `[measure]` of a grid file, and looks up
//! the names in the expressions.

use std::ops::Range;

use flap_core::parameter::{Kind as ParameterKind, Parameter};
use flap_core::simulate::Column;
use flap_core::vehicle::of_all_wings;

use super::axes::Placed;
use super::diagnostic::{Diagnostic, Problems};
use super::lookup::Lookup;
use super::table::{self, Entry};
use super::value;
use crate::notation::expression::{self, Expression, ExpressionError, Kind, Meaning, Mistake, Scope};
use crate::plan::Value;
use crate::plan::formula::{Condition, Derived, OwnMeasure};
use crate::table::layout::is_fixed;

/// Prefix for the value of a parameter in the preset, as in `preset.drive_frequency`.
const PRESET: &str = "preset.";

/// Prefix for the value of a parameter in the device, as in `device.drive_frequency`.
const DEVICE: &str = "device.";

/// Words in messages for the value of a drive frequency that is set to the resonance of each design.
const RESONANCE: &str = "the resonance of each design, whose name in [measure] is resonance_hz";

/// The names that expressions may contain: parameters, values of parameters in the preset or the device, and
/// measures. The numbers that an expression reads have this order: parameters, the model's measures, the
/// user's measures.
pub(super) struct Names<'n> {
    pub(super) parameters: &'n [Parameter<'n>],
    /// For each design, the values of the parameters in its preset.
    pub(super) preset: Vec<Vec<Value>>,
    /// For each design, the values of the parameters in its device, if the grid file names devices.
    pub(super) device: Option<Vec<Vec<Value>>>,
    /// For each parameter that is not set, a description of the parameters that determine its value.
    pub(super) unset: Vec<Option<&'static str>>,
    /// Parameters that the search for hover changes, so that their values are unknown before flap computes a
    /// point.
    pub(super) inputs: Vec<usize>,
    /// Measures of the model, without the user's measures.
    pub(super) columns: Vec<Column>,
    /// True if expressions may contain measures. The values of measures are unknown before flap computes a
    /// point.
    pub(super) are_measured: bool,
    /// Measures of the user that expressions may contain.
    pub(super) own: Vec<OwnMeasure>,
}

/// If a parameter is not set, returns a description of the parameters that determine its value.
pub(super) fn followed(value: Value) -> Option<&'static str> {
    match value {
        Value::Given(_) | Value::OfDesign => None,
        Value::Follows(follows) => Some(follows),
        Value::Resonance => Some(RESONANCE),
    }
}

impl Names<'_> {
    fn parameter(&self, name: &str) -> Option<usize> {
        Parameter::index(self.parameters, name)
    }

    /// Returns the index of the parameter that determines the value of parameter number `index`. If a
    /// parameter of one wing is not set, the corresponding parameter of all wings determines its value.
    pub(super) fn standing(&self, index: usize) -> usize {
        let shared = of_all_wings(self.parameters, index).filter(|_| self.unset[index].is_some());
        shared.unwrap_or(index)
    }

    fn of_parameter(&self, index: usize) -> Meaning<'_> {
        let index = self.standing(index);
        match (&self.parameters[index].kind, self.unset[index]) {
            (ParameterKind::Choice(options), _) => Meaning::Choice(index, options),
            (_, Some(follows)) => {
                let designs = self.device.as_ref().unwrap_or(&self.preset);
                let is_unset = designs.iter().map(|design| followed(design[index]).is_some());
                Meaning::Unset(follows, self.unset_designs(&is_unset.collect::<Vec<_>>()))
            }
            (_, None) => Meaning::Number(index),
        }
    }

    /// Returns the meaning of a name such as `preset.hinge_stiffness`: one number, or one number for each
    /// design. `designs` contains the parameter values of the presets or of the devices.
    fn of_fixed(&self, designs: &[Vec<Value>], index: usize) -> Option<Meaning<'_>> {
        if let ParameterKind::Choice(_) = self.parameters[index].kind {
            return None;
        }
        let value = |design: &Vec<Value>| {
            let shared = of_all_wings(self.parameters, index).filter(|_| design[index].given().is_none());
            design[shared.unwrap_or(index)]
        };
        let values: Vec<Value> = designs.iter().map(value).collect();
        if let Some(follows) = values.iter().find_map(|value| followed(*value)) {
            let is_unset: Vec<bool> = values.iter().map(|value| followed(*value).is_some()).collect();
            return Some(Meaning::Unset(follows, self.unset_designs(&is_unset)));
        }
        let numbers: Vec<f64> = values.iter().map(|value| value.in_point()).collect();
        let first = *numbers.first()?;
        let are_equal = numbers.iter().all(|number| number.to_bits() == first.to_bits());
        // The last parameter names the design.
        let design = self.parameters.len() - 1;
        Some(if are_equal { Meaning::Constant(first) } else { Meaning::OfChoice(design, numbers.into()) })
    }

    /// Returns text that names the designs without a value, for example "the device `long`". If no design has
    /// a value, the text is empty.
    fn unset_designs(&self, is_unset: &[bool]) -> String {
        // The last parameter names the design.
        let Some(Parameter { name, kind: ParameterKind::Choice(labels), .. }) = self.parameters.last() else {
            return String::new();
        };
        if is_unset.iter().all(|is_unset| *is_unset) {
            return String::new();
        }
        let unset = labels.iter().zip(is_unset).filter(|(_, is_unset)| **is_unset);
        let unset: Vec<String> = unset.map(|(label, _)| format!("`{label}`")).collect();
        format!("the {name}{} {}", if unset.len() > 1 { "s" } else { "" }, unset.join(", "))
    }

    fn of_measure(&self, name: &str) -> Option<Meaning<'_>> {
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
    fn meaning(&self, name: &str) -> Option<Meaning<'_>> {
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
            let constant = |index: &usize| {
                matches!(self.of_fixed(design, *index), Some(Meaning::Constant(_) | Meaning::OfChoice(..)))
            };
            let named = move |index: usize| prefix.to_owned() + self.parameters[index].name;
            (0..self.parameters.len()).filter(constant).map(named).collect::<Vec<_>>()
        });
        let columns = self.columns.iter().filter(|_| self.are_measured).map(|column| column.name.clone());
        let own = self.own.iter().map(|own| own.name.clone());
        parameters.chain(fixed).chain(columns).chain(own).collect()
    }
}

/// Parses the expression in `entry`. `wanted` states if the expression must be a number or a condition. The
/// expression may contain only values that are known before flap computes points.
///
/// If the expression has mistakes, reports the mistakes and returns `None`.
pub(super) fn read(
    entry: &Entry<'_>,
    names: &Names<'_>,
    wanted: Kind,
    problems: &mut Problems,
) -> Option<Expression> {
    let errors = match check(entry, names, problems) {
        Ok(Some(expression)) if expression.kind() != wanted => {
            let length = entry.value.get_ref().as_str().map_or(0, str::len);
            vec![ExpressionError::mismatch(0..length, wanted)]
        }
        Ok(expression) => {
            let input =
                expression.iter().flat_map(Expression::reads).find(|place| names.inputs.contains(place));
            if let Some(input) = input {
                let name = names.parameters[input].name;
                let message =
                    format!("`{}` depends on {name}, which the search for hover changes", entry.key);
                let help = "only [measure] can use the inputs of hover; filter rows by the columns hover_…";
                problems.report(entry.value.span(), message).help(help);
                return None;
            }
            return expression;
        }
        Err(errors) => errors,
    };
    for error in &errors {
        let diagnostic = report(entry, error, problems);
        if let Mistake::UnknownName(name) = &error.mistake
            && names.columns.iter().any(|column| column.name == *name)
        {
            diagnostic.help.clear();
            diagnostic.help("its value is known only after a point has run: use it in [measure]");
        }
    }
    None
}

/// Parses the expression in `entry`. If the value of the entry is not text, reports a mistake and returns
/// `None`.
///
/// # Errors
/// Returns the mistakes in the expression, without reporting them.
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

/// Reports a mistake in the expression of `entry`, at the position of the mistake in the file.
pub(super) fn report<'p>(
    entry: &Entry<'_>,
    error: &ExpressionError,
    problems: &'p mut Problems,
) -> &'p mut Diagnostic {
    let text = entry.value.get_ref().as_str().unwrap_or_default();
    let span = value::inside(problems.text(), entry.value.span(), text, &error.span);
    let diagnostic = problems.report(span, error.message.as_str());
    if let Some(help) = &error.help {
        diagnostic.help(help.as_str());
    }
    diagnostic
}

/// Index of a parameter that the file sets, and the position of the parameter's key in the file.
pub(super) type Place = (usize, Range<usize>);

/// Returns the indices of the parameters in the section `[derived]`, each with its entry in the file.
pub(super) fn derived_drafts<'t>(
    entry: Option<&Entry<'t>>,
    lookup: &mut Lookup<'_>,
) -> Vec<(usize, Entry<'t>)> {
    let mut drafts = Vec::new();
    for entry in entry.map(|entry| table::section(entry, lookup.problems)).unwrap_or_default() {
        let Some((index, parameter)) = lookup.parameter(&entry) else {
            continue;
        };
        if let ParameterKind::Choice(_) = parameter.kind {
            lookup
                .report(entry.key_span, format!("`{}` is a choice and cannot be derived", parameter.name))
                .help("expressions are numbers: set it under [params], or vary it under [axes]");
            continue;
        }
        drafts.push((index, entry));
    }
    drafts
}

/// Reports derived parameters that are also varied or set. `set` contains lists of parameters. Before each
/// list are words for the message, such as "set under [params]".
pub(super) fn report_derived_twice(
    drafts: &[(usize, Entry<'_>)],
    axes: &[Placed],
    set: &[(&str, &[Place])],
    problems: &mut Problems,
) {
    for (parameter, entry) in drafts {
        let varied = axes.iter().flat_map(|placed| placed.axis.parameters().iter().zip(&placed.keys));
        let varied = varied.filter(|((other, _), _)| other == parameter).map(|(_, key)| (key, "varied"));
        let fixed = set.iter().flat_map(|(how, set)| set.iter().map(move |(other, key)| (other, key, *how)));
        let fixed = fixed.filter(|(other, ..)| *other == parameter).map(|(_, key, how)| (key, how));
        for (key, how) in varied.chain(fixed) {
            problems
                .report(entry.key_span.clone(), format!("`{}` is derived and {how}", entry.key))
                .label("derived here")
                .related(key.clone(), format!("{how} here"))
                .help("keep one of them");
        }
    }
}

/// Reads the formulas of the section `[derived]`, and finds an order in which the formulas can be computed.
pub(super) fn read_derived(
    drafts: &[(usize, Entry<'_>)],
    names: &Names<'_>,
    problems: &mut Problems,
) -> Derived {
    let mut formulas: Vec<(usize, Expression)> = Vec::new();
    let mut entries: Vec<&Entry<'_>> = Vec::new();
    for (parameter, entry) in drafts {
        if let Some(expression) = read(entry, names, Kind::Number, problems) {
            formulas.push((*parameter, expression));
            entries.push(entry);
        }
    }
    let dependencies: Vec<Vec<usize>> =
        formulas.iter().map(|(_, expression)| dependencies(expression, &formulas)).collect();
    let order = order(&dependencies);
    if order.len() < formulas.len() {
        report_cycles(&dependencies, &order, &entries, problems);
    }
    Derived::new(formulas, order)
}

/// Returns the indices of the formulas on which `expression` depends.
fn dependencies(expression: &Expression, formulas: &[(usize, Expression)]) -> Vec<usize> {
    expression
        .reads()
        .filter_map(|parameter| formulas.iter().position(|(derived, _)| *derived == parameter))
        .collect()
}

/// Returns the indices of the formulas, in an order in which each formula comes after all formulas on which
/// it depends. The result leaves out formulas that depend on themselves, and formulas that depend on a
/// formula that is left out.
fn order(dependencies: &[Vec<usize>]) -> Vec<usize> {
    let mut order: Vec<usize> = Vec::new();
    let mut waiting: Vec<usize> = (0..dependencies.len()).collect();
    loop {
        let ready = |place: &usize| dependencies[*place].iter().all(|needed| order.contains(needed));
        let (now, later): (Vec<usize>, Vec<usize>) = waiting.iter().partition(|place| ready(place));
        if now.is_empty() {
            return order;
        }
        order.extend(now);
        waiting = later;
    }
}

/// Reports formulas that depend on themselves, once for each cycle of formulas. `order` contains the formulas
/// that depend on no cycle.
fn report_cycles(
    dependencies: &[Vec<usize>],
    order: &[usize],
    entries: &[&Entry<'_>],
    problems: &mut Problems,
) {
    let mut visited: Vec<usize> = order.to_vec();
    for start in 0..dependencies.len() {
        // Follows dependencies from formula to formula until one repeats: in this path or an earlier one.
        let mut chain: Vec<usize> = Vec::new();
        let mut next = Some(start);
        while let Some(place) = next.filter(|place| !visited.contains(place)) {
            visited.push(place);
            chain.push(place);
            next = dependencies[place].iter().copied().find(|needed| !order.contains(needed));
        }
        let Some(begin) = chain.iter().position(|place| Some(*place) == next) else {
            continue;
        };
        let cycle = &chain[begin..];
        let closed = cycle.iter().chain(cycle.first()).map(|&place| entries[place].key);
        let path = closed.collect::<Vec<_>>().join(" from ");
        let first = entries[cycle[0]];
        let diagnostic = problems
            .report(first.key_span.clone(), format!("`{}` is derived from itself: {path}", first.key));
        for &place in &cycle[1..] {
            diagnostic.related(entries[place].key_span.clone(), "through this");
        }
        diagnostic.help("use `preset.` for the value in the preset, or set one of them under [params]");
    }
}

/// Reads the conditions of the section `[where]`, in the order of the file.
pub(super) fn read_conditions(
    entry: Option<&Entry<'_>>,
    names: &Names<'_>,
    problems: &mut Problems,
) -> Vec<Condition> {
    let mut conditions = Vec::new();
    for entry in entry.map(|entry| table::section(entry, problems)).unwrap_or_default() {
        if let Some(expression) = read(&entry, names, Kind::Condition, problems) {
            conditions.push(Condition { name: entry.key.to_owned(), expression });
        }
    }
    conditions
}

/// Adds the measures of the section `[measure]` to `names`, one by one. The expression of a measure may
/// contain measures that are above this measure in the file.
///
/// Returns the names of all measures, including measures with wrong expressions.
pub(super) fn read_measures(
    entry: Option<&Entry<'_>>,
    names: &mut Names<'_>,
    problems: &mut Problems,
) -> Vec<String> {
    let entries = entry.map(|entry| table::section(entry, problems)).unwrap_or_default();
    for (place, entry) in entries.iter().enumerate() {
        if !is_valid_name(entry.key, names) {
            report_name(entry, problems);
            continue;
        }
        match check(entry, names, problems) {
            Ok(Some(expression)) => names.own.push(OwnMeasure { name: entry.key.to_owned(), expression }),
            Ok(None) => {}
            Err(errors) => {
                for error in errors {
                    let unknown = match &error.mistake {
                        Mistake::UnknownName(name) => entries.iter().position(|entry| entry.key == name),
                        _ => None,
                    };
                    // The mistake in the earlier measure is reported there.
                    if unknown.is_some_and(|unknown| unknown < place) {
                        continue;
                    }
                    let diagnostic = report(entry, &error, problems);
                    if unknown.is_some() {
                        diagnostic.help.clear();
                        diagnostic.help("a measure can use only the measures above it");
                    }
                }
            }
        }
    }
    let valid = entries.iter().filter(|entry| is_valid_name(entry.key, names));
    valid.map(|entry| entry.key.to_owned()).collect()
}

/// Returns true if `name` is a valid name for a measure of the user.
fn is_valid_name(name: &str, names: &Names<'_>) -> bool {
    expression::is_free_name(name)
        && !is_fixed(name)
        && names.parameters.iter().all(|parameter| parameter.name != name)
        && names.columns.iter().all(|column| column.name != name)
}

fn report_name(entry: &Entry<'_>, problems: &mut Problems) {
    problems
        .report(entry.key_span.clone(), format!("a measure cannot be called `{}`", entry.key))
        .note("a name has letters, digits and _, and differs from names of parameters, columns and functions")
        .help("give it another name");
}
