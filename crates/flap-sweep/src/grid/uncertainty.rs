//! Reads values with a standard error, such as `{ value, sd, source }` in `[params]`, and the tables
//! `[[correlation]]`.

use flap_core::parameter::{Kind, Parameter};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostic::Problems;
use super::lookup::Lookup;
use super::table::{self, Entry};
use super::value;
use crate::plan::uncertainty::{Correlation, Uncertainty};

pub(super) const VALUE_KEYS: [&str; 4] = ["value", "sd", "relative_sd", "source"];
pub(super) const CORRELATION_KEYS: [&str; 2] = ["between", "coefficient"];

/// Returns the value of a parameter from an entry of `[params]`, and the standard error of this value if
/// there is one.
///
/// If the entry has mistakes, reports the mistakes and returns `None` as the value.
pub(super) fn of_parameter(
    parameter: &Parameter,
    entry: &Entry<'_>,
    problems: &mut Problems,
) -> (Option<f64>, Option<f64>) {
    match entry.value.get_ref() {
        DeValue::Table(table) if !is_range(table) => of_table(parameter, entry, table, problems),
        _ => (value::of_parameter(parameter, entry.value, problems), None),
    }
}

/// Returns true if the table is a range, which is allowed for axes but not for single values.
fn is_range(table: &DeTable<'_>) -> bool {
    ["from", "to", "values"].into_iter().any(|key| table.contains_key(key))
}

fn of_table(
    parameter: &Parameter,
    entry: &Entry<'_>,
    table: &DeTable<'_>,
    problems: &mut Problems,
) -> (Option<f64>, Option<f64>) {
    let entries = table::entries(table);
    if !table::check_keys(&entries, &VALUE_KEYS, "of a value", problems) {
        return (None, None);
    }
    if let Some(source) = table::find(&entries, "source") {
        value::text("source", source.value, problems);
    }
    let Some(given) = table::find(&entries, "value") else {
        problems
            .report(entry.value.span(), format!("`{}` has no `value`", entry.key))
            .note("values look like 2.1e-6, \"2.1 uN*m/rad\" or { value = \"2.1 uN*m/rad\", sd = \"0.1 uN*m/rad\" }");
        return (None, None);
    };
    let number = value::of_parameter(parameter, given.value, problems);
    (number, number.and_then(|number| standard_error(parameter, number, &entries, problems)))
}

