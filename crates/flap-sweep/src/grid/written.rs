//! Writes designs as text in the form of device files.

use std::fmt::Write as _;

use flap_core::parameter::Parameter;

use crate::notation::{UserError, text, units};
use crate::plan::uncertainty::Correlation;
use crate::plan::{Plan, Value, not_allowed};

/// Largest width of a comment line in a device file, in characters.
const WIDTH: usize = 110;

const HEAD: &str = "\
# Use this file in place of a preset: `flap run mybee.toml`, or device = \"mybee.toml\" in a grid file.
# A number is in SI units, or text with a unit. It may have a standard error and a source:
#   hinge_stiffness = { value = \"2.1 uN*m/rad\", sd = \"0.1 uN*m/rad\", source = \"bending test, 12 March\" }
# Parameters that are not listed here have the values of the preset.
";

/// Returns the text of a device file with the values that the parameters of a plan have if no axis varies
/// them. If the plan has several designs, the text contains the values of the first design. Derived
/// parameters have the values of their formulas.
///
/// Every parameter has a comment with the description and the range of the parameter. If flap reads the text,
/// it gets exactly the numbers of the plan, bit for bit.
///
/// # Errors
/// - [`UserError`] if a derived parameter depends on an axis or has a value that is not allowed.
/// - [`UserError`] if the drive frequency is the resonance of each design.
///
/// ```
/// use flap_sweep::grid;
///
/// let models = flap_core::simulate::all();
/// let plan = grid::parse("small", "preset = \"ozaki2018-small\"", models).unwrap();
/// let text = grid::device(&plan).unwrap();
/// let again = grid::parse("mybee.toml", &text, models).unwrap();
/// assert_eq!(again.base(), plan.base());
/// ```
pub fn device(plan: &Plan) -> Result<String, UserError> {
    let first = plan.point(0).values;
    let model = plan.simulator();
    let mut page = String::new();
    let _ = writeln!(page, "# A device of the model {}: {}", model.name(), model.doc());
    page += HEAD;
    let _ = write!(page, "\npreset = \"{}\"\n\n[params]\n", plan.preset());
    let mut group = "";
    let named = plan.parameters().iter().zip(plan.base()).enumerate();
    for (index, (parameter, value)) in named.filter(|(index, _)| plan.design() != Some(*index)) {
        if parameter.group != group {
            group = parameter.group;
            let _ = write!(page, "\n# ---- {group} ----\n");
        }
        page.push('\n');
        page += &comment(parameter);
        let value = if plan.derived().parameters().any(|derived| derived == index) {
            Some(derived_value(plan, index, first[index])?)
        } else if let Some(of_designs) = plan.in_designs(index) {
            of_designs.first().copied().filter(|value| !value.is_nan())
        } else if *value == Value::Resonance {
            let message =
                format!("`{}` is the resonance of each design, but a device has one value", parameter.name);
            let help =
                format!("set {} to a number: `flap test resonance` finds the resonance", parameter.name);
            return Err(UserError { message, help: Some(help) });
        } else {
            value.given()
        };
        page += &line(parameter, value, plan.uncertainty().error(index));
    }
    for Correlation { between, coefficient } in plan.uncertainty().correlations() {
        let [one, other] = between.map(|index| plan.parameters()[index].name);
        let _ = write!(
            page,
            "\n[[correlation]]\nbetween = [\"{one}\", \"{other}\"]\ncoefficient = {}\n",
            text::float(*coefficient)
        );
    }
    Ok(page)
}

/// Returns the `value` of a derived parameter. If the value is not allowed, or differs between the points of
/// the plan, returns an error.
fn derived_value(plan: &Plan, index: usize, value: f64) -> Result<f64, UserError> {
    let parameter = &plan.parameters()[index];
    let mut axes = plan.axes().varied().filter(|varied| plan.design() != Some(*varied));
    if let Some(axis) = axes.find(|axis| plan.derived().depends(index, *axis)) {
        let [derived, axis] = [parameter.name, plan.parameters()[axis].name];
        return Err(UserError {
            message: format!(
                "`{derived}` is derived from `{axis}`, which has an axis, but a device has one value"
            ),
            help: Some(format!("set {axis} under [params] instead of its axis")),
        });
    }
    match not_allowed(parameter, value) {
        Some(invalid) => Err(UserError { message: invalid.to_string(), help: None }),
        None => Ok(value),
    }
}

/// Returns a comment with the description, symbol and range of a parameter.
fn comment(parameter: &Parameter) -> String {
    let mut facts = Vec::new();
    if !parameter.symbol.is_empty() {
        facts.push(parameter.symbol.to_owned());
    }
    facts.push(parameter.kind.describe());
    if parameter.is_fitted {
        facts.push("the preset's value was fitted to one vehicle".to_owned());
    }
    wrapped(&format!("{} [{}]", parameter.doc, facts.join("; ")))
}

/// Returns `text` as a comment in lines of at most [`WIDTH`] characters. A line is longer only if it consists
/// of one long word.
fn wrapped(text: &str) -> String {
    let mut page = String::new();
    let mut line = "#".to_owned();
    for word in text.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH && line.len() > 1 {
            page += &line;
            page.push('\n');
            "#".clone_into(&mut line);
        }
        line.push(' ');
        line += word;
    }
    page + &line + "\n"
}

/// Returns the line of a device file for a parameter. If the parameter is not set, the line is a comment.
fn line(parameter: &Parameter, value: Option<f64>, error: Option<f64>) -> String {
    let Parameter { name, unit, .. } = parameter;
    let Some(value) = value else {
        return format!("# {name} = \n");
    };
    let shown = |number: f64| {
        let exact = units::exact(number, unit);
        if unit.is_empty() { exact } else { format!("\"{exact}\"") }
    };
    let value = match text::option(parameter, value) {
        Some(option) => format!("\"{option}\""),
        None => shown(value),
    };
    match error {
        Some(error) => format!("{name} = {{ value = {value}, sd = {} }}\n", shown(error)),
        None => format!("{name} = {value}\n"),
    }
}

/// Returns the text of a device file that is based on the preset or device `base`, with new values of the
/// `parameters` of a wing. `parameters` contains names and values in SI units.
///
/// Values are rounded to ten digits. A comment after each value shows the value of the same parameter in
/// `base`. If the value in `base` was fitted to one vehicle, the comment also contains a note about the fit.
pub fn wing(plan: &Plan, base: &str, parameters: &[(&str, f64)]) -> String {
    let kind = if base == plan.preset() { "preset" } else { "device" };
    let mut page = format!("{kind} = \"{base}\"\n\n[params]\n");
    for (name, value) in parameters {
        let Some(index) = Parameter::index(plan.parameters(), name) else { continue };
        let parameter = &plan.parameters()[index];
        let before = match plan.base()[index] {
            Value::Given(before) => text::shown(parameter, before),
            Value::Follows(_) | Value::Resonance => "not set".to_owned(),
            Value::OfDesign => "a value of each design".to_owned(),
        };
        let line = line(parameter, Some(rounded(*value)), None);
        let fit = if parameter.is_fitted && kind == "preset" { ", a fit to one vehicle" } else { "" };
        let _ = writeln!(page, "{:<56}# before: {before}{fit}", line.trim_end());
    }
    page
}

/// Rounds a number to ten digits. Values that are computed from a wing outline have at most ten accurate
/// digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}
