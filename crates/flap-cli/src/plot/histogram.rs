//! Histograms: the number of designs in each range of a measure, with percentiles.

use flap_sweep::picture::colours::{DARK, PLAIN};
use flap_sweep::picture::sample::{Histogram, MARKED, histogram};
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Scene, TextAnchor};

use super::canvas::Size;
use super::ink;
use super::label::Label;
use super::panel::{Axis, LETTER, Panel};
use super::scale;
use super::selection::Selection;
use crate::console;
use crate::data::columns::Table;
use crate::failure::Failure;

/// The height of a line of text in drawing units.
const LINE: f64 = 17.0;

/// Draws the histogram of the numbers in column `x`.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let column = selection.columns.x;
    let label = table.label(column);
    let numbers = table.numbers(column)?;
    let values: Vec<f64> = selection.rows.iter().map(|&row| numbers[row] * label.factor).collect();
    let Some(found) = histogram(&values) else {
        return Err(selection.no_numbers(table, column));
    };
    let designs: usize = found.counts.iter().sum();
    console::say(&sentence(&table.columns[column].name, designs, &found, &label));

    let mut notes = selection.notes.clone();
    notes.push(format!("{designs} designs"));
    if designs < values.len() {
        notes.push(format!("{} of {} without a value", values.len() - designs, values.len()));
    }
    let largest = found.counts.iter().copied().max().unwrap_or(1) as f64;
    // Space above the bars for the percentiles, one line of text for each.
    let room = (MARKED.len() as f64 + 0.6) * LINE / (size.height - 130.0).max(80.0);
    let ends = (found.edges[0], found.edges[found.edges.len() - 1]);
    let panel = Panel {
        title: selection.title.clone(),
        notes,
        ..Panel::new(
            Axis::linear(label.text(), scale::padded(ends, 0.03)),
            Axis::linear("Number of designs".to_owned(), (0.0, largest / (1.0 - room.min(0.6)))),
            Vec::new(),
        )
    };
    let frame = ComputedLayout::from_layout(&panel.layout(size));
    let mut scene = panel.scene(size);
    for (sides, &count) in found.edges.windows(2).zip(&found.counts) {
        let (left, right) = (frame.map_x(sides[0]), frame.map_x(sides[1]));
        let (top, bottom) = (frame.map_y(count as f64), frame.map_y(0.0));
        ink::rectangle(&mut scene, (left, top), ((right - left - 0.6).max(0.4), bottom - top), PLAIN);
    }
    marks(&mut scene, &frame, &found, &label);
    Ok(scene)
}

/// Draws a dashed line at each percentile. The values of the percentiles are written above the bars, each in
/// its own line.
fn marks(scene: &mut Scene, frame: &ComputedLayout, found: &Histogram, label: &Label) {
    let middle = frame.margin_left + frame.plot_width() / 2.0;
    let top = |line: usize| frame.margin_top + line as f64 * LINE;
    for (line, value) in found.marked.into_iter().enumerate() {
        let x = frame.map_x(value);
        ink::dashes(scene, (x, top(line) + 2.0), (x, frame.map_y(0.0)), (DARK, 1.2));
    }
    for (line, (percent, value)) in MARKED.iter().zip(found.marked).enumerate() {
        let x = frame.map_x(value);
        let text = format!("{percent} %: {}", shown(value, label));
        let width = text.chars().count() as f64 * 12.0 * LETTER;
        let (left, at, anchor) = if x < middle {
            (x + 3.0, x + 5.0, TextAnchor::Start)
        } else {
            (x - 3.0 - width, x - 5.0, TextAnchor::End)
        };
        // The text covers the lines of other percentiles.
        ink::rectangle(scene, (left, top(line) + 2.0), (width, LINE - 2.0), "#ffffff");
        ink::text(scene, (at, top(line) + 13.0), &text, 12, anchor);
    }
}

/// Returns a message with the percentiles.
fn sentence(name: &str, designs: usize, found: &Histogram, label: &Label) -> String {
    let parts: Vec<String> = (MARKED.iter().zip(found.marked))
        .map(|(percent, value)| format!("{percent} % below {}", shown(value, label)))
        .collect();
    format!("{name} of {designs} designs: {}", parts.join(", "))
}

/// Returns a value with four digits and its unit. The caller has already multiplied the value by the factor
/// of the label.
fn shown(value: f64, label: &Label) -> String {
    format!("{} {}", super::label::digits(value, 4), label.unit).trim_end().to_owned()
}
