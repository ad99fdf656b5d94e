//! The rows of a plan to a file or to stdout: what `sweep`, `resume` and `rerun` share.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use flap_core::simulate::Status;
use flap_sweep::csv_sink::CsvSink;
use flap_sweep::identity::Identity;
use flap_sweep::layout::Layout;
use flap_sweep::output;
use flap_sweep::plan::Plan;
use flap_sweep::results::Format;
use flap_sweep::run::{self, RunError, RunOptions, Summary};
use flap_sweep::session::{self, ResumeError, Resumed, Session, SessionOptions};
use flap_sweep::sidecar::{self, End, Origin, Sidecar, Start, State};
use flap_sweep::sink::Sink;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::args::WorkArgs;
use crate::cmd::exclusion;
use crate::failure::{Exit, Failure};
use crate::progress::Bar;
use crate::{console, time};

/// What is to be run, and where its rows go.
pub(crate) struct Job<'a> {
    pub(crate) plan: Plan,
    pub(crate) out: PathBuf,
    pub(crate) begin: Begin,
    pub(crate) work: &'a WorkArgs,
    /// Where the points of a rerun come from.
    pub(crate) origin: Option<Origin>,
}

/// What becomes of results that are there already.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Begin {
    /// They are an error.
    New,
    /// They are dropped.
    Overwrite,
    /// They are gone on with.
    Resume,
}

/// What this process did.
struct Done {
    /// Of the rows of earlier sessions too.
    summary: Summary,
    rows_before: u64,
    seconds: f64,
    place: PathBuf,
}

/// Runs the job and tells what it came to.
pub(crate) fn run(job: &Job<'_>) -> Result<Exit, Failure> {
    let mut options = RunOptions::default();
    if let Some(threads) = job.work.threads {
        options.threads = threads;
    }
    if job.out.as_os_str() == "-" {
        return Ok(job.ended(&job.to_stream(io::stdout(), &options, PathBuf::from("stdout"))?));
    }
    let options = SessionOptions { run: options, checkpoint: job.work.checkpoint };
    match job.begin {
        Begin::Resume => job.resume(&options),
        Begin::New | Begin::Overwrite => Ok(job.ended(&job.start(&options)?)),
    }
}

