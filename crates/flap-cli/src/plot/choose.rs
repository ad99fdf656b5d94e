//! The choice of a picture that suits a file: its kind, columns and rows.

use super::chosen::{Chosen, Columns};
use super::kind::kind;
use super::pick;
use super::scale;
use super::slices::{self, Taken};
use super::wishes::Wishes;
use crate::args::{Aim, Filter, PictureKind};
use crate::console;
use crate::data::axes::Axes;
use crate::data::columns::{Cells, Column, Table};
use crate::data::{filter, quantity};
use crate::failure::Failure;

/// Chooses kind, columns and rows.
pub(super) fn choose(wishes: &Wishes, table: &Table, title: String) -> Result<Chosen, Failure> {
    let axes = Axes::of(table, wishes.end);
    let columns = columns(wishes, &axes)?;
    let mut values = wishes.values.clone();
    let mut filters = wishes.filters.clone();
    if let (PictureKind::Map, Some(branch)) = (columns.kind, wishes.branch())
        && !filters.contains(&branch)
        && has_both_ways(table, branch)
    {
        console::say("drawn: branch = up; --where branch=down chooses the other way");
        values.push(("branch".to_owned(), "up".to_owned()));
        filters.push(branch);
    }
    let rows = slices::filtered(table, &values)?;
    check_span(table, &columns, &rows)?;
    let label = |column: usize| table.label(column);
    let mut notes: Vec<String> = (filters.iter().zip(&values))
        .map(|(&column, (_, value))| format!("{} {}", label(column).words, shown(table, column, value)))
        .collect();
    notes.extend(wishes.args.comparisons().into_iter().map(|filter| match filter {
        Filter::Comparison(text) | Filter::Equal(_, text) => quantity::printed(&text),
    }));
    let slice = slices::sliced(table, &left(&columns, &axes), rows);
    for Taken { name, value, of, .. } in &slice.taken {
        console::say(&format!("drawn: {name} = {value}, the middle of {of} values; --where chooses another"));
    }
    notes.extend(slice.taken.into_iter().map(|taken| taken.shown));
    let mut parameters: Vec<usize> = (1..wishes.end).collect();
    parameters.sort_by_key(|&column| !table.sample.contains(&table.columns[column].name));
    Ok(Chosen {
        aims: aims(wishes, &columns),
        columns,
        rows: slice.rows,
        parameters,
        sampled: axes.sampled,
        title,
        notes,
    })
}

/// True if rows are on the way up and on the way down.
fn has_both_ways(table: &Table, branch: usize) -> bool {
    let Cells::Words { words, .. } = &table.columns[branch].cells else { return false };
    ["up", "down"].iter().all(|way| words.iter().any(|word| word == way))
}

/// Refuses numbers whose differences are beyond the largest float: axes have no place for them.
fn check_span(table: &Table, columns: &Columns, rows: &[usize]) -> Result<(), Failure> {
    /// The share of the largest float that margins and ticks need.
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

/// A value that the user typed, in the unit that the picture shows.
fn shown(table: &Table, column: usize, typed: &str) -> String {
    let Column { name, unit, .. } = &table.columns[column];
    match filter::number(name, unit, typed) {
        Ok(Some(number)) => table.label(column).value(number),
        _ => typed.to_owned(),
    }
}

/// Chooses kind and columns.
pub(super) fn columns(wishes: &Wishes, axes: &Axes) -> Result<Columns, Failure> {
    pick::columns(wishes, axes, kind(wishes, axes)?)
}

/// The better directions of x and y.
pub(super) fn aims(wishes: &Wishes, columns: &Columns) -> (Aim, Aim) {
    let aim = |asked: Option<Aim>, column: usize| asked.unwrap_or_else(|| Aim::of(wishes.name(column)));
    (aim(wishes.args.x_aim, columns.x), aim(wishes.args.y_aim, columns.y))
}

/// The axes that a picture has no place for.
fn left(columns: &Columns, axes: &Axes) -> Vec<usize> {
    use PictureKind::{Histogram, Matrix, Pareto, Scatter, Tornado, Trajectory};
    let shown = [Some(columns.x), Some(columns.y), columns.by];
    let is_left = |column: &usize| match columns.kind {
        Pareto | Trajectory | Matrix => false,
        // All designs of a grid; of a sample that is crossed with axes, all its points.
        Scatter | Histogram | Tornado => axes.sampled && !axes.sample.contains(column),
        _ => true,
    };
    axes.columns.iter().copied().filter(|column| is_left(column) && !shown.contains(&Some(*column))).collect()
}
