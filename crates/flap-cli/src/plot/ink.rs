//! Functions that draw lines, points and texts, and choose colours.

use flap_sweep::notation::text::printable;
use flap_sweep::picture::colours;
use kuva::plot::{ColorMap, LinePlot, ScatterPlot};
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, TextAnchor};

/// Returns the colour of line number `index` of `count` lines. If the lines are ordered, their colours go
/// from dark to light.
pub(super) fn line_colour(index: usize, count: usize, ordered: bool) -> String {
    match colours::shade(index, count) {
        Some(share) if ordered => sequential(share),
        _ => colours::SERIES[index % colours::SERIES.len()].to_owned(),
    }
}

/// Returns the colour of a value that is at the fraction `share` of the range of values. The lightness
/// increases evenly with `share`.
pub(super) fn sequential(share: f64) -> String {
    ColorMap::Viridis.map(share)
}

/// Returns a text that the drawing library can use as a label. Control characters, which XML forbids, are
/// removed, and dollar signs, which begin formulas, are escaped.
pub(super) fn plain(text: &str) -> String {
    printable(text).replace('$', "\\$")
}

/// Returns a line through points, with a gap at each point that contains NaN. A point between two gaps has a
/// mark, and with `look.marks` all points have marks.
pub(super) fn line(points: &[(f64, f64)], look: &Look) -> Vec<Plot> {
    let whole = |point: &(f64, f64)| point.0.is_finite() && point.1.is_finite();
    let mut plots: Vec<Plot> = Vec::new();
    let mut marked: Vec<(f64, f64)> = Vec::new();
    let mut named = false;
    for stretch in points.split(|point| !whole(point)).filter(|stretch| !stretch.is_empty()) {
        if look.marks || stretch.len() == 1 {
            marked.extend_from_slice(stretch);
        }
        if stretch.len() < 2 {
            continue;
        }
        let mut line = LinePlot::new()
            .with_data(stretch.iter().copied())
            .with_color(look.colour.as_str())
            .with_stroke_width(look.width);
        if look.dashed {
            line = line.with_dashed();
        }
        if !named && !look.name.is_empty() {
            line = line.with_legend(plain(&look.name));
            named = true;
        }
        plots.push(Plot::Line(line));
    }
    if !marked.is_empty() {
        let mut marks =
            ScatterPlot::new().with_data(marked).with_color(look.colour.as_str()).with_size(look.width + 0.9);
        if !named && !look.name.is_empty() {
            marks = marks.with_legend(plain(&look.name));
        }
        plots.push(Plot::Scatter(marks));
    }
    plots
}

/// The name of a line in the legend, and the colour, width, dashes and marks of the line.
pub(super) struct Look {
    pub(super) name: String,
    pub(super) colour: String,
    pub(super) width: f64,
    pub(super) dashed: bool,
    /// True if the line has a mark at every point.
    pub(super) marks: bool,
}

impl Look {
    pub(super) fn new(name: impl Into<String>, colour: impl Into<String>) -> Look {
        Look { name: name.into(), colour: colour.into(), width: 2.0, dashed: false, marks: false }
    }
}

/// Returns a plot of points that no line connects.
pub(super) fn points(points: &[(f64, f64)], name: &str, colour: &str, size: f64) -> Plot {
    let mut plot = ScatterPlot::new().with_data(points.iter().copied()).with_color(colour).with_size(size);
    if !name.is_empty() {
        plot = plot.with_legend(plain(name));
    }
    Plot::Scatter(plot)
}

/// The line width of the rings around points.
pub(super) const RING_WIDTH: f64 = 0.8;

/// Returns a plot of rings around points. The points inside the rings stay visible.
pub(super) fn rings(points: &[(f64, f64)], colour: &str, size: f64) -> Plot {
    let plot = ScatterPlot::new().with_data(points.iter().copied()).with_color(colour).with_size(size);
    Plot::Scatter(plot.with_marker_opacity(0.0).with_marker_stroke_width(RING_WIDTH))
}

/// Draws a dashed line between two positions of a picture.
pub(super) fn dashes(scene: &mut Scene, from: (f64, f64), to: (f64, f64), (colour, width): (&str, f64)) {
    scene.add(Primitive::PolyLine {
        points: vec![from, to],
        stroke: Color::from(colour),
        stroke_width: width,
        stroke_dasharray: Some("4 3".to_owned()),
    });
}

/// Draws a text at a position. `anchor` determines whether the text begins, ends or is centred at this
/// position.
pub(super) fn text(scene: &mut Scene, (x, y): (f64, f64), content: &str, size: u32, anchor: TextAnchor) {
    let content = content.to_owned();
    scene.add(Primitive::Text { x, y, content, size, anchor, rotate: None, bold: false, color: None });
}

pub(super) fn rectangle(scene: &mut Scene, (x, y): (f64, f64), (width, height): (f64, f64), fill: &str) {
    let fill = Color::from(fill);
    scene.add(Primitive::Rect { x, y, width, height, fill, stroke: None, stroke_width: None, opacity: None });
}

/// Draws the frame around the plot again, because the contents of the plot cover the frame.
pub(super) fn frame_lines(scene: &mut Scene, frame: &ComputedLayout) {
    scene.add(Primitive::Rect {
        x: frame.margin_left,
        y: frame.margin_top,
        width: frame.plot_width(),
        height: frame.plot_height(),
        fill: Color::None,
        stroke: Some(Color::from("#444444")),
        stroke_width: Some(1.0),
        opacity: None,
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_have_gaps_where_numbers_are_missing() {
        let none = f64::NAN;
        let points = [(0.0, 1.0), (1.0, 2.0), (2.0, none), (3.0, 4.0), (4.0, none), (5.0, 1.0), (6.0, 1.0)];
        let plots = line(&points, &Look::new("a", "#000000"));
        let lengths: Vec<usize> = plots
            .iter()
            .filter_map(|plot| if let Plot::Line(line) = plot { Some(line.data.len()) } else { None })
            .collect();
        assert_eq!(lengths, [2, 2]);
        let marks = plots.iter().filter(|plot| matches!(plot, Plot::Scatter(marks) if marks.data.len() == 1));
        assert_eq!(marks.count(), 1, "the one between two gaps");
        let named = |plot: &&Plot| matches!(plot, Plot::Line(line) if line.legend_label.is_some());
        assert_eq!(plots.iter().filter(named).count(), 1);
    }

    #[test]
    fn dollars_are_no_formulas() {
        assert_eq!(plain("a$b$"), "a\\$b\\$");
    }
}
