//! Reads the section `[refine]` of a grid file, which requests additional points between the values of the
//! axes.

use std::ops::Range;

use flap_core::parameter::Parameter;
use toml::Spanned;
use toml::de::DeValue;

use super::axes::Placed;
use super::diagnostic::Problems;
use super::lookup::Lookup;
use super::table::{self, Entry};
use super::value;
use crate::notation::expression;
use crate::notation::text::count;
use crate::plan::Output;
use crate::plan::formula::OwnMeasure;
use crate::plan::refine::{Error, Limit, Refine, not_refined};
use crate::table::labels::split_unit;

pub(super) const KEYS: [&str; 5] = ["measure", "error", "max_points", "along", "halvings"];

/// Contents of the rows that a refinement reads: the names of all measures, the user's measures, and the
/// columns that `[output]` selects.
pub(super) struct Rows<'r> {
    pub(super) columns: &'r [String],
    pub(super) own: &'r [OwnMeasure],
    pub(super) output: &'r Output,
}

/// Returns the refinement that the section `[refine]` requests for the given axes.
pub(super) fn read(
    section: &Entry<'_>,
    axes: &[Placed],
    sample: Option<&Entry<'_>>,
    rows: &Rows<'_>,
    lookup: &mut Lookup<'_>,
) -> Option<Refine> {
    let entries = table::section(section, lookup.problems);
    table::check_keys(&entries, &KEYS, "in [refine]", lookup.problems);
    if let Some(sample) = sample {
        lookup
            .report(section.key_span.clone(), "[refine] adds points between axes, but the grid has a sample")
            .related(sample.key_span.clone(), "the sample")
            .help("vary the parameters of the sample under [axes], or remove [refine]");
        return None;
    }
    for key in ["measure", "error", "max_points"] {
        if table::find(&entries, key).is_none() {
            let example = match key {
                "measure" => "measure = \"lift_mean_mn\"",
                "error" => "error = \"1 %\"",
                _ => "max_points = 2000",
            };
            let message = format!("[refine] lacks `{key}`");
            lookup.report(section.key_span.clone(), message).help(format!("write {example} under [refine]"));
        }
    }
    let along = along(section, table::find(&entries, "along"), axes, lookup);
    let halvings = table::find(&entries, "halvings")
        .map_or(Some(u64::from(Refine::HALVINGS)), |entry| {
            value::count("halvings", u64::from(Refine::MOST_HALVINGS), entry.value, lookup.problems)
        })
        .and_then(|halvings| u32::try_from(halvings).ok());
    let max_points =
        table::find(&entries, "max_points").and_then(|entry| max_points(entry, axes, lookup.problems));
    let measures = table::find(&entries, "measure").map(|entry| measures(entry, rows, lookup));
    let errors = table::find(&entries, "error").zip(measures.as_ref());
    let errors = errors.map(|(entry, measures)| errors_of(entry, measures, lookup.problems));
    let limits = measures?.into_iter().zip(errors?);
    let measures = limits.filter_map(|(column, error)| error.map(|error| Limit { column, error })).collect();
    Some(Refine { measures, along: along?, max_points: max_points?, halvings: halvings? })
}

/// Returns the indices of the axes along which points are added: the axes of the parameters in the key
/// `along`. Without this key, returns all axes that allow additional values.
fn along(
    section: &Entry<'_>,
    listed: Option<&Entry<'_>>,
    axes: &[Placed],
    lookup: &mut Lookup<'_>,
) -> Option<Vec<usize>> {
    let parameters = lookup.robot.parameters();
    let mut along = if let Some(entry) = listed {
        listed_axes(entry, axes, lookup)
    } else {
        let refined = |place: &usize| not_refined(&axes[*place].axis, parameters).is_none();
        (0..axes.len()).filter(refined).collect()
    };
    along.sort_unstable();
    let span = listed.map_or(section.key_span.clone(), |entry| entry.value.span());
    if along.is_empty() && listed.is_none() {
        lookup
            .report(span, "[refine] has no axis along which it can add points")
            .note("it needs an axis of one numeric parameter, with two or more rising or falling values")
            .help("add such an axis under [axes], or remove [refine]");
        return None;
    }
    if along.len() > Refine::MOST_AXES {
        let message =
            format!("[refine] adds points along at most {} axes, not {}", Refine::MOST_AXES, along.len());
        let help = "list fewer parameters: along = [\"drive_voltage_pp\", \"drive_frequency\"]";
        lookup.report(span, message).help(help);
        return None;
    }
    Some(along)
}

/// Returns the indices of the axes that vary the parameters in the list `along`.
fn listed_axes(entry: &Entry<'_>, axes: &[Placed], lookup: &mut Lookup<'_>) -> Vec<usize> {
    let help = "remove `along` to add points along all axes of numbers";
    let mut along = Vec::new();
    for (name, span) in value::names(entry, "a list of parameters under [axes]", help, lookup.problems) {
        let Some((index, _)) = lookup.named(name, span.clone()) else { continue };
        let varies = |placed: &Placed| placed.axis.parameters().iter().any(|(varied, _)| *varied == index);
        let Some(place) = axes.iter().position(varies) else {
            lookup.report(span, format!("`{name}` has no axis")).help(format!("vary `{name}` under [axes]"));
            continue;
        };
        if let Some(reason) = not_refined(&axes[place].axis, lookup.robot.parameters()) {
            lookup
                .report(span, format!("no points can be added along `{name}`: {reason}"))
                .related(axes[place].span.clone(), "its axis")
                .help(format!("remove `{name}`: each of its values then gets a separate map"));
        }
        along.push(place);
    }
    along
}

