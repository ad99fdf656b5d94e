//! The rows of a plan to a file or to stdout: what `sweep`, `resume` and `rerun` share.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::sync::Arc;
use std::sync::atomic::Ordering;

use flap_core::simulate::Status;
use flap_sweep::files::integrity::{self, Note, OnDamage, Opened};
pub(crate) use flap_sweep::files::job::Begin;
use flap_sweep::files::job::{self, Before, Done, Job, Outcome};
use flap_sweep::files::output;
use flap_sweep::files::results::{Format, Reader};
use flap_sweep::files::session::{self, SessionOptions};
use flap_sweep::files::sidecar::{self, Origin, ReadError, Sidecar};
use flap_sweep::plan::Plan;
use flap_sweep::run::sink::Sink;
use flap_sweep::run::{self, Doubts, RunError, RunOptions, Summary};

use crate::args::{ReadArgs, WorkArgs};
use crate::cmd::exclusion;
use crate::console;
use crate::failure::{Exit, Failure, IGNORE_HELP, still_kept};
use crate::models;
use crate::progress::Bar;
use crate::signals;

/// Runs `plan`, writes its rows to `out`, and tells what it came to. `origin` says where the points of a rerun come from.
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
        let done = job::to_stream(plan, io::stdout(), &options, &mut run_with_progress)?;
        return Ok(ended(&done, None, work));
    }
    let options = SessionOptions { run: options, checkpoint: work.checkpoint };
    let job = Job { plan, out, begin, options, origin };
    let (place, points) = (job.out.display(), job.plan.selected());
    let outcome = job::run(&job, &mut run_with_progress, &mut |Before { lost, done }| {
        if lost > 0 {
            console::say(&format!("{lost} rows are no longer in {place}: they are computed again"));
        }
        console::say(&format!("{done} of {points} points of {place} are done"));
    });
    match outcome.map_err(|error| Failure::of_job(error, &job.out))? {
        Outcome::Ran(done) => Ok(ended(&done, Some(&job.out), work)),
        Outcome::Complete { all_periodic } => {
            console::say(&format!("{place} is complete: nothing is left to run"));
            Ok(complete(all_periodic, work))
        }
    }
}

fn ended(done: &Done, resumable: Option<&Path>, work: &WorkArgs) -> Exit {
    report(done);
    if done.summary.interrupted {
        if let Some(out) = resumable {
            console::say(&format!("`flap resume {}` goes on", out.display()));
            if let Some(kept) = job::kept(out) {
                console::say(&still_kept(&kept));
            }
        }
        return Exit::Interrupted;
    }
    complete(done.summary.counts.of(Status::Periodic) == done.summary.rows, work)
}

fn complete(all_periodic: bool, work: &WorkArgs) -> Exit {
    if work.strict && !all_periodic { Exit::NotAll } else { Exit::Done }
}

/// Runs the plan with a progress bar, until a signal asks it to end.
fn run_with_progress(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
) -> Result<Summary, RunError> {
    let stop = signals::stop();
    // Caught, the signal that a file would grow too large becomes an error of writing, which can be told.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
    let mut bar = Bar::new();
    let outcome = run::resume(plan, options, before, sink, &stop, &mut |progress| {
        bar.show(progress, stop.load(Ordering::Relaxed));
    });
    bar.clear();
    outcome
}

/// Tells what the sweep came to.
fn report(done: &Done) {
    let Done { summary, rows_before, seconds, place } = done;
    for (point, reason) in &summary.invalid {
        console::say(&format!("point {point} is invalid: {reason}"));
    }
    let counts = summary.counts.iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(status, count)| format!("{count} {}", status.name())).collect();
    let counts = if counts.is_empty() { "no points".to_owned() } else { counts.join(", ") };
    let rate = (summary.rows - rows_before) as f64 / seconds.max(1e-9);
    console::say(&format!("{counts} in {seconds:.2} s ({rate:.0} points/s)"));

    if summary.excluded > 0 {
        console::say(&exclusion::text(summary.excluded, &summary.unsatisfied));
    }
    report_doubts(done);
    let unsettled = summary.counts.of(Status::Unsettled);
    if unsettled > 0 {
        console::say(&format!(
            "{unsettled} did not settle: where `residual` is still falling, raise max_cycles in [solver]; \
             where it is not, lower rtol or raise settle_tol"
        ));
    }

    let place = place.as_deref().map_or("stdout".into(), Path::to_string_lossy);
    if summary.interrupted {
        let (done, points) = (summary.done(), summary.points);
        console::say(&format!("interrupted: the rows of the first {done} of {points} points are in {place}"));
    } else {
        console::say(&format!("{} rows in {place}", summary.rows));
    }
}

