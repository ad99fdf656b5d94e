//! Colour bars.

use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use flap_sweep::picture::colours::MISSING;

use super::ink::{rectangle, text};
use super::panel::{Axis, BAR_MARGIN};
use super::scale;
use super::shades::Shades;

/// Draws the colours from the smallest to the largest value on the right, and below them the label of `missing` values.
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
    let beside = left + 23.0 + widest as f64 * 8.0 + 18.0;
    scene.add(Primitive::Text {
        x: beside.min(frame.width - 8.0),
        y: top + height / 2.0,
        content: axis.label.clone(),
        size: 14,
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
