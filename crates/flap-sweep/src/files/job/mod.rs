//! Writes the rows of a plan into a result file with its sidecar. An interrupted run can be resumed.
//!
//! [`begin`] opens the files. A [`RowWriter`](crate::run::RowWriter) of the caller writes rows of this machine or chunks
//! of other machines to [`Writing::sink`]. The caller ends with [`Writing::finish`].

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::beside::sidecar_of;
use super::csv_sink::CsvSink;
use super::inputs::{Inputs, Overlap};
use super::integrity::OpenError;
use super::output::{self, CreateError, Lock};
pub use super::replacement::{to_resume, unfinished};
use super::results::{Format, FormatError};
use super::session::{ResumeError, Session, SessionOptions};
use super::sidecar::{Origin, Sidecar};
use super::{disk, replacement};
use crate::notation::time;
use crate::plan::Plan;
use crate::run::{RunError, Sink, Summary};
use crate::table::layout::Layout;

mod earlier;

/// A plan to run, and the file for its rows.
pub struct Job<'a> {
    /// Points.
    pub plan: &'a Plan,
    /// Result file.
    pub out: PathBuf,
    /// Treatment of existing results.
    pub on_existing: OnExisting,
    /// Options of the session.
    pub options: SessionOptions,
    /// Earlier results whose points are run again, if this is a rerun.
    pub origin: Option<Origin>,
}

/// Treatment of existing results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnExisting {
    /// Unfinished rows of the job are continued. If the rows are complete, nothing is run. Existing results with other
    /// rows are an error.
    Continue,
    /// Existing results are replaced when the new results are complete. Until the new results are complete, they have
    /// [another name](replacement::unfinished).
    Restart,
}

/// A job after [`begin`].
pub enum Begun<'a> {
    /// The rows of the job must be written.
    Writing(Box<Writing<'a>>),
    /// All rows of the job exist already.
    Complete {
        /// True if all rows are periodic.
        all_periodic: bool,
    },
}

/// The result file of a job while the job writes rows.
pub struct Writing<'a> {
    job: &'a Job<'a>,
    target: Target,
    /// Summary of the rows of earlier runs. The next row belongs to the point after these rows.
    pub before: Summary,
    /// Number of rows that earlier runs had written but that are missing in the file, if the job continues a run.
    /// The job computes the missing rows again.
    pub lost: Option<u64>,
    /// Locks of the results and of their replacement, until the end of the job.
    locks: Vec<Lock>,
    begun: Instant,
}

/// Target of the rows.
enum Target {
    /// A regular file with its journal and sidecar.
    Session(Box<Session>, Box<Sidecar>),
    /// A device or a pipe. A device or pipe has no files beside it, so the run cannot be resumed.
    Stream(CsvSink<File>),
}

/// A finished job.
#[derive(Debug)]
pub struct Done {
    /// Summary of all rows, including the rows of earlier runs.
    pub summary: Summary,
    /// Number of rows of earlier runs.
    pub rows_before: u64,
    /// Running time of this process (s).
    pub seconds: f64,
    /// File that contains the rows; `None` for a stream.
    pub place: Option<PathBuf>,
}

/// Begins the job.
///
/// # Errors
/// - [`JobError::Overlap`] if the results would overwrite one of the input files.
/// - [`JobError::Format`] if the ending of the name belongs to no format.
/// - [`JobError::Exists`] if a file of this name contains other rows.
/// - [`JobError::Create`] if the results cannot be created.
/// - [`JobError::Resume`] if the run cannot be resumed.
/// - [`JobError::Open`] if the results are complete but damaged.
/// - [`JobError::Write`] if a file beside the results cannot be written.
pub fn begin<'a>(job: &'a Job<'a>) -> Result<Begun<'a>, JobError> {
    Inputs::new().add_plan(job.plan).protect_from_results(&job.out)?;
    // `resume` rejects a disk, because its contents must not be overwritten. `start` writes to a disk.
    match job.on_existing {
        OnExisting::Continue if !disk::is_stream(&job.out) => job.resume(),
        _ => job.start(),
    }
}

