//! Tornado pictures: bars that show the rank correlation of each parameter with a measure.

use flap_sweep::picture::colours::{DARK, SERIES};
use flap_sweep::picture::sample::correlations;
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::canvas::Size;
use super::ink;
use super::panel::{Axis, Panel};
use super::selection::Selection;
use crate::console;
use crate::data::columns::{Cells, Table};
use crate::failure::Failure;

/// Largest number of bars in a picture.
const MOST_BARS: usize = 20;

/// The height of a bar as a fraction of the distance between two bars.
const THICK: f64 = 0.62;

/// If the magnitude of a correlation is larger than this number, its value is written inside the bar,
/// otherwise beside the bar.
const LONG: f64 = 0.82;

/// Draws the correlations of the parameters with the measure in column `x`. The largest correlation is at the
/// top.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let measure = selection.columns.x;
    let values = table.numbers(measure)?;
    let of_rows = |values: &[f64]| selection.rows.iter().map(|&row| values[row]).collect::<Vec<f64>>();
    let values = of_rows(values);
    let designs = values.iter().filter(|value| value.is_finite()).count();
    if designs == 0 {
        return Err(selection.no_numbers(table, measure));
    }
    let (places, columns): (Vec<usize>, Vec<Vec<f64>>) = (selection.parameters.iter())
        .filter_map(|&column| match &table.columns[column].cells {
            Cells::Numbers(numbers) => Some((column, of_rows(numbers))),
            _ => None,
        })
        .unzip();
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let found = correlations(&columns, &values);
    if found.is_empty() {
        let message = "no parameter has several values in the selected rows: there is nothing to compare";
        return Err(Failure::usage(message)
            .help("select other rows with --where; a tornado requires a sample or a grid"));
    }
    let shown = &found[..found.len().min(MOST_BARS)];
    if shown.len() < found.len() {
        let (drawn, all) = (shown.len(), found.len());
        console::say(&format!("the {drawn} largest of {all} correlations are drawn"));
    }

    let mut notes = selection.notes.clone();
    if selection.sampled {
        // For independent columns, 95 % of the correlations are smaller.
        let chance = 1.96 / (designs.max(2) as f64 - 1.0).sqrt();
        notes.push(format!("{designs} designs; sizes below {chance:.2} may be chance"));
    } else {
        notes.push(format!("{designs} designs"));
    }
    let words = table.label(measure).words;
    let mut letters = words.chars();
    let measured = letters.next().map(|first| first.to_lowercase().chain(letters).collect::<String>());
    let names = shown.iter().rev().map(|&(place, _)| table.label(places[place]).words);
    let panel = Panel {
        title: selection.title.clone(),
        notes,
        ..Panel::new(
            Axis::linear(
                format!("Rank correlation (Spearman) with {}", measured.unwrap_or_default()),
                (-1.0, 1.0),
            ),
            Axis::of_categories(String::new(), names.collect(), 0.6),
            Vec::new(),
        )
    };
    let layout = panel.layout(size);
    let frame = ComputedLayout::from_layout(&layout);
    let mut scene = panel.scene_in(layout);
    let zero = frame.map_x(0.0);
    for (line, &(_, size)) in shown.iter().rev().enumerate() {
        let middle = frame.map_y(line as f64 + 1.0);
        let half = (frame.map_y(line as f64 + 1.0 - THICK / 2.0) - middle).min(14.0);
        let end = frame.map_x(size);
        let colour = SERIES[usize::from(size > 0.0)];
        ink::rectangle(&mut scene, (zero.min(end), middle - half), ((end - zero).abs(), 2.0 * half), colour);
        // Beside the bar, or inside the bar if it ends near the frame.
        let is_inside = size.abs() > LONG;
        let is_right = (size > 0.0) != is_inside;
        let (side, anchor) = if is_right { (5.0, TextAnchor::Start) } else { (-5.0, TextAnchor::End) };
        scene.add(Primitive::Text {
            x: end + side,
            y: middle + 4.2,
            content: format!("{size:+.2}").replace('-', "−"),
            size: 12,
            anchor,
            rotate: None,
            bold: is_inside,
            color: is_inside.then(|| Color::from("#ffffff")),
        });
    }
    let (top, bottom) = (frame.margin_top, frame.margin_top + frame.plot_height());
    ink::rectangle(&mut scene, (zero - 0.5, top), (1.0, bottom - top), DARK);
    Ok(scene)
}
