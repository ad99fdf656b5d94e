//! The progress of a sweep on stderr: a bar in a terminal, otherwise one line per minute.

use std::fmt::Write;
use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use flap_sweep::run::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::{console, duration};

/// The progress of a run.
pub(crate) struct Bar {
    drawn: ProgressBar,
    /// Progress that is printed as lines of text, if stderr is not a terminal.
    log: Option<Log>,
    /// The word for the items that the run counts, such as "points".
    units: &'static str,
    moved: bool,
    stopping: bool,
}

impl Bar {
    /// Returns the progress of a run that counts `units`, such as "points". If the user gave `--quiet`, no
    /// progress is printed.
    pub(crate) fn new(units: &'static str) -> Bar {
        let template =
            format!("{{wide_bar}} {{human_pos}} of {{human_len}} {units}, {{rate}} {units}/s, {{eta}} left");
        let style = ProgressStyle::with_template(&template)
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .with_key("rate", write_rate);
        let target =
            if console::is_quiet() { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let drawn = ProgressBar::with_draw_target(None, target).with_style(style);
        let log = (!stderr().is_terminal()).then(|| Log::new(Instant::now()));
        Bar { drawn, log, units, moved: false, stopping: false }
    }

    /// Moves the progress bar. At the first call in which `stopping` is true, prints a note that the run
    /// stops.
    pub(crate) fn show(&mut self, progress: Progress, stopping: bool) {
        self.drawn.set_length(progress.points);
        self.drawn.set_position(progress.finished);
        if !self.moved {
            // Points of earlier sessions were not computed in this one.
            self.moved = true;
            self.drawn.reset_eta();
        }
        if let Some(line) = self.log.as_mut().and_then(|log| log.line(progress, self.units, Instant::now())) {
            console::say(&line);
        }
        if stopping && !self.stopping {
            self.stopping = true;
            let units = self.units;
            self.aside(|| {
                console::say(&format!(
                    "stopping: running {units} have 0.4 s to finish; interrupt flap again to stop it at once"
                ));
            });
        }
    }

    /// Runs `write` while the progress bar is hidden.
    pub(crate) fn aside<T>(&self, write: impl FnOnce() -> T) -> T {
        self.drawn.suspend(write)
    }

    /// Removes the bar.
    pub(crate) fn clear(&self) {
        self.drawn.finish_and_clear();
    }
}

/// Time between two lines of progress.
const PAUSE: Duration = Duration::from_secs(60);

/// Progress that is printed as lines of text.
struct Log {
    last: Instant,
    /// Time and number of finished points or curves at the first call of [`Log::line`]. The points of an
    /// earlier, interrupted run do not count for the rate of this run.
    begin: Option<(Instant, u64)>,
}

impl Log {
    fn new(now: Instant) -> Log {
        Log { last: now, begin: None }
    }

    /// Returns a line of progress, if the last line was printed a minute ago or earlier and the run is not
    /// finished.
    fn line(&mut self, progress: Progress, units: &str, now: Instant) -> Option<String> {
        let Progress { finished, points } = progress;
        let (begun, before) = *self.begin.get_or_insert((now, finished));
        if now - self.last < PAUSE || finished >= points {
            return None;
        }
        self.last = now;
        let seconds = (now - begun).as_secs_f64().max(1e-9);
        let rate = (finished - before) as f64 / seconds;
        let left = if rate > 0.0 {
            duration::words((points - finished) as f64 / rate)
        } else {
            "unknown time".to_owned()
        };
        Some(format!("{finished} of {points} {units}, {rate:.1} {units}/s, {left} left"))
    }
}

fn write_rate(state: &ProgressState, text: &mut dyn Write) {
    // Writing to memory does not fail.
    let _ = write!(text, "{:.0}", state.per_sec());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_a_minute() {
        let begun = Instant::now();
        let mut log = Log::new(begun);
        let mut line = |seconds: u64, finished: u64| {
            let progress = Progress { finished, points: 100_000 };
            log.line(progress, "points", begun + Duration::from_secs(seconds))
        };
        // 10,000 points of an earlier session.
        assert_eq!(line(0, 10_000), None);
        assert_eq!(line(59, 20_000), None);
        assert_eq!(line(60, 22_600).unwrap(), "22600 of 100000 points, 210.0 points/s, 6 minutes left");
        assert_eq!(line(119, 30_000), None);
        assert_eq!(line(121, 34_200).unwrap(), "34200 of 100000 points, 200.0 points/s, 5 minutes left");
        assert_eq!(line(190, 100_000), None, "the report follows");
    }

    #[test]
    fn a_run_that_does_not_move_has_no_end() {
        let begun = Instant::now();
        let mut log = Log::new(begun);
        let progress = Progress { finished: 3, points: 9 };
        assert_eq!(log.line(progress, "curves", begun), None);
        let line = log.line(progress, "curves", begun + PAUSE).unwrap();
        assert_eq!(line, "3 of 9 curves, 0.0 curves/s, unknown time left");
    }
}
