//! Reads the sections `[axes]` and `[[zip]]` of a grid file, and checks all axes of the grid.

use std::ops::Range;

use flap_core::parameter::Parameter;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostic::Problems;
use super::lookup::Lookup;
use super::table::{self, Entry};
use super::{range, value};
use crate::plan::axes::{Axis, TooManyPoints, Values};

/// An axis and its position in the file.
pub(super) struct Placed {
    pub(super) axis: Axis,
    /// Position of the axis's key, or of the header of the axis's table `[[zip]]`.
    pub(super) span: Range<usize>,
    /// Position of the key of each parameter that the axis varies.
    pub(super) keys: Vec<Range<usize>>,
    /// For each parameter that the axis varies, the result of [`value::has_units`].
    pub(super) with_units: Vec<Option<bool>>,
}

/// Reads the axes of the section `[axes]`.
///
/// If the values of an axis are wrong, the function returns the axis without values, so that later checks can
/// use the axis.
pub(super) fn read(entry: Option<&Entry<'_>>, lookup: &mut Lookup<'_>) -> Vec<Placed> {
    let mut axes = Vec::new();
    for entry in entry.map(|entry| table::section(entry, lookup.problems)).unwrap_or_default() {
        let Some((index, parameter)) = lookup.parameter(&entry) else {
            continue;
        };
        let values = values(parameter, &entry, lookup.problems);
        axes.push(Placed {
            axis: Axis::new(vec![(index, values.unwrap_or_else(none))]),
            span: entry.key_span.clone(),
            keys: vec![entry.key_span],
            with_units: vec![value::has_units(entry.value)],
        });
    }
    axes
}

/// Returns an empty list of values, for an axis whose values in the file are wrong.
pub(super) fn none() -> Values {
    Values::List(Vec::new())
}

/// Reads the values of one parameter along an axis, from a list or a range. If the values are missing or
/// wrong, reports the mistakes and returns `None`.
pub(super) fn values(parameter: &Parameter, entry: &Entry<'_>, problems: &mut Problems) -> Option<Values> {
    match entry.value.get_ref() {
        DeValue::Array(list) if list.is_empty() => {
            problems
                .report(entry.value.span(), format!("the axis `{}` has no values", parameter.name))
                .label("empty list")
                .help("list at least one value, or remove the axis");
            None
        }
        DeValue::Array(list) => {
            let read: Vec<Option<f64>> =
                list.iter().map(|value| value::of_parameter(parameter, value, problems)).collect();
            read.into_iter().collect::<Option<Vec<f64>>>().map(Values::List)
        }
        DeValue::Table(_) => range::read(parameter, entry, problems),
        other => {
            let message = format!(
                "the axis `{}` must be a list or a range, not {}",
                parameter.name,
                table::kind(other)
            );
            problems
                .report(entry.value.span(), message)
                .note("axes look like [1, 2, 5], { from = 1, to = 5, n = 9 } or { from = 1, to = 5, step = 0.5 }")
                .help(format!("to give `{}` a single value, put it under [params]", parameter.name));
            None
        }
    }
}

/// Reports parameters that two axes vary, and parameters that are both in `[params]` and on an axis.
pub(super) fn report_repeats(axes: &[Placed], set: &[(usize, Range<usize>)], lookup: &mut Lookup<'_>) {
    let mut seen: Vec<(usize, Range<usize>)> = Vec::new();
    for placed in axes {
        for ((parameter, _), key) in placed.axis.parameters().iter().zip(&placed.keys) {
            let name = lookup.name(*parameter);
            let other = |places: &[(usize, Range<usize>)]| {
                places.iter().find(|(other, _)| other == parameter).map(|(_, place)| place.clone())
            };
            let varied = other(&seen).map(|place| (place, "varied by two axes", "again here", "first here"));
            let both = "set under [params] and varied by an axis";
            let fixed = || other(set).map(|place| (place, both, "the axis would override it", "set here"));
            if let Some((place, mistake, label, related)) = varied.or_else(fixed) {
                let message = format!("`{name}` is {mistake}");
                let diagnostic = lookup.report(key.clone(), message).label(label);
                diagnostic.related(place, related).help("keep one of them");
            }
            seen.push((*parameter, key.clone()));
        }
    }
}

/// Reports that the axes have more points than a plan can have. The report points to the first axis with
/// which the number of points exceeds the limit.
pub(super) fn report_too_many_points(error: &TooManyPoints, spans: &[Range<usize>], problems: &mut Problems) {
    let span = spans.get(error.axis).cloned().unwrap_or(0..0);
    let lengths: Vec<String> = error.lengths.iter().map(u64::to_string).collect();
    problems
        .report(span, error.to_string())
        .label("too many with this axis")
        .note(format!("points: {}", lengths.join(" × ")))
        .help("use fewer or shorter axes");
}

/// Reads one axis from each table `[[zip]]`.
pub(super) fn read_zip(entry: Option<&Entry<'_>>, lookup: &mut Lookup<'_>) -> Vec<Placed> {
    let Some(entry) = entry else {
        return Vec::new();
    };
    let DeValue::Array(tables) = entry.value.get_ref() else {
        report_not_tables(entry.value, lookup);
        return Vec::new();
    };
    let mut axes = Vec::new();
    for table in tables {
        match table.get_ref() {
            DeValue::Table(parameters) => axes.extend(axis(parameters, table.span(), lookup)),
            _ => report_not_tables(table, lookup),
        }
    }
    axes
}

fn report_not_tables(value: &Spanned<DeValue<'_>>, lookup: &mut Lookup<'_>) {
    let message = match value.get_ref() {
        DeValue::Table(_) => "`zip` must have double brackets, because there may be several".to_owned(),
        other => format!("`zip` must be a table of parameters, not {}", table::kind(other)),
    };
    lookup.report(value.span(), message).help("write [[zip]] above the parameters that move together");
}

fn axis(table: &DeTable<'_>, span: Range<usize>, lookup: &mut Lookup<'_>) -> Option<Placed> {
    let entries = table::entries(table);
    if entries.is_empty() {
        lookup
            .report(span, "this zip has no parameters")
            .help("list the parameters that move together below it, or remove it");
        return None;
    }
    let mut parameters = Vec::new();
    let mut keys: Vec<Range<usize>> = Vec::new();
    let mut with_units = Vec::new();
    // The first list of values without mistakes. The others must have the same length.
    let mut first: Option<(&Entry<'_>, u64)> = None;
    for entry in &entries {
        let Some((index, parameter)) = lookup.parameter(entry) else {
            continue;
        };
        let values = values(parameter, entry, lookup.problems);
        if let Some(values) = &values {
            let (model, length) = *first.get_or_insert((entry, values.len()));
            if values.len() != length {
                report_unequal(entry, values.len(), model, length, lookup);
            }
        }
        parameters.push((index, values.unwrap_or_else(none)));
        keys.push(entry.key_span.clone());
        with_units.push(value::has_units(entry.value));
    }
    Some(Placed { axis: Axis::new(parameters), span, keys, with_units })
}

fn report_unequal(entry: &Entry<'_>, length: u64, first: &Entry<'_>, wanted: u64, lookup: &mut Lookup<'_>) {
    let message = format!(
        "`{}` has {length} values but `{}` has {wanted}: parameters that move together must have the same number of values",
        entry.key, first.key
    );
    lookup
        .report(entry.value.span(), message)
        .label(format!("values: {length}"))
        .related(first.value.span(), format!("values: {wanted}"))
        .help("make them equally long, or use [axes] for every combination");
}
