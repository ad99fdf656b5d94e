//! Pareto pictures: two measures of every design, and the designs that no other design beats in both.

use flap_sweep::picture::colours::{DARK, PLAIN};
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene};

use super::bar;
use super::chosen::Chosen;
use super::front::front;
use super::ink::{self, Look};
use super::label::Label;
use super::panel::{Axis, Panel};
use super::points::{self, Points};
use super::scale;
use crate::args::{Aim, Size};
use crate::console;
use crate::data::columns::Table;
use crate::failure::Failure;

/// Most corners of a front with a ring each: more would merge and hide the colours below.
const MOST_RINGS: usize = 40;

/// The width of the front's line.
const WIDTH: f64 = 1.0;

/// The radius of a ring.
const RING: f64 = 4.0;

/// Draws column `y` over column `x`, with the front.
pub(super) fn draw(table: &Table, chosen: &Chosen, size: Size) -> Result<Scene, Failure> {
    let designs = Points::of(table, chosen)?;
    let (x_aim, y_aim) = chosen.aims;
    let best = front(&designs.places, (x_aim == Aim::Max, y_aim == Aim::Max));
    let (drawn, all) = (designs.shown.len(), designs.places.len());
    if drawn < all {
        console::say(&format!("{drawn} of {all} points are drawn, evenly chosen; the front is of all"));
    }

    let mut notes = chosen.notes.clone();
    notes.extend(designs.note());
    let (mut plots, bar) = designs.plots(table, chosen, "designs")?;
    let corners: Vec<(f64, f64)> = best.iter().map(|&place| designs.places[place]).collect();
    let name = format!("front ({} of {all} designs)", best.len());
    let legend = if bar.is_some() { String::new() } else { name.clone() };
    if bar.is_some() {
        notes.push(format!("line: {name}"));
    }
    let has_rings = corners.len() <= MOST_RINGS;
    if has_rings {
        plots.push(ink::rings(&corners, DARK, RING));
    }
    plots.extend(ink::line(&steps(&corners, x_aim), &Look { width: WIDTH, ..Look::new(legend, DARK) }));

    let [width, height] = designs.extent;
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
    let mut layout = panel.layout(size);
    let frame = ComputedLayout::from_layout(&layout);
    let Some(bar) = &bar else {
        layout = layout.with_legend_entries(entries(&name));
        let mut scene = panel.scene_in(layout);
        trace_in_legend(&mut scene, &frame, has_rings);
        return Ok(scene);
    };
    let mut scene = panel.scene_in(layout);
    bar::colour_bar(&mut scene, &frame, bar, None);
    Ok(scene)
}

/// The legend, with marks as they are in the picture.
fn entries(front: &str) -> Vec<LegendEntry> {
    let entry = |label: &str, color: &str, shape: LegendShape| LegendEntry {
        label: ink::plain(label),
        color: color.to_owned(),
        shape,
        dasharray: None,
    };
    vec![
        entry("designs", PLAIN, LegendShape::CircleSize(points::SIZE)),
        entry(front, DARK, LegendShape::Line),
    ]
}

/// Makes the line in the legend as that of the front is: as thin, and with a ring if `has_rings`.
fn trace_in_legend(scene: &mut Scene, frame: &ComputedLayout, has_rings: bool) {
    let right = frame.margin_left + frame.plot_width();
    let centre = scene.elements.iter_mut().rev().find_map(|element| match element {
        Primitive::Line { x1, x2, y1, y2, stroke_width, .. } if y1 == y2 && *x1 > right => {
            *stroke_width = WIDTH;
            Some((f64::midpoint(*x1, *x2), *y1))
        }
        _ => None,
    });
    if let Some((cx, cy)) = centre.filter(|_| has_rings) {
        scene.add(Primitive::Circle {
            cx,
            cy,
            r: RING,
            fill: Color::None,
            fill_opacity: None,
            stroke: Some(Color::from(DARK)),
            stroke_width: Some(ink::RING_WIDTH),
        });
    }
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