impl<'a> Job<'a> {
    /// Begins the job at its first point.
    fn start(&'a self) -> Result<Begun<'a>, JobError> {
        let format = Format::of(&self.out)?;
        let overwrite = self.on_existing == OnExisting::Restart;
        let (file, lock) = output::create(&self.out, overwrite)?;
        let Some(lock) = lock else {
            let sink = CsvSink::new(Layout::of(self.plan).names(), file);
            return Ok(self.writing(Target::Stream(sink), Summary::default(), None, Vec::new()));
        };
        let mut locks = vec![lock];
        let refused = |error| JobError::write(&self.out, error, false);
        if overwrite {
            replacement::discard(&self.out).map_err(refused)?;
        }
        let has_rows = !disk::is_empty(&self.out) || replacement::has_journal(&self.out).map_err(refused)?;
        if !overwrite || !has_rows {
            let target = self.start_at((&self.out, format), file, false)?;
            return Ok(self.writing(target, Summary::default(), None, locks));
        }
        // The earlier results are closed: on Windows, an open file cannot be replaced on every file system.
        drop(file);
        let target = self.start_beside(format, &mut locks)?;
        Ok(self.writing(target, Summary::default(), None, locks))
    }

    /// Begins the job with an empty file beside the earlier results. When the file is complete, it gets the name of the
    /// results. Adds the lock of the file to `locks`.
    fn start_beside(&self, format: Format, locks: &mut Vec<Lock>) -> Result<Target, JobError> {
        let new = replacement::of(&self.out);
        let (file, lock) = output::create(&new, false).map_err(|error| match error {
            CreateError::Exists(path) | CreateError::Unfinished(path) => {
                CreateError::InTheWay { path, results: self.out.clone() }
            }
            error => error,
        })?;
        locks.extend(lock);
        self.start_at((&new, format), file, true)
    }

    /// Begins the job with the empty `file` at `place`. If `replaces` is true, the file gets the name of the earlier
    /// results when the file is complete.
    fn start_at(
        &self,
        (place, format): (&Path, Format),
        file: File,
        replaces: bool,
    ) -> Result<Target, JobError> {
        let started = time::now();
        let sidecar = self.sidecar(started.clone());
        let begun = output::check_beside(place, format).map_err(JobError::from).and_then(|()| {
            write_sidecar(place, &sidecar, false)?;
            Session::start(file, (place, format), self.plan, &self.options, started, replaces)
                .map_err(|error| JobError::write(place, error, false))
        });
        let session = begun.inspect_err(|_| {
            // These files are empty. The first error is the one to report.
            let _ = replacement::remove_companions(place).and_then(|()| fs::remove_file(disk::target(place)));
        })?;
        Ok(Target::Session(Box::new(session), Box::new(sidecar)))
    }

    /// Returns the sidecar of a sweep that started at the time `started`.
    fn sidecar(&self, started: String) -> Sidecar {
        Sidecar::new(self.plan, started, &self.options.run, self.origin.clone())
    }

    /// Returns the job after the rows that `before` counts.
    fn writing(&'a self, target: Target, before: Summary, lost: Option<u64>, locks: Vec<Lock>) -> Begun<'a> {
        Begun::Writing(Box::new(Writing { job: self, target, before, lost, locks, begun: Instant::now() }))
    }

    /// Gives the complete results at `place` their final name, and removes the files that complete results do not need.
    fn complete(&self, place: &Path) -> Result<(), JobError> {
        let completed = if place == self.out {
            replacement::remove_progress(place)
        } else {
            replacement::commit(&self.out)
        };
        completed.map_err(|error| JobError::write(&self.out, error, true))
    }
}

impl Writing<'_> {
    /// Returns the reason for a failed lock. Without a lock, another run that writes to the results is not detected.
    pub fn unlocked(&self) -> Option<&io::Error> {
        self.locks.iter().find_map(Lock::unlocked)
    }

    /// Returns the sink for the rows after the rows of earlier runs.
    pub fn sink(&mut self) -> &mut dyn Sink {
        match &mut self.target {
            Target::Session(session, _) => &mut **session,
            Target::Stream(sink) => sink,
        }
    }

    /// Completes the results and their sidecar. `ended` is the result of the run.
    ///
    /// # Errors
    /// - [`JobError::Run`] with the error of the run; the written rows are kept with their journal.
    /// - [`JobError::Write`] if a file beside the results cannot be written.
    pub fn finish(self, ended: Result<Summary, RunError>) -> Result<Done, JobError> {
        let rows_before = self.before.rows;
        let seconds = self.begun.elapsed().as_secs_f64();
        let (mut session, mut sidecar) = match self.target {
            Target::Session(session, sidecar) => (session, sidecar),
            Target::Stream(_) => {
                let summary = ended.map_err(|error| JobError::Run { error, resumable: false })?;
                return Ok(Done { summary, rows_before, seconds, place: None });
            }
        };
        let finished = ended.and_then(|summary| {
            session.end(&summary)?;
            Ok(summary)
        });
        let summary = match finished {
            Ok(summary) => summary,
            Err(error) => {
                sidecar.fail(error.to_string(), time::now(), session.seconds());
                // The first error is the one to report.
                let _ = write_sidecar(session.path(), &sidecar, true);
                return Err(JobError::Run { error, resumable: true });
            }
        };
        let is_complete = !summary.is_interrupted();
        sidecar.finish(&summary, time::now(), session.seconds());
        sidecar.checksums = is_complete.then(|| session.checksums());
        let path = session.path().to_owned();
        let place = if is_complete { self.job.out.clone() } else { session.rows_path() };
        write_sidecar(&path, &sidecar, true)?;
        // The files are closed before they are renamed or removed.
        drop(session);
        if is_complete {
            self.job.complete(&path)?;
        }
        drop(self.locks);
        Ok(Done { summary, rows_before, seconds: self.begun.elapsed().as_secs_f64(), place: Some(place) })
    }
}

/// Writes the sidecar of the results at `place`.
fn write_sidecar(place: &Path, sidecar: &Sidecar, resumable: bool) -> Result<(), JobError> {
    let path = sidecar_of(place);
    sidecar.write(&path).map_err(|error| JobError::write(&path, error, resumable))
}

/// Reason why a job failed.
#[derive(Debug, thiserror::Error)]
pub enum JobError {
    /// The results would overwrite one of the input files.
    #[error(transparent)]
    Overlap(#[from] Overlap),
    /// The ending of the name belongs to no format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The results cannot be created.
    #[error(transparent)]
    Create(#[from] CreateError),
    /// A file with the name of the results contains other rows.
    #[error("{} exists already{}", path.display(), other_rows(changes))]
    Exists {
        /// The file.
        path: PathBuf,
        /// Differences between the rows of the file and the rows of the job, in words; empty if unknown.
        changes: Vec<String>,
        /// Description of the first line of the grid file that differs.
        changed: Option<String>,
    },
    /// The run cannot be resumed.
    #[error("{error}")]
    Resume {
        /// The reason.
        error: ResumeError,
        /// Description of the first line of the grid file that has changed.
        changed: Option<String>,
        /// True if the sweep that began the rows can be continued from its sidecar.
        continues: bool,
    },
    /// The results are complete, but the results or the sidecar are damaged or unreadable.
    #[error(transparent)]
    Open(OpenError),
    /// A file beside the results cannot be written, or the results cannot be completed.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
        /// True if the run can be resumed.
        resumable: bool,
    },
    /// The run failed.
    #[error("{error}")]
    Run {
        /// The reason.
        error: RunError,
        /// True if the rows are in a file, so that the run can be resumed.
        resumable: bool,
    },
}

/// Returns the differences between existing rows and the rows of the job, as the end of a message.
fn other_rows(changes: &[String]) -> String {
    if changes.is_empty() { String::new() } else { format!(", with other rows: {}", changes.join("; ")) }
}

impl JobError {
    fn write(path: &Path, source: io::Error, resumable: bool) -> JobError {
        JobError::Write { path: path.to_owned(), source, resumable }
    }
}
