//! Pictures of stroke and pitch over time, for one motion or several motions. The picture of one motion also
//! shows the phase portraits: rate over angle.

use std::collections::{BTreeMap, HashSet};

use flap_sweep::picture::colours;
use flap_sweep::table::labels;
use kuva::render::figure::Figure;
use kuva::render::plots::Plot;
use kuva::render::render::Scene;

use super::canvas::{Size, TEXT};
use super::ink::{self, Look};
use super::panel::{Axis, LETTER, Panel};
use super::scale;
use super::selection::Selection;
use crate::console;
use crate::data::columns::Table;
use crate::data::levels::Levels;
use crate::failure::Failure;

/// Largest number of points in a line. Longer lines are thinned.
const MOST_POINTS: usize = 8000;

/// The angles that the picture shows. The column names of the angles begin with these words.
const ANGLES: [&str; 2] = ["stroke", "pitch"];

/// Largest number of motions in a picture, because the reader cannot distinguish a larger number of motions.
const MOST_MOTIONS: usize = 16;

/// Draws one motion with its phase portraits, or several motions over time.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let motions = motions(table, selection);
    if motions.len() > 1 {
        draw_several(table, selection, &motions, size)
    } else {
        draw_one(table, selection, size)
    }
}

/// One motion of the file: its name, rows and colour in the picture.
struct Motion {
    name: String,
    rows: Vec<usize>,
    colour: String,
}

/// Groups the rows into motions by the columns to the left of the time column. For several designs, `flap
/// run` writes the names of the designs into these columns.
fn motions(table: &Table, selection: &Selection) -> Vec<Motion> {
    let rows = &selection.rows;
    let levels = (0..selection.columns.x).map(|column| (column, Levels::of(table, column, rows)));
    // A column with a different value in almost every row, such as the number of a camera frame, names no designs.
    let keys: Vec<(usize, Levels)> =
        levels.filter(|(_, levels)| levels.len() > 1 && 2 * levels.len() <= rows.len()).collect();
    let mut found: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
    for (place, &row) in rows.iter().enumerate() {
        let key = keys.iter().map(|(_, levels)| levels.codes[place]).collect();
        found.entry(key).or_default().push(row);
    }
    let shown = scale::even(found.len(), MOST_MOTIONS);
    if shown.len() < found.len() {
        let (drawn, all) = (shown.len(), found.len());
        console::say(&format!(
            "{drawn} of {all} motions are drawn, evenly chosen; --where chooses one motion"
        ));
    }
    let is_ordered = keys.len() == 1 && table.numbers(keys[0].0).is_ok();
    let named = |key: &[usize]| {
        let parts = keys.iter().zip(key);
        let parts = parts.map(|((column, levels), &code)| levels.text(code, &table.label(*column)));
        parts.collect::<Vec<String>>().join(", ")
    };
    let motions: Vec<(Vec<usize>, Vec<usize>)> = found.into_iter().collect();
    (shown.iter().enumerate())
        .map(|(place, &number)| Motion {
            name: named(&motions[number].0),
            rows: motions[number].1.clone(),
            colour: ink::line_colour(place, shown.len(), is_ordered),
        })
        .collect()
}

/// Draws several motions over time. The panel with the stroke is above the panel with the pitch.
fn draw_several(
    table: &Table,
    selection: &Selection,
    motions: &[Motion],
    size: Size,
) -> Result<Scene, Failure> {
    let time = table.numbers(selection.columns.x)?;
    let label = table.label(selection.columns.x);
    let mut panels = Vec::new();
    for (place, angle) in ANGLES.iter().enumerate() {
        let column = table.find(&format!("{angle}_deg"))?;
        let values = table.numbers(column)?;
        let (mut lines, mut drawn) = (Vec::new(), Vec::new());
        for Motion { name, rows, colour } in motions {
            let motion: Vec<(f64, f64)> =
                rows.iter().map(|&row| (time[row] * label.factor, values[row])).collect();
            let motion = scale::thinned(&motion, MOST_POINTS);
            // The legend names each motion once.
            let name = if place == 0 { name.as_str() } else { "" };
            lines.extend(ink::line(&motion, &Look { width: 1.8, ..Look::new(name, colour.as_str()) }));
            drawn.extend(motion);
        }
        let Some([span, angles]) = scale::extent(&drawn) else {
            return Err(selection.no_numbers(table, column));
        };
        panels.push(Panel::new(
            Axis::linear(label.text(), scale::padded(span, 0.0)),
            Axis::linear(table.label(column).text(), scale::padded(angles, 0.05)),
            lines,
        ));
    }
    Ok(figure(panels, Arrangement::Below, &selection.title, &selection.notes, size))
}

