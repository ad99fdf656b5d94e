//! Pictures of the control matrix of a vehicle: each cell contains a number, and its colour shows the
//! relative size of the number.

use flap_sweep::picture::colours::MISSING;
use flap_sweep::table::labels;
use flap_sweep::vehicle::control::COMPONENTS;
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::canvas::Size;
use super::ink;
use super::label::digits;
use super::panel::{Axis, LETTER, Panel};
use super::request::{INPUT, MEAN};
use super::selection::Selection;
use super::shades::{self, Shades};
use crate::data::columns::{Cells, NO_WORD, Table};
use crate::failure::Failure;

/// Headings of the columns for the components of force and torque.
const NAMES: [&str; 6] = ["forward", "left", "up", "roll", "pitch", "yaw"];

/// A change is written as "≈0" if it is smaller than this fraction of the largest change that the same input
/// causes.
const LEAST: f64 = 1e-3;

/// A cell is dark, and its number is white, if the change is larger than this fraction of the largest change
/// of the same input.
const DARK: f64 = 0.6;

/// Smallest width of a cell of the matrix. The names of the force and torque components do not fit into
/// narrower cells.
const NARROWEST: f64 = 54.0;

/// The font size of the numbers in the cells.
const SIZE: u32 = 12;

/// Draws the changes of force and torque per unit of each input.
pub(super) fn draw(table: &Table, selection: &Selection, size: Size) -> Result<Scene, Failure> {
    let inputs = words(table, INPUT)?;
    let units = words(table, "unit")?;
    let rows = selection.rows.iter().copied().filter(|&row| inputs[row] != MEAN);
    let rows: Vec<usize> = rows.collect();
    if rows.is_empty() {
        return Err(Failure::usage("the file has no inputs: there is nothing to draw"));
    }
    let columns: Result<Vec<&[f64]>, Failure> =
        COMPONENTS.iter().map(|name| table.numbers(table.find(name)?)).collect();
    let columns = columns?;
    // The first input is on top.
    let names = rows.iter().rev().map(|&row| name(&inputs[row], &units[row]));
    let panel = Panel {
        title: selection.title.clone(),
        notes: selection.notes.clone(),
        bar: true,
        ..Panel::new(
            Axis::of_categories(
                "Force (mN), torque (µN·m)".to_owned(),
                NAMES.map(str::to_owned).to_vec(),
                0.5,
            ),
            Axis::of_categories(String::new(), names.collect(), 0.5),
            Vec::new(),
        )
    };
    let layout = panel.layout(size);
    let frame = ComputedLayout::from_layout(&layout);
    let missing = NARROWEST * COMPONENTS.len() as f64 - frame.plot_width();
    if missing > 0.0 {
        let factor = (size.width + missing) / size.width;
        let message =
            format!("the picture is too narrow for the matrix: it must be {factor:.2} times as wide");
        return Err(Failure::usage(message).help("set a larger --size, or a smaller --font-size"));
    }
    let mut scene = panel.scene_in(layout);
    let shades = Shades::of((-1.0, 1.0));
    let mut cells = Vec::new();
    for (line, &row) in rows.iter().rev().enumerate() {
        let changes: Vec<f64> = columns.iter().map(|column| column[row]).collect();
        let finite = changes.iter().filter(|change| change.is_finite());
        let largest = finite.fold(0.0, |largest: f64, change| largest.max(change.abs()));
        let share = |change: f64| if largest > 0.0 { change / largest } else { change };
        cells.extend(changes.into_iter().enumerate().map(|(place, change)| Cell {
            sides: [0.5, 1.5].map(|edge| frame.map_x(place as f64 + edge)),
            ends: [1.5, 0.5].map(|edge| frame.map_y(line as f64 + edge)),
            change,
            share: share(change),
        }));
    }
    // Numbers are drawn above the colours of neighbours.
    for cell in &cells {
        cell.fill(&mut scene, &shades);
    }
    for cell in &cells {
        cell.number(&mut scene);
    }
    ink::frame_lines(&mut scene, &frame);
    let label = "Share of the input's largest change".to_owned();
    shades::colour_bar(&mut scene, &frame, &Axis::linear(label, (-1.0, 1.0)), None);
    Ok(scene)
}

/// A cell of the matrix: the change of a component of force or torque, and this change as a fraction of the
/// input's largest change.
struct Cell {
    sides: [f64; 2],
    ends: [f64; 2],
    change: f64,
    share: f64,
}

impl Cell {
    fn fill(&self, scene: &mut Scene, shades: &Shades) {
        let Cell { sides, ends, share, .. } = self;
        let fill = if share.is_finite() { shades.colour(*share) } else { MISSING.to_owned() };
        ink::rectangle(scene, (sides[0], ends[0]), (sides[1] - sides[0], ends[1] - ends[0] - 1.0), &fill);
    }

    fn number(&self, scene: &mut Scene) {
        let Cell { sides, ends, share, .. } = self;
        scene.add(Primitive::Text {
            x: f64::midpoint(sides[0], sides[1]),
            y: f64::midpoint(ends[0], ends[1]) + 4.2,
            content: self.text(),
            size: SIZE,
            anchor: TextAnchor::Middle,
            rotate: None,
            bold: false,
            color: (share.abs() > DARK).then(|| Color::from("#ffffff")),
        });
    }

    /// Returns the change as text with three digits, or with two digits and an exponent if the cell is
    /// narrow.
    fn text(&self) -> String {
        let Cell { sides, change, share, .. } = *self;
        if change.is_nan() {
            return "?".to_owned();
        }
        if change != 0.0 && share.abs() < LEAST {
            return "≈0".to_owned();
        }
        let text = digits(change, 3);
        let is_wide = |text: &str| text.len() as f64 * LETTER * f64::from(SIZE) > sides[1] - sides[0] - 4.0;
        let text = if is_wide(&text) { format!("{change:.1e}") } else { text };
        text.replace('-', "−")
    }
}

/// Returns the name of an input with its unit, such as `Bias, per V`, because the changes are per unit of the
/// input.
fn name(input: &str, unit: &str) -> String {
    let words = labels::with_unit(input, unit);
    if words.unit.is_empty() { words.words } else { format!("{}, per {}", words.words, words.unit) }
}

/// Returns the word in each row of a column, or empty texts if the column contains no words.
fn words(table: &Table, column: &str) -> Result<Vec<String>, Failure> {
    let text = |code: &u32, words: &[String]| {
        if *code == NO_WORD { String::new() } else { words[*code as usize].clone() }
    };
    Ok(match &table.columns[table.find(column)?].cells {
        Cells::Words { codes, words } => codes.iter().map(|code| text(code, words)).collect(),
        Cells::Numbers(_) | Cells::Unread => vec![String::new(); table.rows],
    })
}
