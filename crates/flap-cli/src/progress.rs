//! The progress bar of a sweep, on stderr if that is a terminal.

use std::fmt::Write;

use flap_sweep::run::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::console;

/// The progress of a run.
pub(crate) struct Bar {
    drawn: ProgressBar,
    /// The units of the run, such as "points".
    units: &'static str,
    moved: bool,
    stopping: bool,
}

impl Bar {
    /// A bar that counts `units`, such as "points". Hidden unless stderr is a terminal, and if the user wants no progress.
    pub(crate) fn new(units: &'static str) -> Bar {
        let template =
            format!("{{wide_bar}} {{human_pos}} of {{human_len}} {units}, {{rate}} {units}/s, {{eta}} left");
        let style = ProgressStyle::with_template(&template)
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .with_key("rate", write_rate);
        let target =
            if console::is_quiet() { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let drawn = ProgressBar::with_draw_target(None, target).with_style(style);
        Bar { drawn, units, moved: false, stopping: false }
    }

    /// Moves the bar. When the sweep begins to stop, prints that once.
    pub(crate) fn show(&mut self, progress: Progress, stopping: bool) {
        self.drawn.set_length(progress.points);
        self.drawn.set_position(progress.finished);
        if !self.moved {
            // Points of earlier sessions took no time in this one.
            self.moved = true;
            self.drawn.reset_eta();
        }
        if stopping && !self.stopping {
            self.stopping = true;
            let units = self.units;
            self.aside(|| {
                console::say(&format!(
                    "stopping: running {units} have half a second to finish; interrupt again to stop at once"
                ));
            });
        }
    }

    /// Writes something while the bar is hidden.
    pub(crate) fn aside<T>(&self, write: impl FnOnce() -> T) -> T {
        self.drawn.suspend(write)
    }

    /// Removes the bar.
    pub(crate) fn clear(&self) {
        self.drawn.finish_and_clear();
    }
}

fn write_rate(state: &ProgressState, text: &mut dyn Write) {
    // A write into memory does not fail.
    let _ = write!(text, "{:.0}", state.per_sec());
}
