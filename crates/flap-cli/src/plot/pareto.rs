//! Pareto pictures: two measures of every design, and the designs that no other design beats in both.

use flap_sweep::picture::colours::DARK;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::Scene;

use super::bar;
use super::chosen::Chosen;
use super::front::front;
use super::ink::{self, Look};
use super::label::Label;
use super::panel::{Axis, Panel};
use super::points::Points;
use super::scale;
use crate::args::{Aim, Size};
use crate::console;
use crate::data::columns::Table;
use crate::failure::Failure;

/// Draws column `y` over column `x`, with the front.
pub(super) fn draw(table: &Table, chosen: &Chosen, size: Size) -> Result<Scene, Failure> {
    let points = Points::of(table, chosen)?;
    let (x_aim, y_aim) = chosen.aims;
    let best = front(&points.places, (x_aim == Aim::Max, y_aim == Aim::Max));
    let (drawn, all) = (points.shown.len(), points.places.len());
    if drawn < all {
        console::say(&format!("{drawn} of {all} points are drawn, evenly chosen; the front is of all"));
    }

    let mut notes = chosen.notes.clone();
    notes.extend(points.note());
    let (mut plots, bar) = points.plots(table, chosen, "designs")?;
    let corners: Vec<(f64, f64)> = best.iter().map(|&place| points.places[place]).collect();
    let name = format!("front ({} of {all} designs)", best.len());
    let legend = if bar.is_some() { String::new() } else { name.clone() };
    if bar.is_some() {
        notes.push(format!("line: {name}"));
    }
    plots.push(ink::rings(&corners, DARK, 4.0));
    plots.extend(ink::line(&steps(&corners, x_aim), &Look { width: 1.0, ..Look::new(legend, DARK) }));

    let [width, height] = points.extent;
    let axis = |column: usize, aim: Aim, range: (f64, f64)| {
        Axis::linear(aimed(&table.label(column), aim), scale::padded(range, 0.04))
    };
    let panel = Panel {
        title: chosen.title.clone(),
        notes,
        x: axis(chosen.columns.x, x_aim, width),
        y: axis(chosen.columns.y, y_aim, height),
        plots,
        legend: bar.is_none().then(String::new),
        bar: bar.is_some(),
    };
    let frame = ComputedLayout::from_layout(&panel.layout(size));
    let mut scene = panel.scene(size);
    if let Some(bar) = &bar {
        bar::colour_bar(&mut scene, &frame, bar, None);
    }
    Ok(scene)
}

/// A label that says which direction is better.
fn aimed(label: &Label, aim: Aim) -> String {
    format!("{}, {} is better", label.text(), if aim == Aim::Max { "more" } else { "less" })
}

/// The line that bounds the values which designs reach: from a corner on, it stays as good as that in the other measure.
fn steps(corners: &[(f64, f64)], x_aim: Aim) -> Vec<(f64, f64)> {
    let mut line: Vec<(f64, f64)> = corners.first().copied().into_iter().collect();
    for two in corners.windows(2) {
        let between = if x_aim == Aim::Min { (two[1].0, two[0].1) } else { (two[0].0, two[1].1) };
        line.extend([between, two[1]]);
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_pass_where_no_design_is() {
        let corners = [(1.0, 1.0), (2.0, 3.0)];
        assert_eq!(steps(&corners, Aim::Min), [(1.0, 1.0), (2.0, 1.0), (2.0, 3.0)]);
        assert_eq!(steps(&corners, Aim::Max), [(1.0, 1.0), (1.0, 3.0), (2.0, 3.0)]);
    }
}
