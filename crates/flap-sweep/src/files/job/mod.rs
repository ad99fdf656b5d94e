//! Writes the rows of a plan into a result file, and writes the sidecar of the file. An interrupted run can
//! be resumed.
//!
//! The function [`begin`] opens the files. The caller then writes the rows to [`Writing::sink`] with a
//! [`RowWriter`](crate::run::RowWriter). The rows are computed on this machine, or arrive from other
//! machines. After the last row, the caller calls [`Writing::finish`].

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

/// A plan whose rows the job computes, and the file into which the job writes the rows.
pub struct Job<'a> {
    /// Points.
    pub plan: &'a Plan,
    /// Result file.
    pub out: PathBuf,
    /// Treatment of existing results.
    pub on_existing: OnExisting,
    /// Options of the session.
    pub options: SessionOptions,
    /// For a rerun, the earlier results whose points are computed again; otherwise `None`.
    pub origin: Option<Origin>,
}

/// Treatment of existing results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnExisting {
    /// If the existing results are unfinished, the job continues them. If the existing results are complete,
    /// the job computes nothing. If the existing results contain different rows, the job returns an error.
    Continue,
    /// The existing results are replaced when the new results are complete. Until the new results are
    /// complete, they have [a different name](replacement::unfinished), such as `rows.new.csv`.
    Restart,
}

/// A job after [`begin`].
pub enum Begun<'a> {
    /// The caller must write the rows of the job.
    Writing(Box<Writing<'a>>),
    /// All rows of the job exist already.
    Complete {
        /// True if all rows have the status `periodic`.
        all_periodic: bool,
    },
}

/// The open result file of a job that writes rows.
pub struct Writing<'a> {
    job: &'a Job<'a>,
    target: Target,
    /// Summary of the rows that earlier runs have written. The job continues with the first point after the
    /// rows of earlier runs.
    pub before: Summary,
    /// If the job continues a run, the number of rows that earlier runs wrote but that are missing in the
    /// file. The job computes the missing rows again.
    pub lost: Option<u64>,
    /// Locks of the result file, and of the new file that will replace the result file. The files remain
    /// locked until the end of the job.
    locks: Vec<Lock>,
    begun: Instant,
}

/// Target of the rows.
enum Target {
    /// A regular file with its journal and sidecar.
    Session(Box<Session>, Box<Sidecar>),
    /// A device or a pipe. For a device or a pipe, flap writes no journal, so the run cannot be resumed.
    Stream(CsvSink<File>),
}

/// A finished job.
#[derive(Debug)]
pub struct Done {
    /// Summary of all rows, including the rows of earlier runs.
    pub summary: Summary,
    /// Number of rows that earlier runs of the job have written.
    pub rows_before: u64,
    /// Time that this process has spent on the job, in seconds.
    pub seconds: f64,
    /// File that contains the rows; `None` for a device or a pipe.
    pub place: Option<PathBuf>,
}

/// Begins the job.
///
/// # Errors
/// - [`JobError::Overlap`] if the results would overwrite one of the input files.
/// - [`JobError::Format`] if the file name has no supported ending, such as `.csv`.
/// - [`JobError::Exists`] if the result file exists already and does not contain the rows of the job.
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

    /// Begins the job in a new file beside the earlier results. When the new file is complete, the new file
    /// gets the name of the earlier results. The function adds the lock of the new file to `locks`.
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

    /// Begins the job in the empty file `file`, whose path is `place`. If `replaces` is true, `file` gets the
    /// name of the earlier results when `file` is complete.
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

    /// Returns a job that is ready to write rows. `before` is the summary of the rows that earlier runs
    /// have written.
    fn writing(&'a self, target: Target, before: Summary, lost: Option<u64>, locks: Vec<Lock>) -> Begun<'a> {
        Begun::Writing(Box::new(Writing { job: self, target, before, lost, locks, begun: Instant::now() }))
    }

    /// Gives the complete results at `place` their final name, and removes the files that exist only beside
    /// unfinished results, such as the journal.
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
    /// If the results could not be locked, returns the reason. Without a lock, flap does not detect a second
    /// run that writes to the same results.
    pub fn unlocked(&self) -> Option<&io::Error> {
        self.locks.iter().find_map(Lock::unlocked)
    }

    /// Returns the sink to which the caller writes the new rows. The sink adds the new rows after the rows of
    /// earlier runs.
    pub fn sink(&mut self) -> &mut dyn Sink {
        match &mut self.target {
            Target::Session(session, _) => &mut **session,
            Target::Stream(sink) => sink,
        }
    }

    /// Completes the results and their sidecar. `ended` is the summary of all rows, or the error that stopped
    /// the run.
    ///
    /// # Errors
    /// - [`JobError::Run`] if the run failed. The written rows and the journal are kept.
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
    /// The file name has no supported ending, such as `.csv`.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The results cannot be created.
    #[error(transparent)]
    Create(#[from] CreateError),
    /// The result file exists already and does not contain the rows of the job.
    #[error("{} exists already{}", path.display(), other_rows(changes))]
    Exists {
        /// The file.
        path: PathBuf,
        /// Descriptions of the differences between the rows in the file and the rows of the job. The list
        /// is empty if the differences are unknown.
        changes: Vec<String>,
        /// Description of the first line in which the grid file differs from the grid in the sidecar.
        changed: Option<String>,
    },
    /// The run cannot be resumed.
    #[error("{error}")]
    Resume {
        /// The reason.
        error: ResumeError,
        /// Description of the first line in which the grid file differs from the grid in the sidecar.
        changed: Option<String>,
        /// True if `flap results resume` can continue the rows with the grid that the sidecar records.
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
        /// Error that the operating system reported.
        source: io::Error,
        /// True if the run can be resumed.
        resumable: bool,
    },
    /// The run failed.
    #[error("{error}")]
    Run {
        /// The reason.
        error: RunError,
        /// True if the written rows are in a regular file, so that the run can be resumed.
        resumable: bool,
    },
}

/// Returns the last part of a message. This part describes how the existing rows differ from the rows of the
/// job.
fn other_rows(changes: &[String]) -> String {
    if changes.is_empty() { String::new() } else { format!(", with other rows: {}", changes.join("; ")) }
}

impl JobError {
    fn write(path: &Path, source: io::Error, resumable: bool) -> JobError {
        JobError::Write { path: path.to_owned(), source, resumable }
    }
}
