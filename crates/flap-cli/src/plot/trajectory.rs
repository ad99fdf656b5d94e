//! Stroke and pitch over time, and the rates of stroke and pitch over the angles.

use flap_sweep::picture::colours;
use flap_sweep::table::labels;
use kuva::render::figure::Figure;
use kuva::render::render::Scene;

use super::ink::{self, Look};
use super::panel::{Axis, LETTER, Panel};
use super::scale;
use super::selection::Selection;
use crate::args::Size;
use crate::console;
use crate::data::columns::Table;
use crate::failure::Failure;

/// Largest number of points in one line.
const MOST_POINTS: usize = 8000;

/// The angles, given as the first parts of the column names.
const ANGLES: [&str; 2] = ["stroke", "pitch"];

/// Draws the motion beside its phase portrait.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let time = table.numbers(selection.columns.x)?;
    let label = table.label(selection.columns.x);
    let (mut over_time, mut portrait) = (Vec::new(), Vec::new());
    let (mut motions, mut loops) = (Vec::new(), Vec::new());
    let mut notes = selection.notes.clone();
    let mut ticking = 0;
    for (place, angle) in ANGLES.iter().enumerate() {
        let column = table.find(&format!("{angle}_deg"))?;
        let values = table.numbers(column)?;
        let rate = format!("{angle}_rate_rad_s");
        let rates = if let Some(column) = table.columns.iter().position(|column| column.name == rate) {
            table.numbers(column)?.iter().map(|rate| rate.to_degrees() * 1e-3).collect()
        } else {
            console::say(&format!("the rate of the {angle} is computed from differences of its samples"));
            rates(time, values)
        };
        let motion: Vec<(f64, f64)> =
            selection.rows.iter().map(|&row| (time[row] * label.factor, values[row])).collect();
        let mut around: Vec<(f64, f64)> =
            selection.rows.iter().map(|&row| (values[row], rates[row])).collect();
        ticking = motion.len();
        if around.len() > MOST_POINTS {
            around.drain(..around.len() - MOST_POINTS);
        }
        let look = |name: &str| Look { width: 1.8, ..Look::new(name, colours::SERIES[place]) };
        let motion = scale::thinned(&motion, MOST_POINTS);
        over_time.extend(ink::line(&motion, &look("")));
        portrait.extend(ink::line(&around, &look(&table.label(column).words)));
        motions.extend(motion);
        loops.extend(around);
    }
    if ticking > MOST_POINTS {
        notes.push(format!("phase portrait: the last {MOST_POINTS} of {ticking} samples"));
        console::say(&format!(
            "too many samples ({ticking}): the time plot keeps the extremes, the phase portrait the last {MOST_POINTS}"
        ));
    }
    let (Some([span, angles]), Some([around, rates])) = (scale::extent(&motions), scale::extent(&loops))
    else {
        return Err(selection.nothing(table, selection.columns.x));
    };
    let angle = labels::titled("Angle", &labels::printed("deg"));
    let rate = labels::titled("Rate", &labels::printed("deg/ms"));
    let left = Panel::new(
        Axis::linear(label.text(), scale::padded(span, 0.0)),
        Axis::linear(angle.clone(), scale::padded(angles, 0.05)),
        over_time,
    );
    let right = Panel::new(
        Axis::linear(angle, scale::padded(around, 0.05)),
        Axis::linear(rate, scale::padded(rates, 0.05)),
        portrait,
    );
    let right = Panel { legend: Some(String::new()), ..right };
    Ok(side_by_side(left, right, &selection.title, &notes, size))
}

/// Returns a scene with two panels below one title.
fn side_by_side(left: Panel, right: Panel, title: &str, notes: &[String], size: Size) -> Scene {
    let half = Size { width: size.width * 0.5, height: size.height - 60.0 };
    let layouts = vec![left.layout(half), right.layout(half)];
    let title =
        std::iter::once(title.to_owned()).chain(notes.iter().cloned()).collect::<Vec<_>>().join(" · ");
    // The title has only one line, so a long title gets smaller letters.
    let letters = (size.width / (LETTER * title.chars().count().max(1) as f64)).clamp(9.0, 17.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "9 to 17")]
    let letters = letters as u32;
    Figure::new(1, 2)
        .with_plots(vec![left.plots, right.plots])
        .with_layouts(layouts)
        .with_title(ink::plain(&title))
        .with_title_size(letters)
        .with_figure_size(size.width, size.height)
        .render()
}

/// Returns rates in degrees per millisecond, from the differences of neighbours.
fn rates(time: &[f64], angles: &[f64]) -> Vec<f64> {
    let last = time.len() - 1;
    (0..time.len())
        .map(|i| {
            let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
            (angles[after] - angles[before]) / (time[after] - time[before]) * 1e-3
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_those_of_a_line() {
        let time: Vec<f64> = (0..5).map(|i| f64::from(i) * 1e-3).collect();
        let angles: Vec<f64> = (0..5).map(|i| 3.0 * f64::from(i)).collect();
        for rate in rates(&time, &angles) {
            assert!((rate - 3.0).abs() < 1e-9);
        }
    }
}
