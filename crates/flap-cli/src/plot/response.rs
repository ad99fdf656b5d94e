//! Response pictures: a measure over a parameter, with one line for each value of a second parameter.

use std::borrow::Cow;

use flap_sweep::picture::scale::is_log;
use kuva::render::render::Scene;

use super::canvas::Size;
use super::ink::{self, Look};
use super::panel::{Axis, Panel};
use super::scale;
use super::selection::Selection;
use crate::console;
use crate::data::columns::{Cells, NO_WORD, Table};
use crate::data::levels::{Levels, Values};
use crate::failure::Failure;

/// Largest number of lines in a picture, because the reader cannot distinguish a larger number of lines.
const MOST_LINES: usize = 16;

/// Largest number of points in a line. Longer lines are thinned.
const MOST_POINTS: usize = 4000;

/// The radius of the points in a picture with words on the horizontal axis.
const WORD_SIZE: f64 = 4.0;

/// Draws column `y` over column `x` as lines, or as points if `x` contains words.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let (across, words) = places(table, selection.columns.x)?;
    let up = table.numbers(selection.columns.y)?;
    let (x, y) = (table.label(selection.columns.x), table.label(selection.columns.y));
    let family = family(table, selection)?;
    let shown = scale::even(family.len(), MOST_LINES);
    if shown.len() < family.len() {
        let by = selection.columns.by.map_or("", |by| table.columns[by].name.as_str());
        let (drawn, all) = (shown.len(), family.len());
        console::say(&format!(
            "{drawn} of the {all} values of {by} are drawn, evenly chosen; --where chooses one value"
        ));
    }

    let mut plots = Vec::new();
    let mut drawn: Vec<(f64, f64)> = Vec::new();
    let (mut missing, mut rows) = (0, 0);
    for (place, &number) in shown.iter().enumerate() {
        let Line { name, rows: of_line } = &family[number];
        let mut points: Vec<(f64, f64)> =
            of_line.iter().map(|&row| (across[row] * x.factor, up[row] * y.factor)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        if points.windows(2).any(|two| two[0].0 == two[1].0) {
            return Err(several_rows(table, selection));
        }
        missing += points.iter().filter(|point| !point.1.is_finite()).count();
        rows += points.len();
        let colour = ink::line_colour(place, shown.len(), ordered(table, selection));
        if !words.is_empty() {
            // Words have no order, so no line connects their points.
            plots.push(ink::points(&points, name, &colour, WORD_SIZE));
            drawn.extend(points);
            continue;
        }
        let points = if points.len() > MOST_POINTS { scale::thinned(&points, MOST_POINTS) } else { points };
        let mut look = Look::new(name.clone(), colour);
        look.marks = points.len() <= 40 && shown.len() <= 8;
        plots.extend(ink::line(&points, &look));
        drawn.extend(points);
    }
    let Some(heights) = scale::range(drawn.iter().map(|point| point.1)) else {
        return Err(selection.no_numbers(table, selection.columns.y));
    };
    let mut values: Vec<f64> = drawn.iter().map(|point| point.0).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let log = is_log(&values);
    let width = scale::range(values).unwrap_or((0.0, 1.0));
    let mut notes = selection.notes.clone();
    if missing > 0 {
        notes.push(format!("{missing} of {rows} points without a value"));
    }
    let range = if log {
        let (low, high) = scale::padded((width.0.ln(), width.1.ln()), 0.02);
        (low.exp(), high.exp())
    } else {
        scale::padded(width, 0.02)
    };
    let panel = Panel {
        title: selection.title.clone(),
        notes,
        x: if words.is_empty() {
            Axis { log, ..Axis::linear(x.text(), range) }
        } else {
            Axis::of_words(x.text(), words)
        },
        y: Axis::linear(y.text(), scale::from_zero(heights)),
        plots,
        legend: selection.columns.by.map(|by| table.label(by).text()),
        bar: false,
    };
    Ok(panel.scene(size))
}

/// Returns the position of each row on the horizontal axis, and the words at the positions 0, 1, 2, …. The
/// list of words is empty if `x` contains numbers.
fn places(table: &Table, x: usize) -> Result<(Cow<'_, [f64]>, Vec<String>), Failure> {
    let Cells::Words { codes, words } = &table.columns[x].cells else {
        return Ok((Cow::Borrowed(table.numbers(x)?), Vec::new()));
    };
    let place = |&code: &u32| if code == NO_WORD { f64::NAN } else { f64::from(code) };
    Ok((codes.iter().map(place).collect(), words.clone()))
}

/// A line of the picture: its name, and the rows of its points.
pub(super) struct Line {
    pub(super) name: String,
    pub(super) rows: Vec<usize>,
}

/// Groups the selected rows into lines, by their value in the column `by`. Without a column `by`, all rows
/// form one line.
pub(super) fn family(table: &Table, selection: &Selection) -> Result<Vec<Line>, Failure> {
    let Some(by) = selection.columns.by else {
        return Ok(vec![Line { name: String::new(), rows: selection.rows.clone() }]);
    };
    let levels = Levels::of(table, by, &selection.rows);
    if levels.len() * 3 > selection.rows.len() && levels.len() > MOST_LINES {
        let name = &table.columns[by].name;
        let message = format!(
            "{} of {} rows have different values of {name}, so they form no lines",
            levels.len(),
            selection.rows.len()
        );
        return Err(Failure::usage(message).help("draw a sample with --kind scatter"));
    }
    // The unit is in the legend's heading.
    let label = table.label(by);
    let names = match &levels.values {
        Values::Numbers(values) => {
            super::label::distinct(&values.iter().map(|value| value * label.factor).collect::<Vec<_>>())
        }
        Values::Words(words) => words.clone(),
    };
    let mut lines: Vec<Line> = names.into_iter().map(|name| Line { name, rows: Vec::new() }).collect();
    for (&row, &code) in selection.rows.iter().zip(&levels.codes) {
        lines[code].rows.push(row);
    }
    Ok(lines)
}

/// Returns true if the values that distinguish the lines are numbers, so that the lines have an order.
pub(super) fn ordered(table: &Table, selection: &Selection) -> bool {
    selection.columns.by.is_some_and(|by| table.numbers(by).is_ok())
}

fn several_rows(table: &Table, selection: &Selection) -> Failure {
    let name = &table.columns[selection.columns.x].name;
    Failure::usage(format!("several rows of one line have the same {name}")).help(
        "use --by to draw a line for each value of a column, --where to choose one value, or --kind scatter to draw points",
    )
}
