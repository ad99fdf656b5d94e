//! The rows of a plan into a result file: with its sidecar, and such that the run can be resumed.
//!
//! How rows are made is up to the caller: by [`run::resume`](crate::run::resume) on this machine, or by
//! [`run::feed`](crate::run::feed) on others.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use flap_core::simulate::Status;

use crate::files::csv_sink::CsvSink;
use crate::files::inputs::{Inputs, Overlap};
use crate::files::integrity::{self, Damage};
use crate::files::journal;
use crate::files::output::{self, CreateError, Durable};
use crate::files::replaced;
use crate::files::results::{Format, FormatError};
use crate::files::session::{ResumeError, Resumed, Session, SessionOptions};
use crate::files::sidecar::{self, End, Origin, Sidecar, Start, State};
use crate::notation::time;
use crate::plan::Plan;
use crate::run::identity::Identity;
use crate::run::sink::Sink;
use crate::run::{RunError, RunOptions, Summary};
use crate::table::layout::Layout;

/// What is to be run, and where its rows go.
pub struct Job<'a> {
    /// The points.
    pub plan: &'a Plan,
    /// The result file.
    pub out: PathBuf,
    /// What becomes of results that are there already.
    pub begin: Begin,
    /// How the plan is run.
    pub options: SessionOptions,
    /// Where the points of a rerun come from.
    pub origin: Option<Origin>,
}

/// What becomes of results that are there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begin {
    /// They are an error.
    New,
    /// They are kept as [`kept`] says until the new ones are complete, and then dropped.
    Overwrite,
    /// They are gone on with.
    Resume,
}

/// What makes the rows of a plan and writes them to a sink, behind those that are there.
pub type Engine<'a> =
    &'a mut dyn FnMut(&Plan, &RunOptions, Summary, &mut dyn Sink) -> Result<Summary, RunError>;

/// What a job came to.
#[derive(Debug)]
pub enum Outcome {
    /// Points were run.
    Ran(Box<Done>),
    /// All rows wanted were there already.
    Complete {
        /// Whether all of them are periodic.
        all_periodic: bool,
    },
}

/// What this process did.
#[derive(Debug)]
pub struct Done {
    /// Of the rows of earlier sessions too.
    pub summary: Summary,
    /// Rows of earlier sessions.
    pub rows_before: u64,
    /// Seconds of running in this process.
    pub seconds: f64,
    /// Where the rows are; `None` if they went into a stream.
    pub place: Option<PathBuf>,
}

/// What a user may want to know before the points are run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Before {
    /// Rows that had been written but are no longer there: they are computed again.
    pub lost: u64,
    /// Points that are done with.
    pub done: u64,
}

/// Why a job failed.
#[derive(Debug, thiserror::Error)]
pub enum JobError {
    /// The results would overwrite what they are made from.
    #[error(transparent)]
    Overlap(#[from] Overlap),
    /// The name stands for no format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The results cannot be made.
    #[error(transparent)]
    Create(#[from] CreateError),
    /// The run cannot be resumed.
    #[error("{error}")]
    Resume {
        /// Why.
        error: ResumeError,
        /// The first line of the grid file that is another, in words.
        changed: Option<String>,
    },
    /// The results are complete, but not as they were written.
    #[error("{} is damaged: {damage}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// How.
        damage: Box<Damage>,
    },
    /// What lies beside complete results is damaged.
    #[error(transparent)]
    Sidecar(sidecar::ReadError),
    /// Complete results cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file beside the results cannot be written, or they cannot be completed.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
        /// Whether the run can be resumed.
        resumable: bool,
    },
    /// The run failed; it can be resumed if it went into a file.
    #[error("{error}")]
    Run {
        /// Why.
        error: RunError,
        /// Whether the run can be resumed.
        resumable: bool,
    },
}

impl JobError {
    fn write(path: &Path, source: io::Error, resumable: bool) -> JobError {
        JobError::Write { path: path.to_owned(), source, resumable }
    }
}