/// Draws one motion over time in a first panel, and its phase portraits in a second panel. In a narrow
/// picture, the second panel is below the first panel, otherwise beside it.
fn draw_one(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
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
            let rates = table.numbers(column)?;
            selection.rows.iter().map(|&row| rates[row].to_degrees() * 1e-3).collect()
        } else {
            console::say(&format!("the rate of the {angle} is computed from differences of its samples"));
            rates(time, values, &selection.rows)
        };
        let motion: Vec<(f64, f64)> =
            selection.rows.iter().map(|&row| (time[row] * label.factor, values[row])).collect();
        let mut around: Vec<(f64, f64)> =
            selection.rows.iter().zip(&rates).map(|(&row, &rate)| (values[row], rate)).collect();
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
        return Err(selection.no_numbers(table, selection.columns.x));
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
    let arrangement = if size.is_narrow() { Arrangement::Below } else { Arrangement::Beside };
    Ok(figure(vec![left, right], arrangement, &selection.title, &notes, size))
}

/// The arrangement of panels.
#[derive(Clone, Copy, PartialEq)]
enum Arrangement {
    /// The panels are side by side.
    Beside,
    /// The panels are one below the other.
    Below,
}

/// Draws several panels below a common title, with a common legend on the right.
///
/// Long names in the legend are shortened, so that at least 40 % of the picture's width remains for the
/// panels.
fn figure(
    mut panels: Vec<Panel>,
    arrangement: Arrangement,
    title: &str,
    notes: &[String],
    size: Size,
) -> Scene {
    /// The width of the legend without the names in the legend.
    const LEGEND: f64 = 75.0;
    let letter = LETTER * f64::from(TEXT);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred")]
    let most = ((0.6 * size.width - LEGEND) / letter).max(6.0) as usize;
    let names = panels.iter_mut().flat_map(|panel| &mut panel.plots).filter_map(|plot| match plot {
        Plot::Line(line) => line.legend_label.as_mut(),
        _ => None,
    });
    let mut names: Vec<&mut String> = names.collect();
    let shown = shortened(&names.iter().map(|name| name.as_str()).collect::<Vec<&str>>(), most);
    let longest = shown.iter().map(|name| name.chars().count()).max().unwrap_or(0) as f64;
    for (name, shown) in names.iter_mut().zip(shown) {
        **name = shown;
    }
    let count = panels.len();
    let (rows, columns) = if arrangement == Arrangement::Beside { (1, count) } else { (count, 1) };
    let width = size.width - LEGEND - longest * letter;
    let panel = Size { width: width / columns as f64, height: (size.height - 60.0) / rows as f64, ..size };
    let layouts = panels.iter().map(|one| {
        let mut layout = one.layout(panel);
        // A background would cover parts of the title.
        for colour in [&mut layout.theme.legend_border, &mut layout.theme.legend_bg] {
            "none".clone_into(colour);
        }
        layout
    });
    let layouts = layouts.collect();
    let mut figure = Figure::new(rows, columns)
        .with_plots(panels.into_iter().map(|panel| panel.plots).collect())
        .with_layouts(layouts)
        .with_shared_legend_right_top()
        .with_spacing(4.0)
        .with_padding(4.0)
        .with_figure_size(size.width, size.height);
    if !title.is_empty() {
        let title: Vec<&str> = std::iter::once(title).chain(notes.iter().map(String::as_str)).collect();
        let title = title.join(" · ");
        // The title has only one line, so a long title gets smaller letters.
        let letters = size.width / (LETTER * title.chars().count().max(1) as f64);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "9 to 17")]
        let letters = letters.clamp(9.0, f64::from(size.title)) as u32;
        figure = figure.with_title(ink::plain(&title)).with_title_size(letters);
    }
    figure.render()
}

