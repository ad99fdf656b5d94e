//! Panels of a picture. A panel is a pair of axes with plots, title and legend.

use std::sync::Arc;

use kuva::plot::LinePlot;
use kuva::render::layout::{ComputedLayout, Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::Scene;

use super::canvas::{Size, TEXT};
use super::ink::plain;
use super::scale;

/// An axis with its label and its range.
#[derive(Clone)]
pub(super) struct Axis {
    pub(super) label: String,
    pub(super) range: (f64, f64),
    pub(super) log: bool,
    /// The words at the positions 0, 1, 2, … of the axis. Empty for an axis of numbers.
    pub(super) words: Vec<String>,
    /// The names of rows or columns at the positions 1, 2, 3, … of the axis. Empty for an axis of numbers.
    pub(super) categories: Vec<String>,
}

/// A pair of axes with plots, title and legend.
pub(super) struct Panel {
    pub(super) title: String,
    /// Small texts below the title, for example about chosen values of axes and about missing values.
    pub(super) notes: Vec<String>,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) plots: Vec<Plot>,
    /// Heading of the legend. The text is empty for a legend without a heading, and `None` means that the
    /// panel has no legend.
    pub(super) legend: Option<String>,
    /// True if the panel has space for a colour bar on the right.
    pub(super) bar: bool,
}

/// The mean width of a letter as a fraction of the font size.
pub(super) const LETTER: f64 = 0.56;

/// Returns the number of letters with the font size `size` that fit into a line of the given width.
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
        Axis { label, range, log: false, words: Vec::new(), categories: Vec::new() }
    }

    /// Returns an axis with words at the positions 0, 1, 2, ….
    pub(super) fn of_words(label: String, words: Vec<String>) -> Axis {
        let range = (-0.5, words.len() as f64 - 0.5);
        Axis { words, ..Axis::linear(label, range) }
    }

    /// Returns an axis with names at the positions 1, 2, 3, …. The axis begins `margin` before the first name
    /// and ends `margin` after the last name.
    pub(super) fn of_categories(label: String, categories: Vec<String>, margin: f64) -> Axis {
        let range = (1.0 - margin, categories.len() as f64 + margin);
        Axis { categories, ..Axis::linear(label, range) }
    }

    /// Returns the word at the position `value` of an axis, or an empty text if no word is at this position.
    fn word(words: &[String], value: f64) -> String {
        let at = |place: &usize| (*place as f64 - value).abs() < 1e-6;
        (0..words.len()).find(at).map_or_else(String::new, |place| words[place].clone())
    }
}

impl Panel {
    /// Returns a panel without title, notes, legend and colour bar.
    pub(super) fn new(x: Axis, y: Axis, plots: Vec<Plot>) -> Panel {
        Panel { title: String::new(), notes: Vec::new(), x, y, plots, legend: None, bar: false }
    }

    /// Returns the layout of the panel in a picture of `size`, in the form that the drawing library requires.
    pub(super) fn layout(&self, size: Size) -> Layout {
        // The margins on the left and on the right depend on the texts, but not on the lines of labels and headings.
        let frame = ComputedLayout::from_layout(&self.unwrapped(size));
        let (width, height) = (frame.plot_width(), frame.plot_height());
        let mut layout = self.unwrapped(size);
        for (axis, across, length) in [(&self.x, true, width), (&self.y, false, height)] {
            layout = with_ticks(layout, axis, across, length);
        }
        // Headings and labels are centred over the plot, which is narrower than the picture.
        let middle = frame.margin_left + width / 2.0;
        let room = 2.0 * middle.min(size.width - middle);
        let centre = frame.margin_top + height / 2.0;
        let upright = 2.0 * centre.min(size.height - centre);
        let heading = room.min(0.72 * size.width);
        let label = f64::from(size.label);
        layout
            .with_title_wrap(letters(heading, f64::from(size.title)))
            .with_subtitle_wrap(letters(heading, f64::from(TEXT)))
            .with_x_label_wrap(letters(room, label))
            .with_y_label_wrap(letters(upright, label))
    }