/// Tells how many rows are to be read with care, and what helps.
fn report_doubts(done: &Done) {
    let Doubts { inaccurate, powerless, at_range_end } = done.summary.doubts;
    if inaccurate > 0 {
        let help = match &done.place {
            Some(place) => {
                format!(
                    "`flap rerun {} --inaccurate --rtol 1e-10 --out again.csv` runs them again",
                    place.display()
                )
            }
            None => "lower rtol in [solver]".to_owned(),
        };
        console::say(&format!(
            "{inaccurate} rows miss the accuracy of [solver], see their error_estimate: {help}"
        ));
    }
    if powerless > 0 {
        console::say(&format!(
            "{powerless} rows have negative mean power: the model's air gives energy to the wing there (docs/model.md)"
        ));
    }
    if at_range_end > 0 {
        console::say(&format!(
            "{at_range_end} resonances are at an end of their range (resonance_margin_hz is 0): they are no peaks, \
             widen the range with from and to in [resonance]"
        ));
    }
}

/// What to know if there is no sidecar.
pub(crate) const SIDECAR_HELP: &str = "the sidecar lies beside the results and tells what grid they are of";

/// The plan of results, from the sidecar beside them.
pub(crate) fn recorded(results: &Path, on_damage: OnDamage) -> Result<(Plan, Sidecar), Failure> {
    let sidecar = read_sidecar(results, on_damage)?;
    Ok((plan_of(&sidecar::path_of(results), &sidecar)?, sidecar))
}

/// The sidecar of results.
pub(crate) fn read_sidecar(results: &Path, on_damage: OnDamage) -> Result<Sidecar, Failure> {
    let path = sidecar::path_of(results);
    let sidecar = match Sidecar::read(&path) {
        Err(ReadError::Damaged { .. }) if on_damage == OnDamage::Tolerate => Sidecar::read_damaged(&path),
        read => read,
    };
    sidecar.map_err(|error| {
        let help = if matches!(error, ReadError::Damaged { .. }) { IGNORE_HELP } else { SIDECAR_HELP };
        Failure::from(error).help(help)
    })
}

/// The plan in a sidecar, which was read from `path`.
pub(crate) fn plan_of(path: &Path, sidecar: &Sidecar) -> Result<Plan, Failure> {
    sidecar.plan(models::all()).map_err(|error| match error {
        sidecar::PlanError::Grid(mistakes) => Failure::Grid(mistakes),
        sidecar::PlanError::GridText => {
            let message =
                format!("{}: the grid in it is not the one that was run: it was edited", path.display());
            Failure::usage(message)
                .help("sweep an edited grid from a file of its own: flap sweep --grid FILE")
        }
        sidecar::PlanError::Points => {
            Failure::usage(format!("{}: its points are not points of its grid", path.display()))
        }
        sidecar::PlanError::PointsFile => {
            let points = sidecar.points_file.as_ref().map_or("its file of points", |file| file.path.as_str());
            let message = format!("{}: {points} no longer holds the points that were run", path.display());
            Failure::usage(message).help("put the file of points back as it was, or sweep its grid file anew")
        }
        sidecar::PlanError::Solver => {
            let message =
                format!("{}: its solver settings are not ones that a grid may have", path.display());
            Failure::usage(message)
        }
    })
}

/// Stdout as a file.
pub(crate) fn stdout() -> io::Result<File> {
    #[cfg(unix)]
    let owned = std::os::fd::AsFd::as_fd(&io::stdout()).try_clone_to_owned();
    #[cfg(windows)]
    let owned = std::os::windows::io::AsHandle::as_handle(&io::stdout()).try_clone_to_owned();
    owned.map(File::from)
}

/// Opens results to be read, and tells what a user should know of them.
pub(crate) fn open(results: &Path, read: &ReadArgs) -> Result<Opened, Failure> {
    let opened = integrity::open(results, read.on_damage())?;
    for note in &opened.notes {
        tell(note);
    }
    Ok(opened)
}

/// Tells what a user should know of results.
pub(crate) fn tell(note: &Note) {
    console::warn(&note.to_string());
}

/// Opens results that have a sidecar, which tells of what plan they are.
pub(crate) fn open_recorded(results: &Path, read: &ReadArgs) -> Result<(Opened, Plan, Sidecar), Failure> {
    Format::of(results)?;
    let (plan, sidecar) = recorded(results, read.on_damage())?;
    Ok((open(results, read)?, plan, sidecar))
}

/// Tells how much of damaged results has been left out.
pub(crate) fn tell_missed(results: &Path, reader: &Reader) {
    if let Some(missed) = reader.missed() {
        console::warn(&format!("{}: {missed}", results.display()));
    }
}

/// Makes a file that was computed before, or from other files: all of it, or nothing. An earlier file stays until then.
pub(crate) fn make<E: From<io::Error>>(
    results: &Path,
    overwrite: bool,
    write: impl FnOnce(File) -> Result<(), E>,
) -> Result<Result<(), E>, Failure> {
    // Holds the name while the rows are written beside it.
    let locked = output::create(results, overwrite)?;
    // A device or a pipe takes what it is given.
    if !locked.metadata().is_ok_and(|metadata| metadata.is_file()) {
        return Ok(write(locked));
    }
    let written = output::replace(results, write);
    if written.is_ok() {
        session::forget(results).map_err(|error| Failure::cannot_write(results, &error))?;
    } else if job::is_empty(results) {
        let _ = std::fs::remove_file(results);
    }
    drop(locked);
    Ok(written)
}
