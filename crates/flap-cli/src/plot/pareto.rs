//! Pictures of Pareto fronts: two measures of every design, and the front. A design is on the front if no
//! other design is better in both measures.

use flap_sweep::picture::colours::{DARK, PLAIN};
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene};

use super::canvas::Size;
use super::ink::{self, Look};
use super::label::Label;
use super::panel::{Axis, Panel};
use super::scale;
use super::scatter::{self, Points};
use super::selection::Selection;
use super::shades;
use crate::args::Aim;
use crate::console;
use crate::data::columns::Table;
use crate::failure::Failure;

/// Largest number of points on a front that are drawn with rings. A larger number of rings would overlap and
/// hide the colours of the points.
const MOST_RINGS: usize = 40;

/// The width of the line that shows the front.
const WIDTH: f64 = 1.0;

/// The radius of the rings around points on the front.
const RING: f64 = 4.0;

/// Draws column `y` over column `x` as points, and the Pareto front as a line.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let designs = Points::of(table, selection)?;
    let (x_aim, y_aim) = selection.aims;
    let best = front(&designs.places, selection.aims);
    let (drawn, all) = (designs.shown.len(), designs.places.len());
    if drawn < all {
        console::say(&format!(
            "{drawn} of {all} points are drawn, evenly chosen; the front is the front of all points"
        ));
    }

    let mut notes = selection.notes.clone();
    notes.extend(designs.note());
    let (mut plots, bar) = designs.plots(table, selection, "designs")?;
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
        title: selection.title.clone(),
        notes,
        x: axis(selection.columns.x, x_aim, width),
        y: axis(selection.columns.y, y_aim, height),
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
    shades::colour_bar(&mut scene, &frame, bar, None);
    Ok(scene)
}

/// Returns the entries of the legend, with the same marks as in the picture.
fn entries(front: &str) -> Vec<LegendEntry> {
    let entry = |label: &str, color: &str, shape: LegendShape| LegendEntry {
        label: ink::plain(label),
        color: color.to_owned(),
        shape,
        dasharray: None,
    };
    vec![
        entry("designs", PLAIN, LegendShape::CircleSize(scatter::SIZE)),
        entry(front, DARK, LegendShape::Line),
    ]
}

/// Changes the line of the front in the legend so that it is as thin as in the picture. If `has_rings` is
/// true, the line also gets a ring.
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

/// Returns the label of an axis with the words "more is better" or "less is better".
fn aimed(label: &Label, aim: Aim) -> String {
    format!("{}, {} is better", label.text(), if aim == Aim::Max { "more" } else { "less" })
}

/// Returns the line that shows the front: a staircase through `corners`, the points on the front.
fn steps(corners: &[(f64, f64)], x_aim: Aim) -> Vec<(f64, f64)> {
    let mut line: Vec<(f64, f64)> = corners.first().copied().into_iter().collect();
    for two in corners.windows(2) {
        let between = if x_aim == Aim::Min { (two[1].0, two[0].1) } else { (two[0].0, two[1].1) };
        line.extend([between, two[1]]);
    }
    line
}

/// Returns the indices of the points that no other point dominates, in rising order of the first coordinate.
///
/// A point dominates another point if both its coordinates are at least as good and one of them is better.
/// Points with NaN are ignored.
fn front(points: &[(f64, f64)], aims: (Aim, Aim)) -> Vec<usize> {
    // From here on, larger values are better in both numbers.
    let score = |value: f64, aim: Aim| if aim == Aim::Max { value } else { -value };
    let scores = |index: usize| (score(points[index].0, aims.0), score(points[index].1, aims.1));
    let known = |index: &usize| !points[*index].0.is_nan() && !points[*index].1.is_nan();
    let mut order: Vec<usize> = (0..points.len()).filter(known).collect();
    order.sort_by(|&a, &b| {
        let (a, b) = (scores(a), scores(b));
        b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1))
    });
    let mut kept: Vec<usize> = Vec::new();
    for index in order {
        let (x, y) = scores(index);
        // All earlier points are at least as good in x, and the last kept point has the best y of them.
        let is_on_front = kept.last().is_none_or(|&last| {
            let (best_x, best_y) = scores(last);
            y > best_y || (y == best_y && x == best_x)
        });
        if is_on_front {
            kept.push(index);
        }
    }
    kept.sort_by(|&a, &b| points[a].0.total_cmp(&points[b].0).then(a.cmp(&b)));
    kept
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

    /// Computes the front from its definition, by a comparison of every pair of points.
    fn brute_force(points: &[(f64, f64)], aims: (Aim, Aim)) -> Vec<usize> {
        let at_least = |a: f64, b: f64, aim: Aim| if aim == Aim::Max { a >= b } else { a <= b };
        let dominates =
            |a: (f64, f64), b: (f64, f64)| at_least(a.0, b.0, aims.0) && at_least(a.1, b.1, aims.1) && a != b;
        let whole = |point: (f64, f64)| !point.0.is_nan() && !point.1.is_nan();
        (0..points.len())
            .filter(|&i| whole(points[i]) && !points.iter().any(|&other| dominates(other, points[i])))
            .collect()
    }

    /// Returns random points with few different coordinates, so that many points have equal coordinates.
    fn points(count: usize, seed: u64) -> Vec<(f64, f64)> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let digit = (state >> 33) % 12;
            if digit == 11 { f64::NAN } else { digit as f64 - 5.0 }
        };
        (0..count).map(|_| (next(), next())).collect()
    }

    #[test]
    fn it_is_what_comparing_every_pair_gives() {
        for seed in 0..200 {
            let count = usize::try_from(1 + seed % 40).unwrap();
            let points = points(count, seed);
            for aims in
                [(Aim::Max, Aim::Max), (Aim::Max, Aim::Min), (Aim::Min, Aim::Max), (Aim::Min, Aim::Min)]
            {
                let mut found = front(&points, aims);
                let rising: Vec<f64> = found.iter().map(|&index| points[index].0).collect();
                assert!(rising.is_sorted(), "{rising:?}");
                found.sort_unstable();
                assert_eq!(found, brute_force(&points, aims), "seed {seed}, {aims:?}");
            }
        }
    }

    #[test]
    fn nothing_has_no_front() {
        assert!(front(&[], (Aim::Max, Aim::Min)).is_empty());
        assert!(front(&[(f64::NAN, 1.0)], (Aim::Max, Aim::Min)).is_empty());
        assert_eq!(front(&[(1.0, 1.0)], (Aim::Max, Aim::Min)), [0]);
    }
}
