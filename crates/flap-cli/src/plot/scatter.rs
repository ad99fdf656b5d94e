//! Scatter pictures: two measures of every design as points, coloured by a third column.

use flap_sweep::picture::colours::{MISSING, PLAIN};
use kuva::render::layout::ComputedLayout;
use kuva::render::plots::Plot;
use kuva::render::render::Scene;

use super::canvas::Size;
use super::ink;
use super::panel::{Axis, Panel};
use super::scale;
use super::selection::Selection;
use super::shades::{self, Shades};
use crate::console;
use crate::data::columns::{Cells, Table};
use crate::data::levels::Levels;
use crate::failure::Failure;

/// Draws column `y` over column `x` as points, coloured by column `color`.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let points = Points::of(table, selection)?;
    let (drawn, all) = (points.shown.len(), points.places.len());
    if drawn < all {
        console::say(&format!("{drawn} of {all} points are drawn, evenly chosen"));
    }
    let words =
        selection.columns.color.filter(|&color| matches!(table.columns[color].cells, Cells::Words { .. }));
    let (plots, bar) = match words {
        Some(color) => (points.by_word(table, color), None),
        None => points.plots(table, selection, "")?,
    };
    let mut notes = selection.notes.clone();
    notes.push(format!("{all} designs"));
    notes.extend(points.note());
    let [width, height] = points.extent;
    let (x, y) = (table.label(selection.columns.x), table.label(selection.columns.y));
    let panel = Panel {
        title: selection.title.clone(),
        notes,
        x: Axis::linear(x.text(), scale::padded(width, 0.04)),
        y: Axis::linear(y.text(), scale::padded(height, 0.04)),
        plots,
        legend: words.map(|color| table.label(color).text()),
        bar: bar.is_some(),
    };
    let frame = ComputedLayout::from_layout(&panel.layout(size));
    let mut scene = panel.scene(size);
    if let Some(bar) = &bar {
        shades::colour_bar(&mut scene, &frame, bar, None);
    }
    Ok(scene)
}

/// Largest number of points that a picture shows. All points on a Pareto front are drawn, even if the picture
/// then shows more points.
const MOST_POINTS: usize = 20_000;

/// The radius of points that are not coloured by a column.
pub(super) const SIZE: f64 = 2.2;

/// Number of different colours for points that are coloured by numbers.
const SHADES: usize = 24;

/// The points of a picture.
pub(super) struct Points {
    /// The rows that have both coordinates. `places` contains the coordinates of these rows in the units of
    /// the picture.
    rows: Vec<usize>,
    pub(super) places: Vec<(f64, f64)>,
    /// Ranges of the x- and y-coordinates of the points.
    pub(super) extent: [(f64, f64); 2],
    /// Indices in `places` of the points that the picture shows.
    pub(super) shown: Vec<usize>,
    /// Number of selected rows that lack a coordinate.
    pub(super) missing: usize,
}

impl Points {
    /// Returns the points of the selected rows that have numbers in both columns `x` and `y`.
    pub(super) fn of(table: &Table, selection: &Selection) -> Result<Points, Failure> {
        let (across, up) = (table.numbers(selection.columns.x)?, table.numbers(selection.columns.y)?);
        let (x, y) = (table.label(selection.columns.x), table.label(selection.columns.y));
        let has_place = |&row: &usize| across[row].is_finite() && up[row].is_finite();
        let rows: Vec<usize> = selection.rows.iter().copied().filter(has_place).collect();
        let places: Vec<(f64, f64)> =
            rows.iter().map(|&row| (across[row] * x.factor, up[row] * y.factor)).collect();
        let Some(extent) = scale::extent(&places) else {
            return Err(selection.no_numbers(table, selection.columns.y));
        };
        let shown = scale::even(places.len(), MOST_POINTS);
        let missing = selection.rows.len() - rows.len();
        Ok(Points { rows, places, extent, shown, missing })
    }

    /// Returns the note about rows that lack a coordinate, or `None` if all rows have both coordinates.
    pub(super) fn note(&self) -> Option<String> {
        let all = self.rows.len() + self.missing;
        (self.missing > 0).then(|| format!("{} of {all} designs without values", self.missing))
    }

    /// Returns one plot for each word in the column `color`, with the points of the rows that contain this
    /// word.
    fn by_word(&self, table: &Table, color: usize) -> Vec<Plot> {
        let levels = Levels::of(table, color, &self.rows);
        let mut groups = vec![Vec::new(); levels.len()];
        for &place in &self.shown {
            groups[levels.codes[place]].push(self.places[place]);
        }
        let count = groups.len();
        let plot = |(group, points): (usize, &Vec<(f64, f64)>)| {
            ink::points(points, &levels.value(group).typed(), &ink::line_colour(group, count, false), 2.6)
        };
        groups.iter().enumerate().map(plot).collect()
    }

    /// Returns the points as one plot called `name`. If the picture has a column `color`, returns one plot
    /// for each colour, and the axis of the colour bar.
    pub(super) fn plots(
        &self,
        table: &Table,
        selection: &Selection,
        name: &str,
    ) -> Result<(Vec<Plot>, Option<Axis>), Failure> {
        let Some(color) = selection.columns.color else {
            let plain: Vec<(f64, f64)> = self.shown.iter().map(|&place| self.places[place]).collect();
            return Ok((vec![ink::points(&plain, name, PLAIN, SIZE)], None));
        };
        let values = table.numbers(color)?;
        let label = table.label(color);
        let Some(range) = scale::range(self.rows.iter().map(|&row| values[row] * label.factor)) else {
            return Err(selection.no_numbers(table, color));
        };
        let (low, high) = scale::padded(range, 0.0);
        let mut groups = vec![Vec::new(); SHADES + 1];
        for &place in &self.shown {
            let share = (values[self.rows[place]] * label.factor - low) / (high - low);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to SHADES")]
            let group =
                if share.is_finite() { (share * (SHADES - 1) as f64).round() as usize } else { SHADES };
            groups[group].push(self.places[place]);
        }
        let shades = Shades::of((low, high));
        let plots =
            groups.iter().enumerate().filter(|(_, points)| !points.is_empty()).map(|(group, points)| {
                let colour = match group {
                    SHADES => MISSING.to_owned(),
                    _ => shades.colour(low + (high - low) * group as f64 / (SHADES - 1) as f64),
                };
                ink::points(points, "", &colour, 2.6)
            });
        Ok((plots.collect(), Some(Axis::linear(label.text(), (low, high)))))
    }
}
