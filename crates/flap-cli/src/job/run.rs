//! The rows of a plan into a file or to stdout: the work that `sweep`, `resume` and `rerun` share.

use std::cell::RefCell;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use flap_core::simulate::Status;
use flap_sweep::files::job::{self, Begin, Done, Job, Notice, Outcome};
use flap_sweep::files::session::SessionOptions;
use flap_sweep::files::sidecar::Origin;
use flap_sweep::plan::Plan;
use flap_sweep::run::sink::Sink;
use flap_sweep::run::{self, RunError, RunOptions, Summary};
use flap_sweep::study::response::{Curve, Responses};

use super::make::warn_unlocked;
use super::report::{report, report_curves};
use super::verdicts::Verdicts;
use crate::args::WorkArgs;
use crate::console;
use crate::failure::{Exit, Failure, still_kept};
use crate::progress::Bar;
use crate::signals;

/// Runs `plan`, writes its rows to `out`, and reports. `origin` names the earlier results that the points of a rerun are taken
/// from.
pub(crate) fn run(
    plan: &Plan,
    out: PathBuf,
    begin: Begin,
    work: &WorkArgs,
    origin: Option<Origin>,
) -> Result<Exit, Failure> {
    let mut options = RunOptions::default();
    if let Some(threads) = work.threads {
        options.threads = threads;
    }
    if out.as_os_str() == "-" {
        let mut engine = |plan: &Plan, options: &RunOptions, before: Summary, sink: &mut dyn Sink| {
            self::work(plan, options, before, sink, Lines::Stderr)
        };
        let done = job::to_stream(plan, io::stdout(), &options, &mut engine)?;
        return Ok(ended(plan, &done, None, work));
    }
    let options = SessionOptions { run: options, checkpoint: work.checkpoint };
    let job = Job { plan, out, begin, options, origin };
    let (place, points) = (job.out.display(), job.plan.selected());
    let mut engine = |plan: &Plan, options: &RunOptions, before: Summary, sink: &mut dyn Sink| {
        self::work(plan, options, before, sink, Lines::Stdout)
    };
    let outcome = job::run(&job, &mut engine, &mut |notice| match notice {
        Notice::Continued { lost, done } => {
            if lost > 0 {
                let again = if lost == 1 { "row is missing from" } else { "rows are missing from" };
                console::say(&format!("{lost} {again} {place}, and computed again"));
            }
            console::say(&format!("{done} of {points} points of {place} are done"));
        }
        Notice::Unlocked(error) => warn_unlocked(&job.out, &error),
    });
    match outcome.map_err(|error| Failure::of_job(error, &job.out))? {
        Outcome::Ran(done) => Ok(ended(plan, &done, Some(&job.out), work)),
        Outcome::Complete { all_periodic } => {
            let command = if plan.followed().is_some() { "respond" } else { "sweep" };
            console::say(&format!(
                "{place} is complete: nothing is left to run; `flap {command} --restart` runs its points again"
            ));
            Ok(exit(all_periodic, work))
        }
    }
}

/// Reports a job that ran, and gives the exit code.
fn ended(plan: &Plan, done: &Done, resumable: Option<&Path>, work: &WorkArgs) -> Exit {
    if plan.followed().is_some() {
        report_curves(done);
    } else {
        report(plan, done);
    }
    if done.summary.interrupted {
        if let Some(out) = resumable {
            console::say(&format!("`flap results resume {}` continues the run", out.display()));
            if let Some(kept) = still_kept(out) {
                console::say(&kept);
            }
        }
        return Exit::Interrupted;
    }
    complete(&done.summary, work)
}

/// The exit code of a run to the end.
pub(crate) fn complete(summary: &Summary, work: &WorkArgs) -> Exit {
    exit(summary.counts.of(Status::Periodic) == summary.rows, work)
}

fn exit(all_periodic: bool, work: &WorkArgs) -> Exit {
    if work.strict && !all_periodic { Exit::NotAll } else { Exit::Done }
}

/// The stream for the lines of curves.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lines {
    /// They are results.
    Stdout,
    /// Rows are on stdout.
    Stderr,
}

/// Runs the plan with a progress bar, until a signal asks it to end. Where a parameter is followed, a line for each curve goes
/// to `lines`.
pub(crate) fn work(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
    lines: Lines,
) -> Result<Summary, RunError> {
    let stop = signals::stop();
    let responses = Responses::of(plan);
    let bar = RefCell::new(Bar::new(if responses.is_some() { "curves" } else { "points" }));
    let mut progress = |progress| bar.borrow_mut().show(progress, stop.load(Ordering::Relaxed));
    let outcome = match responses {
        None => run::resume(plan, options, before, sink, &stop, &mut progress),
        Some(responses) => {
            let verdicts = Verdicts::of(plan);
            let mut tell = |curve: &Curve| {
                let line = verdicts.as_ref().map(|verdicts| verdicts.line(curve) + "\n").unwrap_or_default();
                bar.borrow().aside(|| match lines {
                    Lines::Stdout => console::results(&line),
                    Lines::Stderr => {
                        console::say(line.trim_end());
                        Ok(())
                    }
                })
            };
            responses.run(options, before, sink, &stop, &mut progress, &mut tell)
        }
    };
    bar.borrow().clear();
    outcome
}