    /// Returns the layout without ticks and without line breaks in long texts.
    fn unwrapped(&self, size: Size) -> Layout {
        let mut layout = Layout::auto_from_plots(&self.plots)
            .with_width(size.width)
            .with_height(size.height)
            .with_x_label(plain(&self.x.label))
            .with_y_label(plain(&self.y.label))
            .with_x_axis_min(self.x.range.0)
            .with_x_axis_max(self.x.range.1)
            .with_y_axis_min(self.y.range.0)
            .with_y_axis_max(self.y.range.1)
            .with_title_size(size.title)
            .with_label_size(size.label)
            .with_tick_size(TEXT)
            .with_body_size(TEXT)
            .with_legend_box(false);
        // The library also uses the ranges of the plots, which may be empty.
        (layout.x_range, layout.y_range) = (self.x.range, self.y.range);
        (layout.data_x_range, layout.data_y_range) = (Some(self.x.range), Some(self.y.range));
        "#e4e4e4".clone_into(&mut layout.theme.grid_color);
        "#444444".clone_into(&mut layout.theme.axis_color);
        "#444444".clone_into(&mut layout.theme.tick_color);
        // Without a title, the picture has no heading at all.
        if !self.title.is_empty() {
            layout = layout.with_title(plain(&self.title));
            if !self.notes.is_empty() {
                layout = layout.with_subtitle(plain(&self.notes.join(" · "))).with_subtitle_size(TEXT);
            }
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
        if !self.x.categories.is_empty() {
            layout = layout.with_x_categories(self.x.categories.iter().map(|name| plain(name)).collect());
        }
        if !self.y.categories.is_empty() {
            layout = layout.with_y_categories(self.y.categories.iter().map(|name| plain(name)).collect());
        }
        layout
    }

    /// Draws the panel with the layout of [`Panel::layout`].
    pub(super) fn scene(self, size: Size) -> Scene {
        let layout = self.layout(size);
        self.scene_in(layout)
    }

    /// Draws the panel with the given layout, which is the result of [`Panel::layout`] with additions of the
    /// caller.
    pub(super) fn scene_in(mut self, layout: Layout) -> Scene {
        if self.plots.is_empty() {
            // Without data, the library draws no ticks.
            let ends = [(self.x.range.0, self.y.range.0), (self.x.range.1, self.y.range.1)];
            self.plots.push(Plot::Line(LinePlot::new().with_data(ends).with_color("none")));
        }
        kuva::render::render::render_multiple(self.plots, layout)
    }
}

/// Adds the ticks of an axis to the layout. `length` is the length of the axis in the picture.
fn with_ticks(layout: Layout, axis: &Axis, across: bool, length: f64) -> Layout {
    let range = axis.range;
    let step = if axis.log || !axis.words.is_empty() { 1.0 } else { step(range, across, length) };
    let format = if axis.log {
        TickFormat::Custom(Arc::new(super::label::short))
    } else if axis.words.is_empty() {
        TickFormat::Custom(Arc::new(move |value| scale::tick(value, range, step)))
    } else {
        let words: Vec<String> = axis.words.iter().map(|word| plain(word)).collect();
        TickFormat::Custom(Arc::new(move |value| Axis::word(&words, value)))
    };
    match (axis.log, across) {
        (true, true) => layout.with_log_x().with_x_tick_format(format),
        (true, false) => layout.with_log_y().with_y_tick_format(format),
        (false, true) => layout.with_x_tick_step(step).with_x_tick_format(format),
        (false, false) => layout.with_y_tick_step(step).with_y_tick_format(format),
    }
}

/// Returns a distance between ticks at which the numbers of the ticks do not overlap. If possible, the axis
/// has at least two ticks.
fn step(range: (f64, f64), across: bool, length: f64) -> f64 {
    /// Smallest space between the numbers of two ticks.
    const GAP: f64 = 10.0;
    /// Height of a number and the space above the number, relative to the font size.
    const LINE: f64 = 1.4;
    let text = f64::from(TEXT);
    let rough: f64 = if across { length / 75.0 } else { length / 52.0 };
    let mut count = rough.clamp(4.0, 9.0);
    let mut step = scale::step(range, count);
    loop {
        let numbers = |step: f64| {
            scale::ticks(range, step).into_iter().map(move |value| scale::tick(value, range, step))
        };
        let widest = numbers(step).map(|number| number.chars().count()).max().unwrap_or(0);
        let needed = if across { widest as f64 * text * DIGIT + GAP } else { text * LINE };
        count *= 0.8;
        let next = scale::step(range, count);
        if length * step / (range.1 - range.0) >= needed || numbers(next).count() < 2 {
            return step;
        }
        step = next;
    }
}

/// The width of a digit as a fraction of the font size.
pub(super) const DIGIT: f64 = 0.64;

/// The width of the margin for a colour bar with its ticks and label.
pub(super) const BAR_MARGIN: f64 = 118.0;
