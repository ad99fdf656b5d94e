//! Panels: a pair of axes with plots, title and legend.

use std::sync::Arc;

use kuva::plot::LinePlot;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::Scene;

use super::ink::plain;
use super::scale;
use crate::args::Size;

/// An axis with its label and its range.
#[derive(Clone)]
pub(super) struct Axis {
    pub(super) label: String,
    pub(super) range: (f64, f64),
    pub(super) log: bool,
    /// The words at the positions 0, 1, 2, … of the axis; empty for an axis of numbers.
    pub(super) words: Vec<String>,
}

/// A pair of axes with plots.
pub(super) struct Panel {
    pub(super) title: String,
    /// Smaller text below the title, about slices and missing values.
    pub(super) notes: Vec<String>,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) plots: Vec<Plot>,
    /// Heading of the legend, if the legend has a heading.
    pub(super) legend: Option<String>,
    /// True if there is space on the right for a colour bar.
    pub(super) bar: bool,
}

/// The mean width of a letter, relative to the font size.
pub(super) const LETTER: f64 = 0.56;

/// Returns the number of letters of a font size that fit into a width.
fn letters(width: f64, size: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a picture is 200 to 4000 wide"
    )]
    let letters = (width / (size * LETTER)) as usize;
    letters
}

impl Axis {
    /// Returns a linear axis.
    pub(super) fn linear(label: String, range: (f64, f64)) -> Axis {
        Axis { label, range, log: false, words: Vec::new() }
    }

    /// Returns an axis of words, which are at the positions 0, 1, 2, ….
    pub(super) fn of_words(label: String, words: Vec<String>) -> Axis {
        let range = (-0.5, words.len() as f64 - 0.5);
        Axis { words, ..Axis::linear(label, range) }
    }

    /// Returns the word at a position of the axis; empty between two words.
    fn word(words: &[String], value: f64) -> String {
        let at = |place: &usize| (*place as f64 - value).abs() < 1e-6;
        (0..words.len()).find(at).map_or_else(String::new, |place| words[place].clone())
    }
}

impl Panel {
    /// Returns a panel without headings, legend and colour bar.
    pub(super) fn new(x: Axis, y: Axis, plots: Vec<Plot>) -> Panel {
        Panel { title: String::new(), notes: Vec::new(), x, y, plots, legend: None, bar: false }
    }

    /// Returns the library's description of the panel in a picture of `size`.
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
        // The library also uses the ranges of the plots, which may be empty.
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

    /// Returns the panel as a picture.
    pub(super) fn scene(self, size: Size) -> Scene {
        let layout = self.layout(size);
        self.scene_in(layout)
    }

    /// Returns the panel in `layout`, which is [`Panel::layout`] with additions.
    pub(super) fn scene_in(mut self, layout: Layout) -> Scene {
        if self.plots.is_empty() {
            // Without data, the library draws no ticks.
            let ends = [(self.x.range.0, self.y.range.0), (self.x.range.1, self.y.range.1)];
            self.plots.push(Plot::Line(LinePlot::new().with_data(ends).with_color("none")));
        }
        kuva::render::render::render_multiple(self.plots, layout)
    }
}

fn with_ticks(layout: Layout, axis: &Axis, across: bool, size: Size) -> Layout {
    if axis.log {
        let format = TickFormat::Custom(Arc::new(super::label::short));
        return if across {
            layout.with_log_x().with_x_tick_format(format)
        } else {
            layout.with_log_y().with_y_tick_format(format)
        };
    }
    if !axis.words.is_empty() {
        let words: Vec<String> = axis.words.iter().map(|word| plain(word)).collect();
        let format = TickFormat::Custom(Arc::new(move |value| Axis::word(&words, value)));
        return if across {
            layout.with_x_tick_step(1.0).with_x_tick_format(format)
        } else {
            layout.with_y_tick_step(1.0).with_y_tick_format(format)
        };
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

/// The width of a colour bar with its ticks and label.
pub(super) const BAR_MARGIN: f64 = 118.0;
