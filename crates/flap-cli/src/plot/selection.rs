//! Selects the rows that a picture shows, and describes the selection in notes.

use super::kind::{self, Columns};
use super::request::Request;
use super::scale;
use super::slices;
use crate::args::{Aim, Filter, PictureKind};
use crate::console;
use crate::data::axes::Axes;
use crate::data::columns::{Cells, Column, Table};
use crate::data::filter;
use crate::failure::Failure;

/// The columns and rows that a picture shows, with the title and the notes.
pub(super) struct Selection {
    pub(super) columns: Columns,
    /// For each of the columns x and y, whether larger or smaller values are better.
    pub(super) aims: (Aim, Aim),
    pub(super) rows: Vec<usize>,
    /// The columns of all parameters. Sampled parameters are first.
    pub(super) parameters: Vec<usize>,
    /// True if the designs are a sample.
    pub(super) sampled: bool,
    pub(super) title: String,
    /// Texts below the title about conditions on rows and chosen values of axes.
    pub(super) notes: Vec<String>,
}

impl Selection {
    /// Returns the failure for a picture in which no selected row has a number in `column`.
    pub(super) fn no_numbers(&self, table: &Table, column: usize) -> Failure {
        let (name, rows) = (&table.columns[column].name, self.rows.len());
        let message = format!("none of {rows} rows has a value of {name}: there is nothing to draw");
        Failure::usage(message).help(
            "points whose status is not `periodic` have no measures; `flap results rerun` runs them again",
        )
    }
}

/// Chooses the kind, the columns and the rows of the picture.
pub(super) fn select(request: &Request, table: &Table, title: String) -> Result<Selection, Failure> {
    let axes = Axes::of(table, request.parameters_end);
    let mut free = axes.clone();
    free.columns.retain(|axis| !request.best_over.contains(axis));
    let columns = kind::columns(request, &free)?;
    let filters = filters(request, table, columns.kind);
    let rows = slices::filtered(table, &filters)?;
    check_span(table, &columns, &rows)?;
    let mut notes: Vec<String> = (filters.iter())
        .map(|(column, value)| format!("{} {}", table.label(*column).words, shown(table, *column, value)))
        .collect();
    notes.extend(request.args.filters.iter().filter_map(|filter| match filter {
        Filter::Comparison(text) => Some(filter::printed(text)),
        Filter::Equal(..) => None,
    }));
    let mut hidden = hidden(&columns, &axes);
    check_best_over(request, &hidden)?;
    hidden.retain(|axis| !request.best_over.contains(axis));
    let (mut rows, chosen) = slices::sliced(table, &hidden, rows);
    if !request.best_over.is_empty() {
        notes.push(format!("best over {}", request.listed(&request.best_over)));
        rows = best(request, table, &columns, &axes, &rows)?;
    }
    for [message, note] in chosen {
        console::say(&message);
        notes.push(note);
    }
    let mut parameters: Vec<usize> = (1..request.parameters_end).collect();
    let sample = table.sample.as_deref().unwrap_or_default();
    parameters.sort_by_key(|&column| !sample.contains(&table.columns[column].name));
    let aims = aims(request, &columns);
    Ok(Selection { columns, aims, rows, parameters, sampled: axes.sampled, title, notes })
}

/// Returns the conditions `COLUMN=VALUE`. If a map has no condition for the branch of a response, the
/// function adds the condition that the branch is `up`.
fn filters(request: &Request, table: &Table, kind: PictureKind) -> Vec<(usize, String)> {
    let mut filters = request.filters.clone();
    if let (PictureKind::Map, Some(branch)) = (kind, request.branch())
        && filters.iter().all(|(column, _)| *column != branch)
        && has_both_ways(table, branch)
    {
        console::say("drawn: branch = up; --where branch=down chooses the other branch");
        filters.push((branch, "up".to_owned()));
    }
    filters
}

/// Returns an error if `--best-over` names a column that is not an axis, or an axis that the picture shows.
fn check_best_over(request: &Request, hidden: &[usize]) -> Result<(), Failure> {
    let Some(&shown) = request.best_over.iter().find(|over| !hidden.contains(over)) else { return Ok(()) };
    let message = format!("--best-over {}: not an axis that the picture leaves out", request.name(shown));
    Err(Failure::usage(message).help(if hidden.is_empty() {
        "the picture shows all axes".to_owned()
    } else {
        format!("the picture leaves out {}", request.listed(hidden))
    }))
}

