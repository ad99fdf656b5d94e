//! Code that the search for one design and the search for a Pareto front share.

use std::cell::RefCell;
use std::num::NonZeroUsize;
use std::sync::atomic::Ordering;

use flap_sweep::plan::Plan;
use flap_sweep::run::{Progress, RunOptions};
use flap_sweep::study::optimum::{Optimum, ProblemError, ProblemPart, Settings};

use crate::args::OptimiseArgs;
use crate::failure::Failure;
use crate::progress::Bar;
use crate::system;

/// Returns the failure for a mistake in the plan, in a goal or in a condition. If `is_smallest` is true, the
/// goal is the value of `--minimise`, otherwise the value of `--maximise`.
pub(super) fn refused(args: &OptimiseArgs, is_smallest: bool, error: &ProblemError) -> Failure {
    let goal = |goal: &Option<String>| goal.clone().unwrap_or_default();
    let place = match error.part {
        ProblemPart::Plan => args.grid.display().to_string(),
        ProblemPart::Goal if is_smallest => format!("--minimise {}", goal(&args.minimise)),
        ProblemPart::Goal => format!("--maximise {}", goal(&args.maximise)),
        ProblemPart::Condition(number) => {
            format!("--where {}", args.conditions.get(number).map_or("", String::as_str))
        }
    };
    Failure::usage(format!("{place}: {error}")).helps(&error.help)
}

/// Returns the search settings from the command line.
pub(super) fn settings(args: &OptimiseArgs) -> Settings {
    Settings {
        run: RunOptions::with_threads(args.threads),
        starts: NonZeroUsize::new(args.starts).unwrap_or(NonZeroUsize::MIN),
        points: args.sample,
    }
}

/// Runs `work` with a progress bar that counts `units`, and returns the result of `work`. A signal such as
/// Ctrl-C stops `work`. `work` returns `None` if a signal stopped it, or if no computed point has a periodic
/// motion.
pub(super) fn watched<T, E>(
    args: &OptimiseArgs,
    units: &'static str,
    work: impl FnOnce(&dyn Fn(u64, u64) -> bool) -> Result<Option<T>, E>,
) -> Result<T, Failure>
where
    Failure: From<E>,
{
    let stop = system::stop();
    let bar = RefCell::new(Bar::new(units));
    let found = work(&|finished, points| {
        let is_stopped = stop.load(Ordering::Relaxed);
        bar.borrow_mut().show(Progress { finished, points }, is_stopped);
        is_stopped
    });
    bar.borrow().clear();
    if let Some(found) = found? {
        return Ok(found);
    }
    if stop.load(Ordering::Relaxed) {
        return Err(Failure::Interrupted);
    }
    let grid = args.grid.display();
    let failure = Failure::usage(format!(
        "no point of {grid} that was computed has a periodic motion with a finite goal and finite conditions"
    ));
    Err(failure.help(format!(
        "`flap sweep {grid}` shows the status of each point; if points are periodic, correct the goal or --where"
    )))
}

/// Returns the measures of the best design, each with name, value and unit.
pub(super) fn measures<'p>(plan: &'p Plan, best: &Optimum) -> Vec<(&'p str, f64, &'p str)> {
    let columns = plan.rows().columns().iter().map(|column| (column.name.as_str(), column.unit));
    let own = plan.measures().iter().map(|own| (own.name.as_str(), ""));
    columns.chain(own).zip(&best.row.measures).map(|((name, unit), value)| (name, *value, unit)).collect()
}
