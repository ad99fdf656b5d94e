//! Scatters: two measures of every design, in the colours of a third.

use kuva::render::layout::ComputedLayout;
use kuva::render::render::Scene;

use super::bar;
use super::chosen::Chosen;
use super::panel::{Axis, Panel};
use super::points::Points;
use super::scale;
use crate::args::Size;
use crate::console;
use crate::data::columns::Table;
use crate::failure::Failure;

/// Draws column `y` over column `x`, in the colours of column `color`.
pub(super) fn draw(table: &Table, chosen: &Chosen, size: Size) -> Result<Scene, Failure> {
    let points = Points::of(table, chosen)?;
    let (drawn, all) = (points.shown.len(), points.places.len());
    if drawn < all {
        console::say(&format!("{drawn} of {all} points are drawn, evenly chosen"));
    }
    let (plots, bar) = points.plots(table, chosen, "")?;
    let mut notes = chosen.notes.clone();
    notes.push(format!("{all} designs"));
    notes.extend(points.note());
    let [width, height] = points.extent;
    let (x, y) = (table.label(chosen.columns.x), table.label(chosen.columns.y));
    let panel = Panel {
        title: chosen.title.clone(),
        notes,
        x: Axis::linear(x.text(), scale::padded(width, 0.04)),
        y: Axis::linear(y.text(), scale::padded(height, 0.04)),
        plots,
        legend: None,
        bar: bar.is_some(),
    };
    let frame = ComputedLayout::from_layout(&panel.layout(size));
    let mut scene = panel.scene(size);
    if let Some(bar) = &bar {
        bar::colour_bar(&mut scene, &frame, bar, None);
    }
    Ok(scene)
}