/// Returns, for each position of the picture, the row with the best value of the measure. Also prints the
/// best value of the measure in the whole picture, with the values of the axes.
fn best(
    request: &Request,
    table: &Table,
    columns: &Columns,
    axes: &Axes,
    rows: &[usize],
) -> Result<Vec<usize>, Failure> {
    let (measure, second) = match columns.color {
        Some(color) => (color, Some(columns.y)),
        None => (columns.y, columns.by),
    };
    let shown: Vec<usize> = [columns.x].into_iter().chain(second).collect();
    let aim = Aim::of(request.name(measure));
    let rows = slices::best(table, &shown, measure, aim, rows)?;
    if let Some(&row) = slices::best(table, &[], measure, aim, &rows)?.first() {
        let value = |column: usize| -> Result<String, Failure> {
            let number = table.numbers(column)?[row];
            Ok(format!("{} = {}", request.name(column), table.label(column).value(number)))
        };
        let numbers = axes.columns.iter().filter(|column| !axes.words.contains(column));
        let places = numbers.map(|&column| value(column)).collect::<Result<Vec<String>, Failure>>()?;
        console::say(&format!("best: {} at {}", value(measure)?, places.join(", ")));
    }
    Ok(rows)
}

/// Returns true if the file has rows of the branches `up` and `down`.
fn has_both_ways(table: &Table, branch: usize) -> bool {
    let Cells::Words { words, .. } = &table.columns[branch].cells else { return false };
    ["up", "down"].iter().all(|way| words.iter().any(|word| word == way))
}

/// Returns an error if a column contains numbers so large that the margins and ticks of an axis would exceed
/// the range of floating-point numbers.
fn check_span(table: &Table, columns: &Columns, rows: &[usize]) -> Result<(), Failure> {
    /// Largest allowed magnitude of a number. Margins and ticks of an axis may be several times larger than
    /// this magnitude.
    const LARGEST: f64 = f64::MAX / 16.0;
    for column in [Some(columns.x), Some(columns.y), columns.color].into_iter().flatten() {
        let Cells::Numbers(values) = &table.columns[column].cells else { continue };
        let Some((low, high)) = scale::range(rows.iter().map(|&row| values[row])) else { continue };
        if high.abs().max(low.abs()) > LARGEST {
            let name = &table.columns[column].name;
            let message =
                format!("the values of {name}, from {low:e} to {high:e}, are too large for a picture");
            return Err(Failure::usage(message).help(format!("choose rows: --where '{name} < 1e300'")));
        }
    }
    Ok(())
}

/// Converts a value that the user typed into the unit of the picture, and returns the value as text.
fn shown(table: &Table, column: usize, typed: &str) -> String {
    let Column { name, unit, .. } = &table.columns[column];
    match filter::number(name, unit, typed) {
        Ok(Some(number)) => table.label(column).value(number),
        _ => typed.to_owned(),
    }
}

/// Returns, for each of the columns x and y, whether larger or smaller values are better.
pub(super) fn aims(request: &Request, columns: &Columns) -> (Aim, Aim) {
    let aim = |asked: Option<Aim>, column: usize| asked.unwrap_or_else(|| Aim::of(request.name(column)));
    (aim(request.args.x_aim, columns.x), aim(request.args.y_aim, columns.y))
}

/// Returns the axes of the sweep along which flap must choose rows, because the picture does not show these
/// axes.
fn hidden(columns: &Columns, axes: &Axes) -> Vec<usize> {
    use PictureKind::{Histogram, Matrix, Pareto, Scatter, Tornado, Trajectory};
    let color = columns.color.filter(|_| columns.kind == Scatter);
    let shown = [Some(columns.x), Some(columns.y), columns.by, color];
    let is_hidden = |column: &usize| match columns.kind {
        Pareto | Trajectory | Matrix => false,
        // All designs of a grid are drawn; for a sample crossed with axes, all points of the sample.
        Scatter | Histogram | Tornado => axes.sampled && !axes.sample.contains(column),
        _ => true,
    };
    axes.columns
        .iter()
        .copied()
        .filter(|column| is_hidden(column) && !shown.contains(&Some(*column)))
        .collect()
}
