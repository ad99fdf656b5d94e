//! Estimates of the time of a sweep and of the size of its rows.

use std::num::NonZeroUsize;

use flap_sweep::notation::text::count;
use flap_sweep::plan::Plan;
use flap_sweep::plan::selection::Shard;
use flap_sweep::run::RunOptions;

use super::trial::Trial;
use crate::duration;

/// Estimates of the time and the file size of a sweep. flap computes a few points of the sweep to find these
/// estimates.
#[derive(Default)]
pub(super) struct Estimate {
    /// If every checked point is invalid, a message with the reason why the first point is invalid.
    pub(super) invalid: Option<String>,
    /// Lower and upper bound of the likely duration of the sweep (s). `None` if no point was run.
    pub(super) seconds: Option<[f64; 2]>,
    /// Size of the rows as CSV (bytes). `None` if no point was run.
    pub(super) bytes: Option<f64>,
    /// True if flap finished all points of the sample. If some points of the sample are not finished, flap
    /// prints only the lower bound of the time.
    is_complete: bool,
    /// Number of threads.
    pub(super) threads: usize,
    /// Number of points that flap computed, or found invalid, for the estimates.
    pub(super) tried: usize,
    /// The limit `max_points` of a refined grid.
    most_points: Option<u64>,
}

impl Estimate {
    /// Returns the estimates as one line of text.
    pub(super) fn line(&self) -> Option<String> {
        let [low, high] = self.seconds?;
        let time = if self.is_complete {
            duration::between(low, high)
        } else {
            format!("more than {}", duration::words(low))
        };
        let threads = count(self.threads as u64, "thread");
        let points = count(self.tried as u64, "point");
        let size = self.bytes.map_or_else(String::new, |bytes| format!(" and {} of CSV", size(bytes)));
        let most = self.most_points.map_or(String::new(), |most| format!(" for {}", count(most, "point")));
        Some(format!("estimate: {time}{most} on {threads}{size}, from runs of {points} spread over the grid"))
    }
}

/// Returns a number of bytes with two digits and a decimal prefix.
fn size(bytes: f64) -> String {
    let units = [(1e12, "TB"), (1e9, "GB"), (1e6, "MB"), (1e3, "kB")];
    let (length, name) = units.into_iter().find(|(length, _)| bytes >= *length).unwrap_or((1.0, "B"));
    let number = bytes / length;
    if number < 9.95 && length > 1.0 { format!("{number:.1} {name}") } else { format!("{number:.0} {name}") }
}

/// Estimates the time of a sweep of `points` points on `threads` threads, or on one thread per core. The
/// function computes some points of `plan` for the estimate.
///
/// The estimate for a whole sweep includes all points that the refinement of the grid may add. A refinement
/// adds no points to a shard.
pub(super) fn of(plan: &Plan, points: u64, shard: Option<Shard>, threads: Option<NonZeroUsize>) -> Estimate {
    let most_points = plan.refine().map(|refine| refine.max_points).filter(|_| shard.is_none());
    let points = match shard {
        Some(shard) => points.div_ceil(shard.of()),
        None => points + plan.most_points() - plan.len(),
    };
    let cores = RunOptions::default().threads;
    let threads = threads.unwrap_or(cores).get();
    let trial = Trial::run(plan, cores.get());
    if let Some((index, reason)) = trial.invalid() {
        let text = format!("every point that was tried is invalid, for example point {index}: {reason}");
        return Estimate { invalid: Some(text), ..Estimate::default() };
    }
    let share = cores.get() as f64 / threads as f64;
    Estimate {
        invalid: None,
        seconds: trial.seconds(points).map(|bounds| bounds.map(|seconds| seconds * share)),
        bytes: trial.bytes_of_row().map(|bytes| bytes * points as f64),
        is_complete: trial.is_complete(),
        threads,
        tried: trial.tried(),
        most_points,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_two_digits_or_more() {
        let cases =
            [(87.0, "87 B"), (1024.0, "1.0 kB"), (9.96e6, "10 MB"), (1.52e9, "1.5 GB"), (2.1e14, "210 TB")];
        for (bytes, text) in cases {
            assert_eq!(size(bytes), text);
        }
    }
}
