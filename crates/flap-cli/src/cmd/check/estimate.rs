//! The estimated time of a sweep, from a run of a few of its points.

use std::time::{Duration, Instant};

use flap_core::num::InstructionSet;
use flap_core::simulate::{Jobs, Point, Row, Status};
use flap_sweep::notation::text::count;
use flap_sweep::plan::{Plan, Verdict};
use flap_sweep::run::RunOptions;
use flap_sweep::study::survey::spread;

/// Most points that are run.
const MOST: u64 = 32;

/// The time after which no point is started.
const LONGEST_BEGIN: Duration = Duration::from_secs(1);

/// The time after which running points are given up.
const LONGEST: Duration = Duration::from_secs(2);

/// Most points that are checked to find some that are not excluded.
const MOST_LOOKED_AT: u64 = 100_000;

/// The estimates of a sweep from a few of its points.
#[derive(Default)]
pub(super) struct Estimate {
    /// A message if every checked point is invalid, with the reason of the first one.
    pub(super) invalid: Option<String>,
    /// One line with the estimated time. `None` if no point was run.
    pub(super) time: Option<String>,
}

/// Runs a few points of `plan` to estimate a sweep of `points` points.
pub(super) fn of(plan: &Plan, points: u64) -> Estimate {
    let started = Instant::now();
    let mut trial = Trial { plan, started, looked_at: 0, begun: 0, valid: 0, first_reason: None };
    plan.rows().run(InstructionSet::best(), plan.solver(), &mut trial);
    let elapsed = started.elapsed();
    let is_over = elapsed < LONGEST;
    let ran = trial.begun;
    if let Trial { valid: 0, first_reason: Some((index, reason)), .. } = trial
        && is_over
    {
        let text = format!("all points that were tried are invalid, such as point {index}: {reason}");
        return Estimate { invalid: Some(text), time: None };
    }
    if ran == 0 {
        return Estimate::default();
    }
    let threads = RunOptions::default().threads.get();
    let seconds = elapsed.as_secs_f64() / ran as f64 * points as f64 / (threads as f64).min(points as f64);
    let bound = if is_over { "" } else { "more than " };
    let time = words(seconds);
    let time = format!(
        "estimate: {bound}{time} on {}, from runs of {} spread over the grid",
        count(threads as u64, "thread"),
        count(ran, "point")
    );
    Estimate { invalid: None, time: Some(time) }
}

/// Points spread over a plan, until there are enough or the time is over.
struct Trial<'a> {
    plan: &'a Plan,
    started: Instant,
    looked_at: u64,
    /// Number of points that were begun.
    begun: u64,
    /// Number of valid points.
    valid: u64,
    /// Index and reason of the first invalid point.
    first_reason: Option<(u64, String)>,
}

impl Trial<'_> {
    /// Notes an invalid point, the checked point number `number`.
    fn note_invalid(&mut self, number: u64, reason: String) {
        let index = spread(number, self.plan.len());
        self.first_reason.get_or_insert((index, reason));
    }
}

impl Jobs for Trial<'_> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        while self.begun < MOST.min(self.plan.len())
            && self.looked_at < MOST_LOOKED_AT
            && self.started.elapsed() < LONGEST_BEGIN
        {
            let mut point = self.plan.point(spread(self.looked_at, self.plan.len()));
            // A small grid may give a point twice: each run has its own number.
            point.index = self.looked_at;
            self.looked_at += 1;
            match self.plan.judge(&point.values) {
                Verdict::Runs => {
                    self.begun += 1;
                    return Some(point);
                }
                Verdict::Invalid(invalid) => self.note_invalid(point.index, invalid.into_reason()),
                Verdict::Excluded(_) => {}
            }
        }
        None
    }

    fn done(&mut self, index: u64, row: Row) {
        if row.status == Status::Invalid {
            self.note_invalid(index, row.reason.unwrap_or_default());
        } else {
            self.valid += 1;
        }
    }

    fn interrupted(&self) -> bool {
        self.started.elapsed() >= LONGEST
    }
}

/// A time in words.
fn words(seconds: f64) -> String {
    const UNITS: [(f64, &str); 5] =
        [(31_557_600.0, "years"), (86_400.0, "days"), (3600.0, "hours"), (60.0, "minutes"), (1.0, "seconds")];
    let unit = UNITS.iter().find(|(length, _)| seconds >= 2.0 * length);
    match unit {
        Some((length, name)) => format!("about {:.0} {name}", seconds / length),
        None => "a second or two".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::words;

    #[test]
    fn times_in_words() {
        let cases = [
            (0.01, "a second or two"),
            (2.4, "about 2 seconds"),
            (119.0, "about 119 seconds"),
            (120.0, "about 2 minutes"),
            (7.4e3, "about 2 hours"),
            (1e5, "about 28 hours"),
            (2e5, "about 2 days"),
            (1e9, "about 32 years"),
        ];
        for (seconds, expected) in cases {
            assert_eq!(words(seconds), expected, "{seconds}");
        }
    }
}