impl Job<'_> {
    /// Tells what the run came to, and how the program ends.
    fn ended(&self, done: &Done) -> Exit {
        report(done);
        if done.summary.interrupted {
            if self.out.as_os_str() != "-" {
                console::say(&format!("`flap resume {}` goes on", self.out.display()));
            }
            return Exit::Interrupted;
        }
        self.complete(done.summary.counts.of(Status::Periodic) == done.summary.rows)
    }

    fn complete(&self, all_periodic: bool) -> Exit {
        if self.work.strict && !all_periodic { Exit::NotAllPeriodic } else { Exit::Done }
    }

    fn start(&self, options: &SessionOptions) -> Result<Done, Failure> {
        let format = Format::of(&self.out)?;
        let file = output::create(&self.out, self.begin == Begin::Overwrite)?;
        // Devices and pipes have nothing beside them, and nothing to resume.
        if !file.metadata().is_ok_and(|metadata| metadata.is_file()) {
            return self.to_stream(file, &options.run, self.out.clone());
        }
        let started = time::now();
        let sidecar = self.sidecar(started.clone(), options);
        write_sidecar(&sidecar, &self.out)?;
        // Earlier rows go only now that nothing stands in the way of new ones.
        let session = Session::start(file, (&self.out, format), &self.plan, options, started);
        let session = session.map_err(|error| Failure::cannot_write(&self.out, &error))?;
        self.work(session, Summary::default(), sidecar, options)
    }

    fn resume(&self, options: &SessionOptions) -> Result<Exit, Failure> {
        let out = self.out.display();
        let resumed = match Session::resume(&self.out, &self.plan, options) {
            Ok(resumed) => resumed,
            Err(ResumeError::NoJournal { .. }) if is_empty(&self.out) => {
                return Ok(self.ended(&self.start(options)?));
            }
            Err(error @ ResumeError::NoJournal { .. }) => return self.is_complete(error, options),
            Err(error) => return Err(self.cannot_resume(error)),
        };
        let Resumed { session, before, started, lost } = resumed;
        if lost > 0 {
            console::say(&format!("{lost} rows are no longer in {out}: they are computed again"));
        }
        console::say(&format!("{} of {} points of {out} are done", before.done(), self.plan.selected()));
        let sidecar = self.sidecar(started, options);
        write_sidecar(&sidecar, &self.out)?;
        Ok(self.ended(&self.work(session, before, sidecar, options)?))
    }

    /// There is nothing to resume: that is well if the rows wanted are all there.
    fn is_complete(&self, error: ResumeError, options: &SessionOptions) -> Result<Exit, Failure> {
        let sidecar = Sidecar::read(&sidecar::path_of(&self.out));
        let Some(sidecar) = sidecar.ok().filter(|sidecar| sidecar.state == State::Complete) else {
            return Err(self.cannot_resume(error));
        };
        let changes = Identity::recorded(&sidecar).differences(&Identity::of(&self.plan, &options.run));
        if !changes.is_empty() {
            return Err(self.cannot_resume(ResumeError::Changed { path: self.out.clone(), changes }));
        }
        console::say(&format!("{} is complete: nothing is left to run", self.out.display()));
        let periodic = sidecar.statuses.as_ref().and_then(|counts| counts.get(Status::Periodic.name()));
        Ok(self.complete(periodic == sidecar.rows.as_ref()))
    }

    /// The error, with the first line of the grid file that is another.
    fn cannot_resume(&self, error: ResumeError) -> Failure {
        let changed = matches!(error, ResumeError::Changed { .. });
        let mut failure = Failure::from(error);
        let before = Sidecar::read(&sidecar::path_of(&self.out)).ok().filter(|_| changed);
        if let Some(line) = before.and_then(|before| difference(&before.grid.text, &self.plan.source.text)) {
            failure = failure.help(line);
        }
        failure
    }

    fn sidecar(&self, started: String, options: &SessionOptions) -> Sidecar {
        Sidecar::new(&self.plan, Start { started, options: options.run, rerun: self.origin.clone() })
    }

    fn work(
        &self,
        mut session: Session,
        before: Summary,
        mut sidecar: Sidecar,
        options: &SessionOptions,
    ) -> Result<Done, Failure> {
        let start = Instant::now();
        let rows_before = before.rows;
        let outcome = run_with_progress(&self.plan, &options.run, before, &mut session);
        let outcome = outcome.and_then(|summary| match session.close(&summary) {
            Ok(()) => Ok(summary),
            Err(error) => Err(RunError::Sink(error)),
        });
        let end = End { finished: time::now(), seconds: session.seconds() };
        let go_on = |failure: Failure| failure.help(format!("`flap resume {}` goes on", self.out.display()));
        match outcome {
            Ok(summary) => {
                let place = session.rows_path(!summary.interrupted);
                sidecar.finish(&summary, end);
                write_sidecar(&sidecar, &self.out).map_err(go_on)?;
                if !summary.interrupted {
                    session.forget().map_err(|error| go_on(Failure::cannot_write(&self.out, &error)))?;
                }
                Ok(Done { summary, rows_before, seconds: start.elapsed().as_secs_f64(), place })
            }
            Err(error) => {
                sidecar.fail(error.to_string(), end);
                // The first error is the one to tell.
                let _ = write_sidecar(&sidecar, &self.out);
                Err(go_on(error.into()))
            }
        }
    }

    /// Writes to what can neither be read again nor resumed.
    fn to_stream(
        &self,
        stream: impl output::Durable,
        options: &RunOptions,
        place: PathBuf,
    ) -> Result<Done, Failure> {
        let mut sink = CsvSink::new(Layout::of(&self.plan), stream);
        let start = Instant::now();
        let summary = run_with_progress(&self.plan, options, Summary::default(), &mut sink)?;
        Ok(Done { summary, rows_before: 0, seconds: start.elapsed().as_secs_f64(), place })
    }
}

