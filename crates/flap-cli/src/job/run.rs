//! Computes the points of a plan and writes their rows to a file or to stdout. The commands `sweep`, `resume`
//! and `rerun` share this code.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use flap_sweep::files::csv_sink::CsvSink;
use flap_sweep::files::job::{self, Begun, Done, Job, OnExisting};
use flap_sweep::files::session::SessionOptions;
use flap_sweep::files::sidecar::Origin;
use flap_sweep::plan::Plan;
use flap_sweep::run::{Outcome, Progress, RowWriter, Run, RunError, RunOptions, Sink, Summary};
use flap_sweep::study::response::{Curve, Responses};
use flap_sweep::table::layout::Layout;

use super::make::warn_unlocked;
use super::report::{report, report_curves};
use super::verdicts::{Lines, Verdicts};
use crate::args::{OutputFormat, WorkArgs};
use crate::console;
use crate::failure::{Exit, Failure, still_kept};
use crate::print;
use crate::progress::Bar;
use crate::system;

/// Runs `plan`, writes its rows to `out`, and prints a report. In a rerun, `origin` names the earlier results
/// from which the points were chosen.
pub(crate) fn run(
    plan: &Plan,
    out: PathBuf,
    on_existing: OnExisting,
    work: &WorkArgs,
    origin: Option<Origin>,
) -> Result<Exit, Failure> {
    run_and_summarize(plan, out, on_existing, work, origin, OutputFormat::Table)
}

/// Runs `plan` as [`run`] does, and prints summaries of the response curves in `format`.
pub(crate) fn run_and_summarize(
    plan: &Plan,
    out: PathBuf,
    on_existing: OnExisting,
    work: &WorkArgs,
    origin: Option<Origin>,
    format: OutputFormat,
) -> Result<Exit, Failure> {
    let options = RunOptions::with_threads(work.threads);
    if console::is_stdout(&out) {
        let begun = Instant::now();
        let mut sink = CsvSink::new(Layout::of(plan).names(), io::stdout());
        let mut verdicts = Verdicts::of(plan, OutputFormat::Table, Lines::Stderr);
        let summary = run_with_progress(plan, &options, Summary::default(), &mut sink, verdicts.as_mut())?;
        let done = Done { summary, rows_before: 0, seconds: begun.elapsed().as_secs_f64(), place: None };
        return Ok(ended(plan, &done, Path::new("stdout"), work));
    }
    let options = SessionOptions { run: options, checkpoint_interval: work.checkpoint };
    let job = Job { plan, out, on_existing, options, origin };
    let place = job.out.display();
    let failed = |error| Failure::of_job(error, &job.out);
    let mut writing = match job::begin(&job).map_err(failed)? {
        Begun::Writing(writing) => writing,
        Begun::Complete { all_periodic } => {
            console::say(&format!(
                "{place} is complete: nothing is left to run; use --restart to run its points again"
            ));
            return Ok(exit_code_of(all_periodic, work));
        }
    };
    if let Some(error) = writing.unlocked() {
        warn_unlocked(&job.out, error);
    }
    let before = writing.before.clone();
    if let Some(lost) = writing.lost {
        if lost > 0 {
            let are = if lost == 1 { "row is" } else { "rows are" };
            console::say(&format!("{lost} {are} missing from {place} and will be computed again"));
        }
        let points = before.points.max(plan.selected());
        console::say(&format!("{} of {points} points of {place} are done", before.done()));
    }
    let mut verdicts = Verdicts::of(plan, format, Lines::StdoutBesideFile);
    let ran = run_with_progress(plan, &job.options.run, before, writing.sink(), verdicts.as_mut());
    let done = writing.finish(ran).map_err(failed)?;
    if let Some(verdicts) = verdicts.filter(|_| format != OutputFormat::Table) {
        print::table(format, &verdicts.names(), &verdicts.rows, String::new)?;
    }
    Ok(ended(plan, &done, &job.out, work))
}

/// Prints the report of a finished or interrupted job, and returns the exit code. `out` is the file or the
/// stream that contains the rows.
fn ended(plan: &Plan, done: &Done, out: &Path, work: &WorkArgs) -> Exit {
    if plan.followed().is_some() {
        report_curves(done, out);
    } else {
        report(plan, done, out);
    }
    if done.summary.is_interrupted() {
        // A stream has no journal.
        if done.place.is_some() {
            console::say(&format!("`flap results resume {}` continues the run", out.display()));
            if let Some(kept) = still_kept(out) {
                console::say(&kept);
            }
        }
        return Exit::Interrupted;
    }
    exit_code(&done.summary, work)
}

/// Returns the exit code of a run that was not interrupted.
pub(crate) fn exit_code(summary: &Summary, work: &WorkArgs) -> Exit {
    exit_code_of(summary.all_periodic(), work)
}

fn exit_code_of(all_periodic: bool, work: &WorkArgs) -> Exit {
    if work.strict && !all_periodic { Exit::NotAll } else { Exit::Done }
}

/// Runs the plan with a progress bar, until a signal stops it.
///
/// In `flap respond`, `verdicts` collects or prints a summary of each response curve.
pub(crate) fn run_with_progress(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
    verdicts: Option<&mut Verdicts<'_>>,
) -> Result<Summary, RunError> {
    let stop = system::stop();
    let mut output = RowWriter::begin(plan, before, sink)?;
    let (ended, bar) = match Responses::of(plan) {
        None => {
            let mut bar = Bar::new("points");
            let ran = output.run_points(options, |progress| show_and_check(&mut bar, progress, &stop));
            (ran, bar)
        }
        Some(responses) => {
            let mut bar = Bar::new("curves");
            let run = responses.curves(options, output.done());
            (write_curves(run, &mut output, &mut bar, &stop, verdicts), bar)
        }
    };
    let summary = output.finish(ended);
    bar.clear();
    summary
}

fn write_curves(
    mut run: Run<Outcome<Curve>>,
    output: &mut RowWriter<'_>,
    bar: &mut Bar,
    stop: &AtomicBool,
    mut verdicts: Option<&mut Verdicts<'_>>,
) -> Result<(), RunError> {
    loop {
        if show_and_check(bar, run.progress(), stop) {
            run.stop();
        }
        let Some(curves) = run.next_batch()? else { return Ok(()) };
        for curve in &curves {
            if let (Outcome::Ran(curve), Some(verdicts)) = (curve, &mut verdicts) {
                bar.aside(|| verdicts.add(curve))?;
            }
            output.write_curve(curve)?;
        }
        output.flush()?;
    }
}

/// Moves the progress bar. Returns true after a signal, so that the caller stops the run.
fn show_and_check(bar: &mut Bar, progress: Progress, stop: &AtomicBool) -> bool {
    let is_stopped = stop.load(Ordering::Relaxed);
    bar.show(progress, is_stopped);
    is_stopped
}
