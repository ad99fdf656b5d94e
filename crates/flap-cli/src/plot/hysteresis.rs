//! The branches of a response as its parameter rises and falls.

use kuva::render::render::Scene;

use super::chosen::Chosen;
use super::ink::{self, Look};
use super::panel::{Axis, Panel};
use super::response::{family, ordered};
use super::scale;
use crate::args::Size;
use crate::console;
use crate::data::columns::{Cells, Table};
use crate::failure::Failure;

/// The branches in the order of drawing, with their names in the legend.
const BRANCHES: [(&str, &str); 3] = [("up", "rising"), ("down", "falling"), ("unstable", "unstable")];

/// Most curves of a picture: more cannot be distinguished.
const MOST_CURVES: usize = 10;

/// Draws column `y` over column `x`, a line for each branch.
pub(super) fn draw(table: &Table, chosen: &Chosen, size: Size) -> Result<Scene, Failure> {
    let (across, up) = (table.numbers(chosen.columns.x)?, table.numbers(chosen.columns.y)?);
    let (x, y) = (table.label(chosen.columns.x), table.label(chosen.columns.y));
    let branch = table.find("branch")?;
    let Cells::Words { codes, words } = &table.columns[branch].cells else {
        return Err(Failure::usage("column `branch` holds other words than `up`, `down` and `unstable`"));
    };
    let curves = family(table, chosen)?;
    let shown = scale::even(curves.len(), MOST_CURVES);
    if shown.len() < curves.len() {
        let (drawn, all) = (shown.len(), curves.len());
        console::say(&format!("{drawn} of {all} curves are drawn, evenly chosen; --where chooses one"));
    }

    let mut plots = Vec::new();
    let mut drawn: Vec<(f64, f64)> = Vec::new();
    for (place, &number) in shown.iter().enumerate() {
        let curve = &curves[number];
        let mut named = false;
        for (kind, (word, name)) in BRANCHES.iter().enumerate() {
            let code = words.iter().position(|known| known == word);
            let points: Vec<(f64, f64)> = (curve.rows.iter())
                .filter(|&&row| Some(codes[row] as usize) == code)
                .map(|&row| (across[row] * x.factor, up[row] * y.factor))
                .collect();
            let mut look = if chosen.columns.by.is_some() {
                let name = if named { String::new() } else { curve.name.clone() };
                Look::new(name, ink::line_colour(place, shown.len(), ordered(table, chosen)))
            } else {
                let colour = [ink::COLOURS[0], ink::COLOURS[1], "#444444"][kind];
                Look::new(*name, colour)
            };
            look.dashed = kind == 2;
            // The way down often lies on the way up, which must be seen below it.
            look.width = [4.0, 1.8, 1.6][kind];
            if chosen.columns.by.is_some() {
                look.width = 1.8;
            }
            let lines = ink::line(&points, &look);
            named |= !lines.is_empty();
            plots.extend(lines);
            drawn.extend(points);
        }
    }
    let Some([width, height]) = scale::extent(&drawn) else {
        return Err(chosen.nothing(table, chosen.columns.y));
    };
    let mut notes = chosen.notes.clone();
    let missing = drawn.iter().filter(|point| !point.1.is_finite()).count();
    if missing > 0 {
        notes.push(format!("{missing} of {} points without a value", drawn.len()));
    }
    if chosen.columns.by.is_some() {
        notes.push("dashed: unstable".to_owned());
    }
    let panel = Panel {
        title: chosen.title.clone(),
        notes,
        x: Axis::linear(x.text(), scale::padded(width, 0.02)),
        y: Axis::linear(y.text(), scale::from_zero(height)),
        plots,
        legend: Some(chosen.columns.by.map_or_else(String::new, |by| table.label(by).text())),
        bar: false,
    };
    Ok(panel.scene(size))
}