fn is_empty(path: &Path) -> bool {
    fs::metadata(path).map_or(true, |metadata| metadata.is_file() && metadata.len() == 0)
}

fn write_sidecar(sidecar: &Sidecar, results: &Path) -> Result<(), Failure> {
    let path = sidecar::path_of(results);
    sidecar.write(&path).map_err(|error| Failure::cannot_write(&path, &error))
}

/// The first line that differs, in words.
fn difference(before: &str, now: &str) -> Option<String> {
    let (before, now): (Vec<&str>, Vec<&str>) = (before.lines().collect(), now.lines().collect());
    let line = (0..before.len().max(now.len())).find(|&line| before.get(line) != now.get(line))?;
    let shown = |lines: &[&str]| lines.get(line).map_or("not there".to_owned(), |text| format!("`{text}`"));
    Some(format!("line {} of the grid was {}, it is {}", line + 1, shown(&before), shown(&now)))
}

/// Runs the plan with a progress bar; the first signal to end drains the sweep, the second exits at once.
fn run_with_progress(
    plan: &Plan,
    options: &RunOptions,
    before: Summary,
    sink: &mut dyn Sink,
) -> Result<Summary, RunError> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        // Order matters: the flag is still down when the first signal asks whether to exit. If signals
        // cannot be caught they end the program at once, and what was written so far is in order.
        let _ = flag::register_conditional_shutdown(signal, Exit::Interrupted as i32, Arc::clone(&stop));
        let _ = flag::register(signal, Arc::clone(&stop));
    }
    // Caught, the signal that a file would grow too large becomes an error of writing, which can be told.
    #[cfg(unix)]
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
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
    let unsettled = summary.counts.of(Status::Unsettled);
    if unsettled > 0 {
        console::say(&format!(
            "{unsettled} did not settle: where `residual` is still falling, raise max_cycles in [solver]; \
             where it is not, lower rtol or raise settle_tol"
        ));
    }

    let place = place.display();
    if summary.interrupted {
        let (done, points) = (summary.done(), summary.points);
        console::say(&format!("interrupted: the rows of the first {done} of {points} points are in {place}"));
    } else {
        console::say(&format!("{} rows in {place}", summary.rows));
    }
}

/// What to know if there is no sidecar.
pub(crate) const SIDECAR_HELP: &str = "the sidecar lies beside the results and tells what grid they are of";

/// The plan of results, from the sidecar beside them.
pub(crate) fn recorded(results: &Path) -> Result<(Plan, Sidecar), Failure> {
    let path = sidecar::path_of(results);
    let sidecar = Sidecar::read(&path).map_err(|error| Failure::from(error).help(SIDECAR_HELP))?;
    Ok((plan_of(&path, &sidecar)?, sidecar))
}

/// The plan in a sidecar, which was read from `path`.
pub(crate) fn plan_of(path: &Path, sidecar: &Sidecar) -> Result<Plan, Failure> {
    sidecar.plan(flap_core::simulate::all()).map_err(|error| match error {
        sidecar::PlanError::Grid(diagnostics) => Failure::Grid(diagnostics),
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

/// Opens results to be read.
pub(crate) fn open(results: &Path) -> Result<File, Failure> {
    File::open(results)
        .map_err(|error| Failure::System(format!("cannot read {}: {error}", results.display()), Vec::new()))
}

/// Makes a result file from other ones: all of it, or nothing.
pub(crate) fn make<E: From<io::Error>>(
    results: &Path,
    overwrite: bool,
    write: impl FnOnce(File) -> Result<(), E>,
) -> Result<Result<(), E>, Failure> {
    // Holds the name while the rows are written beside it.
    let locked = output::create(results, overwrite)?;
    let written = output::replace(results, write);
    if written.is_ok() {
        session::forget(results).map_err(|error| Failure::cannot_write(results, &error))?;
    } else if is_empty(results) {
        let _ = fs::remove_file(results);
    }
    drop(locked);
    Ok(written)
}
