//! Colours for numbers, and colour bars.

use flap_sweep::picture::colours::{MISSING, is_signed};
use kuva::plot::ColorMap;
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::ink::{self, rectangle, text};
use super::panel::{Axis, BAR_MARGIN, DIGIT, LETTER};
use super::scale;

/// A colour map for the numbers within a range.
pub(super) struct Shades {
    range: (f64, f64),
}

impl Shades {
    /// Returns the colour map for the numbers in `range`.
    pub(super) fn of(range: (f64, f64)) -> Shades {
        Shades { range }
    }

    /// Returns true if the range contains negative and positive numbers, so that zero is in the middle of the
    /// colour map.
    pub(super) fn is_signed(&self) -> bool {
        is_signed(self.range.0, self.range.1)
    }

    /// Returns the colour of a number. If the range contains both signs, negative numbers are blue, positive
    /// numbers are red, and equal magnitudes have equally strong colours. If all numbers have the same sign,
    /// the lightness increases evenly with the number.
    pub(super) fn colour(&self, value: f64) -> String {
        let (low, high) = self.range;
        if self.is_signed() {
            let size = high.max(-low);
            return ColorMap::RedBlue.map(0.5 - 0.5 * value / size);
        }
        ink::sequential((value - low) / (high - low))
    }
}

/// Returns a label and a font size that fit into a length. If the label does not fit at the `usual` size, the
/// font is smaller or the label is shortened.
fn fitting(label: &str, length: f64, usual: u32) -> (String, u32) {
    const SMALLEST: u32 = 10;
    let fits = |letters: usize, size: u32| letters as f64 * f64::from(size) * LETTER <= length;
    let letters = label.chars().count();
    if let Some(size) = (SMALLEST..=usual).rev().find(|&size| fits(letters, size)) {
        return (label.to_owned(), size);
    }
    let kept = (1..letters).rev().find(|&kept| fits(kept + 1, SMALLEST)).unwrap_or(1);
    (label.chars().take(kept).chain(['…']).collect(), SMALLEST)
}

/// Draws a colour bar on the right. If `missing` is a text, draws below the bar the colour of missing values
/// with this text.
pub(super) fn colour_bar(scene: &mut Scene, frame: &ComputedLayout, axis: &Axis, missing: Option<&str>) {
    const SLICES: usize = 64;
    let (low, high) = axis.range;
    let left = frame.width - BAR_MARGIN + 22.0;
    let top = frame.margin_top;
    let height = frame.plot_height() - if missing.is_some() { 34.0 } else { 0.0 };
    let slice = height / SLICES as f64;
    let numbers = 0..SLICES;
    let shades = Shades::of(axis.range);
    scene.add(Primitive::RectBatch {
        x: vec![left; SLICES],
        y: numbers.clone().map(|i| top + height - (i + 1) as f64 * slice - 0.25).collect(),
        w: vec![16.0; SLICES],
        h: vec![slice + 0.5; SLICES],
        fills: numbers
            .map(|i| Color::from(shades.colour(low + (high - low) * (i as f64 + 0.5) / SLICES as f64)))
            .collect(),
    });
    if shades.is_signed() {
        let y = top + height * high / (high - low);
        rectangle(scene, (left, y - 0.5), (16.0, 1.0), "#222222");
    }
    let step = scale::step((low, high), (height / 50.0).clamp(2.0, 7.0));
    let mut widest = 0;
    for value in scale::ticks((low, high), step) {
        let y = top + height * (high - value) / (high - low);
        let stroke = Color::from("#444444");
        scene.add(Primitive::Line {
            x1: left + 16.0,
            y1: y,
            x2: left + 20.0,
            y2: y,
            stroke,
            stroke_width: 1.0,
            stroke_dasharray: None,
        });
        let tick = scale::tick(value, (low, high), step);
        widest = widest.max(tick.chars().count());
        text(scene, (left + 23.0, y + 4.2), &tick, 12, TextAnchor::Start);
    }
    let (label, size) = fitting(&axis.label, frame.plot_height(), frame.label_size);
    let beside = left + 25.0 + widest as f64 * 12.0 * DIGIT + 0.9 * f64::from(size);
    scene.add(Primitive::Text {
        x: beside.min(frame.width - 4.0),
        y: top + frame.plot_height() / 2.0,
        content: label,
        size,
        anchor: TextAnchor::Middle,
        rotate: Some(-90.0),
        bold: false,
        color: None,
    });
    if let Some(missing) = missing {
        let y = top + height + 16.0;
        rectangle(scene, (left, y), (16.0, 16.0), MISSING);
        text(scene, (left + 21.0, y + 12.5), missing, 12, TextAnchor::Start);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_fit_beside_the_bar() {
        let label = "Stroke, peak to peak (°)";
        assert_eq!(fitting(label, 300.0, 14), (label.to_owned(), 14));
        assert_eq!(fitting(label, 150.0, 14), (label.to_owned(), 11));
        assert_eq!(fitting(label, 60.0, 14), ("Stroke, p…".to_owned(), 10));
        for length in [20.0, 60.0, 100.0, 140.0, 200.0] {
            let (text, size) = fitting(label, length, 14);
            assert!(text.chars().count() as f64 * f64::from(size) * LETTER <= length, "{length}: {text}");
        }
    }

    #[test]
    fn zero_is_the_middle_of_signed_numbers() {
        let lightness = |colour: &str| {
            let part = |at: usize| u32::from_str_radix(&colour[at..at + 2], 16).unwrap();
            (part(1) + part(3) + part(5), part(1) > part(5))
        };
        let shades = Shades::of((-1.0, 4.0));
        let (zero, below, above) = (shades.colour(0.0), shades.colour(-1.0), shades.colour(1.0));
        assert!(lightness(&zero).0 > lightness(&below).0 && lightness(&zero).0 > lightness(&above).0);
        assert!(!lightness(&below).1 && lightness(&above).1, "{below} is blue, {above} is red");
        assert_ne!(Shades::of((1.0, 4.0)).colour(4.0), shades.colour(4.0));
    }
}
