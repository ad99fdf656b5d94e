//! How pictures look, and how they get into files: the one place that knows the drawing library besides the pictures.

use std::sync::Arc;

use flap_sweep::notation::text::printable;
use kuva::backend::svg::SvgBackend;
use kuva::plot::{ColorMap, LinePlot, ScatterPlot};
use kuva::render::color::Color;
use kuva::render::layout::{ComputedLayout, Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::{raster, scale};
use crate::args::Size;

/// Colours that people with any colour vision tell apart (Okabe and Ito), the darker ones first.
pub(super) const COLOURS: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];

/// The colour of what has no value.
pub(super) const MISSING: &str = "#c9c9c9";

/// The colour of points that are not the matter.
pub(super) const PLAIN: &str = "#8a9199";

/// A colour for `share` of the way from the smallest to the largest value: even in lightness, dark to light.
pub(super) fn shade(share: f64) -> String {
    ColorMap::Viridis.map(share)
}

/// The colour of line number `index` of `count`. Ordered ones go from dark to light.
pub(super) fn line_colour(index: usize, count: usize, ordered: bool) -> String {
    if ordered && count > 2 {
        // The lightest yellow is hard to see on white.
        return shade(0.9 * index as f64 / (count - 1) as f64);
    }
    COLOURS[index % COLOURS.len()].to_owned()
}

/// An axis: what it shows, and from where to where.
#[derive(Clone)]
pub(super) struct Axis {
    pub(super) label: String,
    pub(super) range: (f64, f64),
    pub(super) log: bool,
}

/// One pair of axes and what is in it.
pub(super) struct Panel {
    pub(super) title: String,
    /// Smaller, below: slices, what is left out.
    pub(super) notes: Vec<String>,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) plots: Vec<Plot>,
    /// Heading of the legend, if there is one.
    pub(super) legend: Option<String>,
    /// Room on the right for a colour bar.
    pub(super) bar: bool,
}

/// A text for the library's labels, in which dollars begin formulas and control characters would make no XML.
pub(super) fn plain(text: &str) -> String {
    printable(text).replace('$', "\\$")
}

/// How wide a letter is on average, relative to the size of the text.
pub(super) const LETTER: f64 = 0.56;

/// How many letters of a size fit into a width.
fn letters(width: f64, size: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a picture is 200 to 4000 wide"
    )]
    let letters = (width / (size * LETTER)) as usize;
    letters
}

impl Panel {
    /// The library's description of the panel in a picture of `size`.
    pub(super) fn layout(&self, size: Size) -> Layout {
        // Notes are centred over the plot, which is narrower than the picture.
        let notes_wrap = letters(0.72 * size.width, 12.0);
        let mut layout = Layout::auto_from_plots(&self.plots)
            .with_width(size.width)
            .with_height(size.height)
            .with_x_label(plain(&self.x.label))
            .with_y_label(plain(&self.y.label))
            .with_x_axis_min(self.x.range.0)
            .with_x_axis_max(self.x.range.1)
            .with_y_axis_min(self.y.range.0)
            .with_y_axis_max(self.y.range.1)
            .with_title_size(17)
            .with_label_size(14)
            .with_tick_size(12)
            .with_body_size(12)
            .with_legend_box(false);
        // The library looks at the ranges of the plots too, which may be none.
        (layout.x_range, layout.y_range) = (self.x.range, self.y.range);
        (layout.data_x_range, layout.data_y_range) = (Some(self.x.range), Some(self.y.range));
        "#e4e4e4".clone_into(&mut layout.theme.grid_color);
        "#444444".clone_into(&mut layout.theme.axis_color);
        "#444444".clone_into(&mut layout.theme.tick_color);
        let titles = letters(0.72 * size.width, 17.0);
        if !self.title.is_empty() {
            layout = layout.with_title(plain(&self.title)).with_title_wrap(titles);
        }
        if !self.notes.is_empty() {
            let notes = plain(&self.notes.join(" · "));
            layout = layout.with_subtitle(notes).with_subtitle_size(12).with_subtitle_wrap(notes_wrap);
        }
        if let Some(title) = &self.legend {
            layout = layout.with_legend_wrap(if size.width < 700.0 { 16 } else { 22 });
            if !title.is_empty() {
                layout = layout.with_legend_title(plain(title));
            }
        }
        if self.bar {
            layout.force_margin_right = Some(BAR_MARGIN + if self.legend.is_some() { 10.0 } else { 0.0 });
        }
        for (axis, across) in [(&self.x, true), (&self.y, false)] {
            layout = with_ticks(layout, axis, across, size);
        }
        layout
    }