/// Returns the value of `max_points`, which must be larger than the number of points of the axes.
fn max_points(entry: &Entry<'_>, axes: &[Placed], problems: &mut Problems) -> Option<u64> {
    let most = value::count("max_points", Refine::MOST_POINTS, entry.value, problems)?;
    let points = axes.iter().try_fold(1_u64, |points, placed| points.checked_mul(placed.axis.len()))?;
    if most > points {
        return Some(most);
    }
    let message = format!("`max_points` must be more than the {} of the axes", count(points, "point"));
    problems.report(entry.value.span(), message).help(
        "raise `max_points`, or give the axes fewer values: [refine] adds points where they are needed",
    );
    None
}

/// Returns the names of the measures that the key `measure` lists.
fn measures(entry: &Entry<'_>, rows: &Rows<'_>, lookup: &mut Lookup<'_>) -> Vec<String> {
    let names = if entry.value.get_ref().is_str() {
        let name = value::text(entry.key, entry.value, lookup.problems);
        name.map(|name| (name, entry.value.span())).into_iter().collect()
    } else {
        let wanted = "the name of a measure, or a list of names";
        value::names(entry, wanted, "", lookup.problems)
    };
    for (name, span) in &names {
        check_measure(name, span, rows, lookup);
    }
    names.into_iter().map(|(name, _)| name.to_owned()).collect()
}

/// If rows do not contain the measure `name`, or the measure is not a number, reports a mistake.
fn check_measure(name: &str, span: &Range<usize>, rows: &Rows<'_>, lookup: &mut Lookup<'_>) {
    let problems = &mut *lookup.problems;
    let Some(index) = rows.columns.iter().position(|known| known == name) else {
        if Parameter::index(lookup.robot.parameters(), name).is_some() {
            problems.report(span.clone(), format!("`{name}` is a parameter, not a measure"));
            return;
        }
        let model = lookup.robot.name();
        problems
            .report(span.clone(), format!("model `{model}` has no measure `{name}`"))
            .label("unknown measure")
            .note(format!("measures: {}", rows.columns.join(", ")))
            .did_you_mean(name, rows.columns.iter().map(String::as_str));
        return;
    };
    let own = rows.own.iter().find(|own| own.name == name);
    if own.is_some_and(|own| own.kind() != expression::Kind::Number) {
        problems
            .report(span.clone(), format!("`{name}` is true or false, and cannot be interpolated"))
            .help("name a measure that is a number");
    }
    if rows.output.columns.as_ref().is_some_and(|chosen| !chosen.contains(&index)) {
        problems
            .report(span.clone(), format!("`{name}` is not among the `columns` of [output]"))
            .note("an interrupted sweep reads its measures from the rows")
            .help(format!("add \"{name}\" to `columns`"));
    }
}

/// Returns the largest allowed interpolation error of each measure. The file contains one allowed error for
/// all measures, or a list with one allowed error for each measure.
fn errors_of(entry: &Entry<'_>, measures: &[String], problems: &mut Problems) -> Vec<Option<Error>> {
    let DeValue::Array(list) = entry.value.get_ref() else {
        return measures.iter().map(|measure| error(measure, entry.value, problems)).collect();
    };
    if list.len() != measures.len() {
        let message = format!(
            "`error` has {}, but `measure` has {}",
            count(list.len() as u64, "value"),
            measures.len()
        );
        problems.report(entry.value.span(), message).help("give one error for all measures, or one for each");
        return vec![None; measures.len()];
    }
    measures.iter().zip(list).map(|(measure, item)| error(measure, item, problems)).collect()
}

/// Returns the largest allowed interpolation error of a measure: a percentage, such as `"1 %"`, or a number
/// in the unit of the measure.
fn error(measure: &str, item: &Spanned<DeValue<'_>>, problems: &mut Problems) -> Option<Error> {
    let is_share = item.get_ref().as_str().is_some_and(|text| text.trim_end().ends_with('%'));
    if item.get_ref().as_str().is_some() && !is_share {
        let (_, unit) = split_unit(measure);
        let unit = if unit.is_empty() { "without a unit".to_owned() } else { format!("in {unit}") };
        problems
            .report(item.span(), "`error` is a share such as \"1 %\", or a bare number")
            .help(format!("write \"1 %\" for a share of the range of `{measure}`, or a number {unit}"));
        return None;
    }
    let number = value::quantity("error", "", item, problems)?;
    if number > 0.0 && number.is_finite() && !(is_share && number >= 1.0) {
        return Some(if is_share { Error::Share(number) } else { Error::Absolute(number) });
    }
    let allowed = if is_share { "more than 0 % and less than 100 %" } else { "more than zero" };
    problems.report(item.span(), format!("`error` must be {allowed}"));
    None
}
