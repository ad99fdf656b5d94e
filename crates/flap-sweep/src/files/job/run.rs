//! A job that starts, and one that ends.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::{Done, Engine, JobError, Notice, Outcome, to_stream};
use crate::files::beside::sidecar_of;
use crate::files::inputs::Inputs;
use crate::files::output::{self, CreateError, Output};
use crate::files::results::Format;
use crate::files::session::{Session, SessionOptions};
use crate::files::sidecar::{End, Origin, Sidecar, Start};
use crate::files::{companions, disk, replacement};
use crate::notation::time;
use crate::plan::Plan;
use crate::run::{RunError, Summary};

/// A plan that is to be run, and the file for its rows.
pub struct Job<'a> {
    /// The points.
    pub plan: &'a Plan,
    /// The result file.
    pub out: PathBuf,
    /// The treatment of results that are there already.
    pub begin: Begin,
    /// Options of the session.
    pub options: SessionOptions,
    /// The earlier results that the points of a rerun are taken from.
    pub origin: Option<Origin>,
}

/// The treatment of results that are there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begin {
    /// They are an error, unless they are complete and hold the rows of the job: then nothing is left to run.
    New,
    /// They are replaced when the new ones are complete. Until then the new ones have [another name](replacement::unfinished).
    Overwrite,
    /// They are continued.
    Resume,
}

impl Begin {
    /// The treatment that the options `resume` and `overwrite` ask for, of which at most one is given.
    pub fn of(resume: bool, overwrite: bool) -> Begin {
        match (resume, overwrite) {
            (true, _) => Begin::Resume,
            (false, true) => Begin::Overwrite,
            (false, false) => Begin::New,
        }
    }
}

/// Runs the job. `tell` is called with notices for the user.
///
/// # Errors
/// - [`JobError::Overlap`] if the results would overwrite a file that they are made from
/// - [`JobError::Format`] if the name of the results stands for no format
/// - [`JobError::Exists`] if a file of that name holds other rows
/// - [`JobError::Unfinished`] if the results are unfinished
/// - [`JobError::Create`] if the results cannot be made
/// - [`JobError::Resume`] if the run cannot be resumed
/// - [`JobError::Open`] if the results are complete already, but damaged
/// - [`JobError::Write`] if a file beside the results cannot be written
/// - [`JobError::Run`] if rows cannot be computed or written; those written are kept with their journal
pub fn run(job: &Job<'_>, engine: Engine<'_>, tell: &mut dyn FnMut(Notice)) -> Result<Outcome, JobError> {
    Inputs::new().add_plan(job.plan).protect_from_results(&job.out)?;
    match job.begin {
        Begin::Resume => job.resume(engine, tell),
        Begin::Overwrite => job.start(engine, tell),
        Begin::New => match job.start(engine, tell) {
            Err(JobError::Create(CreateError::Exists(_))) => job.existing(),
            Err(JobError::Create(CreateError::Unfinished(_))) => Err(job.unfinished()),
            outcome => outcome,
        },
    }
}

impl Job<'_> {
    /// Runs the job from its first point.
    pub(super) fn start(
        &self,
        engine: Engine<'_>,
        tell: &mut dyn FnMut(Notice),
    ) -> Result<Outcome, JobError> {
        let format = Format::of(&self.out)?;
        let overwrite = self.begin == Begin::Overwrite;
        // Locked until the end of the job, even if the rows go into a replacement.
        let Output { file, unlocked } = output::create(&self.out, overwrite)?;
        // Devices and pipes have nothing beside them, and nothing to resume.
        if !file.metadata().is_ok_and(|metadata| metadata.is_file()) {
            let done = to_stream(self.plan, file, &self.options.run, engine)?;
            return Ok(Outcome::Ran(Box::new(Done { place: Some(self.out.clone()), ..done })));
        }
        unlocked.map(Notice::Unlocked).into_iter().for_each(tell);
        let refused = |error| JobError::write(&self.out, error, false);
        if overwrite {
            replacement::discard(&self.out).map_err(refused)?;
        }
        let has_rows = !disk::is_empty(&self.out) || companions::has_journal(&self.out).map_err(refused)?;
        if !overwrite || !has_rows {
            return self.begin(file, (&self.out, format), false, engine);
        }
        let new = replacement::of(&self.out);
        let created = output::create(&new, false).map_err(|error| match error {
            CreateError::Exists(path) | CreateError::Unfinished(path) => {
                CreateError::InTheWay { path, results: self.out.clone() }
            }
            error => error,
        })?;
        self.begin(created.file, (&new, format), true, engine)
    }

    /// Runs the job from its first point into the empty `file`, which was created at `place`. If it `replaces` earlier
    /// results, it has their name in the end.
    fn begin(
        &self,
        file: File,
        (place, format): (&Path, Format),
        replaces: bool,
        engine: Engine<'_>,
    ) -> Result<Outcome, JobError> {
        let started = time::now();
        let sidecar = self.sidecar(started.clone());
        let begun = output::check_beside(place, format).map_err(JobError::from).and_then(|()| {
            write_sidecar(place, &sidecar, false)?;
            Session::start(file, (place, format), self.plan, &self.options, (started, replaces))
                .map_err(|error| JobError::write(place, error, false))
        });
        let session = begun.inspect_err(|_| {
            // Nothing is in these files. The first error is the one to report.
            let _ = companions::remove(place).and_then(|()| fs::remove_file(disk::target(place)));
        })?;
        self.work(session, Summary::default(), sidecar, engine)
    }

    /// The sidecar of a sweep that `started` at this time.
    pub(super) fn sidecar(&self, started: String) -> Sidecar {
        Sidecar::new(self.plan, Start { started, options: self.options.run, rerun: self.origin.clone() })
    }

    /// Runs the points behind those that `before` counts, and completes the results and their sidecar.
    pub(super) fn work(
        &self,
        mut session: Session,
        before: Summary,
        mut sidecar: Sidecar,
        engine: Engine<'_>,
    ) -> Result<Outcome, JobError> {
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
                let is_complete = !summary.interrupted;
                sidecar.finish(&summary, end);
                sidecar.checksums = is_complete.then(|| session.checksums());
                write_sidecar(session.path(), &sidecar, true)?;
                if is_complete {
                    self.complete(session.path())?;
                }
                let place = if is_complete { self.out.clone() } else { session.rows_path() };
                let seconds = start.elapsed().as_secs_f64();
                Ok(Outcome::Ran(Box::new(Done { summary, rows_before, seconds, place: Some(place) })))
            }
            Err(error) => {
                sidecar.fail(error.to_string(), end);
                // The first error is the one to report.
                let _ = write_sidecar(session.path(), &sidecar, true);
                Err(JobError::Run { error, resumable: true })
            }
        }
    }

    /// Gives the complete results at `place` their name, and removes the files that they do not need.
    pub(super) fn complete(&self, place: &Path) -> Result<(), JobError> {
        let completed = if place == self.out {
            companions::remove_progress(place)
        } else {
            replacement::commit(&self.out)
        };
        completed.map_err(|error| JobError::write(&self.out, error, true))
    }
}

/// Writes the sidecar of the results at `place`.
pub(super) fn write_sidecar(place: &Path, sidecar: &Sidecar, resumable: bool) -> Result<(), JobError> {
    let path = sidecar_of(place);
    sidecar.write(&path).map_err(|error| JobError::write(&path, error, resumable))
}