    /// The panel as a picture of its own.
    pub(super) fn scene(mut self, size: Size) -> Scene {
        let layout = self.layout(size);
        if self.plots.is_empty() {
            // The library draws no ticks around nothing.
            let ends = [(self.x.range.0, self.y.range.0), (self.x.range.1, self.y.range.1)];
            self.plots.push(Plot::Line(LinePlot::new().with_data(ends).with_color("none")));
        }
        kuva::render::render::render_multiple(self.plots, layout)
    }
}

fn with_ticks(layout: Layout, axis: &Axis, across: bool, size: Size) -> Layout {
    if axis.log {
        return if across { layout.with_log_x() } else { layout.with_log_y() };
    }
    let range = axis.range;
    let count =
        if across { (size.width / 90.0).clamp(4.0, 9.0) } else { (size.height / 65.0).clamp(4.0, 9.0) };
    let step = scale::step(range, count);
    let format = TickFormat::Custom(Arc::new(move |value| scale::tick(value, range, step)));
    if across {
        layout.with_x_tick_step(step).with_x_tick_format(format)
    } else {
        layout.with_y_tick_step(step).with_y_tick_format(format)
    }
}

/// A line through points, with gaps where there is no number. Points that stand alone, and those of short lines, have a
/// mark.
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

/// How a line looks.
pub(super) struct Look {
    pub(super) name: String,
    pub(super) colour: String,
    pub(super) width: f64,
    pub(super) dashed: bool,
    /// A mark at every point.
    pub(super) marks: bool,
}

impl Look {
    pub(super) fn new(name: impl Into<String>, colour: impl Into<String>) -> Look {
        Look { name: name.into(), colour: colour.into(), width: 2.0, dashed: false, marks: false }
    }
}

/// Points without a line between them.
pub(super) fn points(points: &[(f64, f64)], name: &str, colour: &str, size: f64) -> Plot {
    let mut plot = ScatterPlot::new().with_data(points.iter().copied()).with_color(colour).with_size(size);
    if !name.is_empty() {
        plot = plot.with_legend(plain(name));
    }
    Plot::Scatter(plot)
}

/// The width that a colour bar takes, with its ticks and label.
const BAR_MARGIN: f64 = 118.0;

/// Draws the colours from the smallest to the largest value on the right, and what `missing` means.
pub(super) fn colour_bar(scene: &mut Scene, frame: &ComputedLayout, axis: &Axis, missing: Option<&str>) {
    const SLICES: usize = 64;
    let (low, high) = axis.range;
    let left = frame.width - BAR_MARGIN + 22.0;
    let top = frame.margin_top;
    let height = frame.plot_height() - if missing.is_some() { 34.0 } else { 0.0 };
    let slice = height / SLICES as f64;
    let numbers = 0..SLICES;
    scene.add(Primitive::RectBatch {
        x: vec![left; SLICES],
        y: numbers.clone().map(|i| top + height - (i + 1) as f64 * slice - 0.25).collect(),
        w: vec![16.0; SLICES],
        h: vec![slice + 0.5; SLICES],
        fills: numbers.map(|i| Color::from(shade(i as f64 / (SLICES - 1) as f64))).collect(),
    });
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

/// A text that begins, ends or is centred at a place.
pub(super) fn text(scene: &mut Scene, (x, y): (f64, f64), content: &str, size: u32, anchor: TextAnchor) {
    let content = content.to_owned();
    scene.add(Primitive::Text { x, y, content, size, anchor, rotate: None, bold: false, color: None });
}

pub(super) fn rectangle(scene: &mut Scene, (x, y): (f64, f64), (width, height): (f64, f64), fill: &str) {
    let fill = Color::from(fill);
    scene.add(Primitive::Rect { x, y, width, height, fill, stroke: None, stroke_width: None, opacity: None });
}

/// The frame around the plot, where something was drawn over it.
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

/// What a picture is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Svg,
    Png,
}

/// The bytes of a picture.
pub(super) fn bytes(scene: Scene, format: Format) -> Result<Vec<u8>, String> {
    match format {
        Format::Svg => Ok(SvgBackend::new().render_scene(&scene).into_bytes()),
        Format::Png => raster::bytes(scene),
    }
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