/// Returns the standard error of a parameter, in the SI unit of the parameter.
fn standard_error(
    parameter: &Parameter,
    number: f64,
    entries: &[Entry<'_>],
    problems: &mut Problems,
) -> Option<f64> {
    let (absolute, relative) = (table::find(entries, "sd"), table::find(entries, "relative_sd"));
    let entry = absolute.or(relative)?;
    if let Kind::Choice(_) = parameter.kind {
        let message = format!("`{}` is a choice and has no standard error", parameter.name);
        problems.report(entry.key_span.clone(), message).help(format!("remove `{}`", entry.key));
        return None;
    }
    if let (Some(_), Some(relative)) = (absolute, relative) {
        let message = "a value takes `sd` or `relative_sd`, not both";
        problems.report(relative.key_span.clone(), message).help("keep one of them");
        return None;
    }
    if absolute.is_some() && report_share(entry, problems) {
        return None;
    }
    let unit = if absolute.is_some() { parameter.unit } else { "" };
    let given = value::quantity(entry.key, unit, entry.value, problems)?;
    let error = if absolute.is_some() { given } else { given * number.abs() };
    if error > 0.0 && error.is_finite() {
        return Some(error);
    }
    let message =
        format!("`{}` must give a standard error of more than zero, not {}", entry.key, value::shown(error));
    problems.report(entry.value.span(), message).help("leave it out if the value is exact");
    None
}

/// If the standard deviation `sd` is in per cent, reports a mistake and returns true.
pub(super) fn report_share(sd: &Entry<'_>, problems: &mut Problems) -> bool {
    let is_share = sd.value.get_ref().as_str().is_some_and(|text| text.trim_end().ends_with('%'));
    if is_share {
        problems
            .report(sd.value.span(), "`sd` is in the unit of the parameter, not a share of its value")
            .help("write `relative_sd` for a share");
    }
    is_share
}

/// Reads the correlations in the tables `[[correlation]]`, and adds them to `uncertainty`.
pub(super) fn correlations(
    entry: Option<&Entry<'_>>,
    uncertainty: &mut Uncertainty,
    lookup: &mut Lookup<'_>,
) {
    let Some(entry) = entry else { return };
    let DeValue::Array(tables) = entry.value.get_ref() else {
        report_not_tables(entry.value, lookup.problems);
        return;
    };
    let before = lookup.problems.count();
    let mut pairs = Vec::new();
    for table in tables {
        match table.get_ref() {
            DeValue::Table(entries) => pairs.extend(correlation(entries, table, &pairs, uncertainty, lookup)),
            _ => report_not_tables(table, lookup.problems),
        }
    }
    if lookup.problems.count() == before && uncertainty.factor().is_none() {
        lookup.report(entry.key_span.clone(), "the correlations contradict each other")
            .note("no parameters can have all these correlations at once: the correlation matrix is not positive definite")
            .help("take all correlations from one fit, with enough digits");
    }
}

fn report_not_tables(value: &Spanned<DeValue<'_>>, problems: &mut Problems) {
    problems
        .report(value.span(), format!("`correlation` is not {}", table::kind(value.get_ref())))
        .help("write [[correlation]] above `between` and `coefficient`, once for each pair");
}

/// Reads a correlation, adds it to `uncertainty`, and returns its two parameters. `earlier` contains the
/// pairs of parameters whose correlations have already been read.
fn correlation(
    table: &DeTable<'_>,
    place: &Spanned<DeValue<'_>>,
    earlier: &[[usize; 2]],
    uncertainty: &mut Uncertainty,
    lookup: &mut Lookup<'_>,
) -> Option<[usize; 2]> {
    let entries = table::entries(table);
    if !table::check_keys(&entries, &CORRELATION_KEYS, "in [[correlation]]", lookup.problems) {
        return None;
    }
    let (Some(between), Some(coefficient)) =
        (table::find(&entries, "between"), table::find(&entries, "coefficient"))
    else {
        let message = "a correlation has two parameters and a coefficient";
        let help = "write between = [\"hinge_stiffness\", \"wing_area\"] and coefficient = 0.4";
        lookup.report(place.span(), message).help(help);
        return None;
    };
    let number = value::number("coefficient", coefficient.value, lookup.problems);
    let pair = pair(between, uncertainty, lookup)?;
    let number = number?;
    if number.abs() >= 1.0 {
        let message = format!("`coefficient` must be between -1 and 1, not {}", value::shown(number));
        lookup.report(coefficient.value.span(), message);
        return None;
    }
    let [one, other] = pair;
    if earlier.contains(&pair) || earlier.contains(&[other, one]) {
        let message = "the correlation of these two parameters is given twice";
        lookup.report(between.value.span(), message).help("remove one of them");
        return None;
    }
    uncertainty.correlate(Correlation { between: pair, coefficient: number });
    Some(pair)
}

/// Returns the two parameters of a correlation, both of which must have standard errors.
fn pair(entry: &Entry<'_>, uncertainty: &Uncertainty, lookup: &mut Lookup<'_>) -> Option<[usize; 2]> {
    let names = entry.value.get_ref().as_array().filter(|names| names.len() == 2);
    let Some(names) = names else {
        lookup
            .report(entry.value.span(), "`between` must be a list of two parameters")
            .help("write between = [\"hinge_stiffness\", \"wing_area\"]");
        return None;
    };
    let mut pair = Vec::new();
    for name in names {
        let text = value::text("between", name, lookup.problems)?;
        let (index, parameter) = lookup.named(text, name.span())?;
        if uncertainty.error(index).is_none() {
            lookup
                .report(name.span(), format!("`{}` has no standard error", parameter.name))
                .help(format!("write {} = {{ value = ..., sd = ... }} under [params]", parameter.name));
            return None;
        }
        pair.push(index);
    }
    if pair[0] == pair[1] {
        lookup.report(entry.value.span(), "`between` names one parameter twice");
        return None;
    }
    Some([pair[0], pair[1]])
}
