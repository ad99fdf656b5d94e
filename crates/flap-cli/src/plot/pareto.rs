//! Pareto pictures: two measures of every design, and the designs that no other design beats in both.

use kuva::render::layout::ComputedLayout;
use kuva::render::render::Scene;

use super::bar;
use super::chosen::Chosen;
use super::front::front;
use super::ink::{self, Look};
use super::panel::{Axis, Panel};
use super::scale;
use crate::args::{Aim, Size};
use crate::console;
use crate::data::columns::Table;
use crate::failure::Failure;

/// Most points of a picture besides the front.
const MOST_POINTS: usize = 20_000;

/// Number of shades of coloured points.
const SHADES: usize = 24;

/// Draws column `y` over column `x`, with the front.
pub(super) fn draw(table: &Table, chosen: &Chosen, size: Size) -> Result<Scene, Failure> {
    let (across, up) = (table.numbers(chosen.columns.x)?, table.numbers(chosen.columns.y)?);
    let (x, y) = (table.label(chosen.columns.x), table.label(chosen.columns.y));
    let rows: Vec<usize> =
        chosen.rows.iter().copied().filter(|&row| across[row].is_finite() && up[row].is_finite()).collect();
    let points: Vec<(f64, f64)> =
        rows.iter().map(|&row| (across[row] * x.factor, up[row] * y.factor)).collect();
    let Some([width, height]) = scale::extent(&points) else {
        return Err(chosen.nothing(table, chosen.columns.y));
    };
    let (x_aim, y_aim) = chosen.aims;
    let best = front(&points, (x_aim == Aim::Max, y_aim == Aim::Max));
    let shown = scale::even(points.len(), MOST_POINTS);
    if shown.len() < points.len() {
        let (drawn, all) = (shown.len(), points.len());
        console::say(&format!("{drawn} of {all} points are drawn, evenly chosen; the front is of all"));
    }

    let mut notes = chosen.notes.clone();
    let word = |aim: Aim| if aim == Aim::Max { "larger" } else { "smaller" };
    notes.push(format!("better: x {}, y {}", word(x_aim), word(y_aim)));
    if rows.len() < chosen.rows.len() {
        let missing = chosen.rows.len() - rows.len();
        notes.push(format!("{missing} of {} designs without values", chosen.rows.len()));
    }
    let mut plots = Vec::new();
    let bar = match chosen.columns.color {
        None => {
            let plain: Vec<(f64, f64)> = shown.iter().map(|&place| points[place]).collect();
            plots.push(ink::points(&plain, &format!("designs ({})", points.len()), ink::PLAIN, 2.2));
            None
        }
        Some(color) => {
            let values = table.numbers(color)?;
            let label = table.label(color);
            let Some(range) = scale::range(rows.iter().map(|&row| values[row] * label.factor)) else {
                return Err(chosen.nothing(table, color));
            };
            let (low, high) = scale::padded(range, 0.0);
            let mut shades = vec![Vec::new(); SHADES + 1];
            for &place in &shown {
                let share = (values[rows[place]] * label.factor - low) / (high - low);
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "from 0 to SHADES"
                )]
                let shade =
                    if share.is_finite() { (share * (SHADES - 1) as f64).round() as usize } else { SHADES };
                shades[shade].push(points[place]);
            }
            for (shade, points) in shades.iter().enumerate().filter(|(_, points)| !points.is_empty()) {
                let colour = match shade {
                    SHADES => ink::MISSING.to_owned(),
                    _ => ink::shade(shade as f64 / (SHADES - 1) as f64),
                };
                plots.push(ink::points(points, "", &colour, 2.6));
            }
            Some(Axis::linear(label.text(), (low, high)))
        }
    };
    let line: Vec<(f64, f64)> = best.iter().map(|&place| points[place]).collect();
    let name = if bar.is_some() { String::new() } else { format!("not dominated ({})", best.len()) };
    if bar.is_some() {
        notes.push(format!("orange line: the {} that none dominates", best.len()));
    }
    let look = Look { marks: true, width: 1.8, ..Look::new(name, ink::COLOURS[1]) };
    plots.extend(ink::line(&line, &look));

    let panel = Panel {
        title: chosen.title.clone(),
        notes,
        x: Axis::linear(x.text(), scale::padded(width, 0.04)),
        y: Axis::linear(y.text(), scale::padded(height, 0.04)),
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