/// Runs the job. `tell` is called if it goes on with earlier work.
///
/// # Errors
/// [`JobError`]; rows that were written are kept, with what it takes to resume.
pub fn run(job: &Job<'_>, engine: Engine<'_>, tell: &mut dyn FnMut(Before)) -> Result<Outcome, JobError> {
    Inputs::new().add_plan(job.plan).protect_from_results(&job.out)?;
    match job.begin {
        Begin::Resume => job.resume(engine, tell),
        Begin::New | Begin::Overwrite => job.start(engine).map(|done| Outcome::Ran(Box::new(done))),
    }
}

/// Writes the rows of a plan to what can neither be read again nor resumed, as CSV.
///
/// # Errors
/// [`JobError::Run`].
pub fn to_stream(
    plan: &Plan,
    stream: impl Durable,
    options: &RunOptions,
    engine: Engine<'_>,
) -> Result<Done, JobError> {
    let mut sink = CsvSink::new(Layout::of(plan), stream);
    let start = Instant::now();
    let summary = engine(plan, options, Summary::default(), &mut sink)
        .map_err(|error| JobError::Run { error, resumable: false })?;
    Ok(Done { summary, rows_before: 0, seconds: start.elapsed().as_secs_f64(), place: None })
}

/// Where the earlier results are that the unfinished ones at `results` replace: beside them, under a name such as
/// `rows.old.csv`. `None` if there are none.
pub fn kept(results: &Path) -> Option<PathBuf> {
    replaced::kept(results)
}