/// Returns `names` with at most `most` letters each. An ellipsis replaces the common beginning of all names,
/// and the middle of long names. If two shortened names are equal, all names begin with a number.
fn shortened(names: &[&str], most: usize) -> Vec<String> {
    let letters: Vec<Vec<char>> = names.iter().map(|name| name.chars().collect()).collect();
    if letters.iter().all(|name| name.len() <= most) {
        return names.iter().map(|name| (*name).to_owned()).collect();
    }
    let is_common = |place: &usize| letters.iter().all(|name| name.get(*place) == letters[0].get(*place));
    let common = if letters.len() > 1 { (0..letters[0].len()).take_while(is_common).count() } else { 0 };
    let cut = |name: &[char], most: usize| {
        let name = if common > 1 { [&['…'], &name[common..]].concat() } else { name.to_vec() };
        if name.len() <= most {
            return name.into_iter().collect();
        }
        let (begin, end) = (most / 2, most - most / 2 - 1);
        name[..begin].iter().chain(&['…']).chain(&name[name.len() - end..]).collect::<String>()
    };
    let short: Vec<String> = letters.iter().map(|name| cut(name, most)).collect();
    if short.iter().collect::<HashSet<_>>().len() == short.len() {
        return short;
    }
    let numbered = letters.iter().enumerate();
    numbered
        .map(|(place, name)| format!("{}: {}", place + 1, cut(name, most.saturating_sub(4).max(4))))
        .collect()
}

/// Returns the angular rates of one motion in degrees per millisecond. The rates are computed from
/// differences between neighbouring rows of the motion.
fn rates(time: &[f64], angles: &[f64], rows: &[usize]) -> Vec<f64> {
    let last = rows.len().saturating_sub(1);
    (0..rows.len())
        .map(|i| {
            let (before, after) = (rows[i.saturating_sub(1)], rows[(i + 1).min(last)]);
            (angles[after] - angles[before]) / (time[after] - time[before]) * 1e-3
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_differ_after_they_are_shortened() {
        assert_eq!(shortened(&["150 V, 120 Hz"], 13), ["150 V, 120 Hz"]);
        assert_eq!(shortened(&["wing_with_stiff_hinge_v2, 150 V"], 11), ["wing_…150 V"]);
        let names =
            ["wing_with_stiff_hinge, 120 V", "wing_with_stiff_hinge, 150 V", "wing_with_soft_hinge, 150 V"];
        assert_eq!(shortened(&names, 12), ["…tiff_…120 V", "…tiff_…150 V", "…oft_h…150 V"]);
        let names = ["a long wing, 150 V", "b long first wing, 150 V", "b long third wing, 150 V"];
        assert_eq!(shortened(&names, 9), ["1: a … V", "2: b … V", "3: b … V"]);
    }

    #[test]
    fn rates_are_those_of_a_line() {
        let time: Vec<f64> = (0..5).map(|i| f64::from(i) * 1e-3).collect();
        let angles: Vec<f64> = (0..5).map(|i| 3.0 * f64::from(i)).collect();
        for rate in rates(&time, &angles, &[0, 1, 2, 3, 4]) {
            assert!((rate - 3.0).abs() < 1e-9);
        }
    }

    #[test]
    fn rates_contain_no_differences_between_motions() {
        let time = [0.0, 1e-3, 2e-3, 0.0, 1e-3, 2e-3];
        let angles = [0.0, 3.0, 6.0, 50.0, 57.0, 64.0];
        for (rows, slope) in [([0, 1, 2], 3.0), ([3, 4, 5], 7.0)] {
            for rate in rates(&time, &angles, &rows) {
                assert!((rate - slope).abs() < 1e-9, "{rate} {slope}");
            }
        }
    }
}