impl Job<'_> {
    fn start(&self, engine: Engine<'_>) -> Result<Done, JobError> {
        let format = Format::of(&self.out)?;
        let file = output::create(&self.out, self.begin == Begin::Overwrite)?;
        // Devices and pipes have nothing beside them, and nothing to resume.
        if !file.metadata().is_ok_and(|metadata| metadata.is_file()) {
            let done = to_stream(self.plan, file, &self.options.run, engine)?;
            return Ok(Done { place: Some(self.out.clone()), ..done });
        }
        let (file, replaces) = self.make_room(file)?;
        let started = time::now();
        let sidecar = self.sidecar(started.clone());
        let session = self.write_sidecar(&sidecar, false).and_then(|()| {
            Session::start(file, (&self.out, format), self.plan, &self.options, (started, replaces))
                .map_err(|error| JobError::write(&self.out, error, false))
        });
        if session.is_err() && replaces {
            replaced::restore(&self.out);
        }
        self.work(session?, Summary::default(), sidecar, engine)
    }

    /// Moves earlier results aside that are to be replaced, and gives the file that new ones go to, and whether earlier ones
    /// wait beside it. `file` is the one that is there.
    fn make_room(&self, file: File) -> Result<(File, bool), JobError> {
        let refused = |error| JobError::write(&self.out, error, false);
        let is_unfinished = journal::path_of(&self.out).exists();
        let is_empty = file.metadata().map_err(refused)?.len() == 0;
        if self.begin != Begin::Overwrite || (is_empty && !is_unfinished) {
            return Ok((file, false));
        }
        // These were to replace others, which are the ones to be kept.
        if replaced::kept(&self.out).is_some() {
            return Ok((file, true));
        }
        replaced::set_aside(&self.out).map_err(refused)?;
        match output::create(&self.out, false) {
            Ok(file) => Ok((file, true)),
            Err(error) => {
                replaced::restore(&self.out);
                Err(error.into())
            }
        }
    }

    fn resume(&self, engine: Engine<'_>, tell: &mut dyn FnMut(Before)) -> Result<Outcome, JobError> {
        let resumed = match Session::resume(&self.out, self.plan, &self.options) {
            Ok(resumed) => resumed,
            Err(ResumeError::NoJournal { .. }) if is_empty(&self.out) => {
                return self.start(engine).map(|done| Outcome::Ran(Box::new(done)));
            }
            Err(error @ ResumeError::NoJournal { .. }) => return self.is_complete(error),
            Err(error) => return Err(self.cannot_resume(error)),
        };
        let Resumed { session, before, started, lost } = resumed;
        tell(Before { lost, done: before.done() });
        let sidecar = self.sidecar(started);
        self.write_sidecar(&sidecar, false)?;
        self.work(session, before, sidecar, engine).map(|done| Outcome::Ran(Box::new(done)))
    }

    /// There is nothing to resume: that is well if the rows wanted are all there.
    fn is_complete(&self, error: ResumeError) -> Result<Outcome, JobError> {
        let sidecar = match Sidecar::read(&sidecar::path_of(&self.out)) {
            Ok(sidecar) if sidecar.state == State::Complete => sidecar,
            Err(error @ sidecar::ReadError::Damaged { .. }) => return Err(JobError::Sidecar(error)),
            _ => return Err(self.cannot_resume(error)),
        };
        let own = Identity::of(self.plan, &self.options.run);
        let changes = sidecar.identity().differences(&own);
        if !changes.is_empty() {
            return Err(self.cannot_resume(ResumeError::Changed { path: self.out.clone(), changes }));
        }
        let format = Format::of(&self.out)?;
        match integrity::check(&self.out, format, &sidecar) {
            Ok(None) => {}
            Ok(Some(damage)) => return Err(self.damaged(damage)),
            Err(source) => return Err(JobError::Read { path: self.out.clone(), source }),
        }
        let periodic = sidecar.statuses.as_ref().and_then(|counts| counts.get(Status::Periodic.name()));
        Ok(Outcome::Complete { all_periodic: periodic == sidecar.rows.as_ref() })
    }

    fn damaged(&self, damage: Damage) -> JobError {
        JobError::Damaged { path: self.out.clone(), damage: Box::new(damage) }
    }

    /// The error, with the first line of the grid file that is another.
    fn cannot_resume(&self, error: ResumeError) -> JobError {
        let is_changed = matches!(error, ResumeError::Changed { .. });
        let before = Sidecar::read(&sidecar::path_of(&self.out)).ok().filter(|_| is_changed);
        let changed = before.and_then(|before| difference(&before.grid.text, &self.plan.source.text));
        JobError::Resume { error, changed }
    }

    fn sidecar(&self, started: String) -> Sidecar {
        Sidecar::new(self.plan, Start { started, options: self.options.run, rerun: self.origin.clone() })
    }

    fn write_sidecar(&self, sidecar: &Sidecar, resumable: bool) -> Result<(), JobError> {
        let path = sidecar::path_of(&self.out);
        sidecar.write(&path).map_err(|error| JobError::write(&path, error, resumable))
    }

    fn work(
        &self,
        mut session: Session,
        before: Summary,
        mut sidecar: Sidecar,
        engine: Engine<'_>,
    ) -> Result<Done, JobError> {
        let start = Instant::now();
        let rows_before = before.rows;
        let outcome = engine(self.plan, &self.options.run, before, &mut session);
        let outcome = outcome.and_then(|summary| match session.close(&summary) {
            Ok(()) => Ok(summary),
            Err(error) => Err(RunError::Sink(error)),
        });
        let end = End { finished: time::now(), seconds: session.seconds() };
        match outcome {
            Ok(summary) => {
                let place = Some(session.rows_path(!summary.interrupted));
                sidecar.finish(&summary, end);
                sidecar.checksums = (!summary.interrupted).then(|| session.checksums());
                self.write_sidecar(&sidecar, true)?;
                if !summary.interrupted {
                    if replaced::kept(&self.out).is_some() {
                        replaced::remove(&self.out)
                            .map_err(|error| JobError::write(&self.out, error, true))?;
                    }
                    session.forget().map_err(|error| JobError::write(&self.out, error, true))?;
                }
                Ok(Done { summary, rows_before, seconds: start.elapsed().as_secs_f64(), place })
            }
            Err(error) => {
                sidecar.fail(error.to_string(), end);
                // The first error is the one to tell.
                let _ = self.write_sidecar(&sidecar, true);
                Err(JobError::Run { error, resumable: true })
            }
        }
    }
}

/// Whether there is nothing at `path`.
pub fn is_empty(path: &Path) -> bool {
    fs::metadata(path).map_or(true, |metadata| metadata.is_file() && metadata.len() == 0)
}

/// The first line that differs, in words.
fn difference(before: &str, now: &str) -> Option<String> {
    let (before, now): (Vec<&str>, Vec<&str>) = (before.lines().collect(), now.lines().collect());
    let line = (0..before.len().max(now.len())).find(|&line| before.get(line) != now.get(line))?;
    let shown = |lines: &[&str]| lines.get(line).map_or("not there".to_owned(), |text| format!("`{text}`"));
    Some(format!("line {} of the grid was {}, it is {}", line + 1, shown(&before), shown(&now)))
}
