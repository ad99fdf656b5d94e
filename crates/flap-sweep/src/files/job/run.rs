//! A job that starts, and one that ends.

use std::fs::File;
use std::path::PathBuf;
use std::time::Instant;

use super::{Before, Done, Engine, JobError, Outcome, to_stream};
use crate::files::beside::{journal_of, sidecar_of};
use crate::files::inputs::Inputs;
use crate::files::output::{self, CreateError};
use crate::files::replaced;
use crate::files::results::Format;
use crate::files::session::{Session, SessionOptions};
use crate::files::sidecar::{End, Origin, Sidecar, Start};
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
    /// They are kept under the name that [`kept`](replaced::kept) gives until the new ones are complete, and then removed.
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

/// Runs the job. `tell` is called if it continues earlier work.
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
pub fn run(job: &Job<'_>, engine: Engine<'_>, tell: &mut dyn FnMut(Before)) -> Result<Outcome, JobError> {
    Inputs::new().add_plan(job.plan).protect_from_results(&job.out)?;
    match job.begin {
        Begin::Resume => job.resume(engine, tell),
        Begin::Overwrite => job.start(engine),
        Begin::New => match job.start(engine) {
            Err(JobError::Create(CreateError::Exists(_))) => job.existing(),
            Err(JobError::Create(CreateError::Unfinished(_))) => Err(job.unfinished()),
            outcome => outcome,
        },
    }
}

impl Job<'_> {
    /// Runs the job from its first point.
    pub(super) fn start(&self, engine: Engine<'_>) -> Result<Outcome, JobError> {
        let format = Format::of(&self.out)?;
        let file = output::create(&self.out, self.begin == Begin::Overwrite)?;
        // Devices and pipes have nothing beside them, and nothing to resume.
        if !file.metadata().is_ok_and(|metadata| metadata.is_file()) {
            let done = to_stream(self.plan, file, &self.options.run, engine)?;
            return Ok(Outcome::Ran(Box::new(Done { place: Some(self.out.clone()), ..done })));
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

    /// Moves earlier results aside if they are to be replaced. `file` is the one that holds them. Returns the file for new
    /// rows, and true if earlier results are kept beside it.
    fn make_room(&self, file: File) -> Result<(File, bool), JobError> {
        let refused = |error| JobError::write(&self.out, error, false);
        let is_unfinished = journal_of(&self.out).exists();
        let is_empty = file.metadata().map_err(refused)?.len() == 0;
        if self.begin != Begin::Overwrite || (is_empty && !is_unfinished) {
            return Ok((file, false));
        }
        // Unfinished results that replace others: those others are kept.
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

    /// The sidecar of a sweep that `started` at this time.
    pub(super) fn sidecar(&self, started: String) -> Sidecar {
        Sidecar::new(self.plan, Start { started, options: self.options.run, rerun: self.origin.clone() })
    }

    pub(super) fn write_sidecar(&self, sidecar: &Sidecar, resumable: bool) -> Result<(), JobError> {
        let path = sidecar_of(&self.out);
        sidecar.write(&path).map_err(|error| JobError::write(&path, error, resumable))
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
                let place = Some(session.rows_path(!summary.interrupted));
                sidecar.finish(&summary, end);
                sidecar.checksums = (!summary.interrupted).then(|| session.checksums());
                self.write_sidecar(&sidecar, true)?;
                if !summary.interrupted {
                    self.clear(session)?;
                }
                let seconds = start.elapsed().as_secs_f64();
                Ok(Outcome::Ran(Box::new(Done { summary, rows_before, seconds, place })))
            }
            Err(error) => {
                sidecar.fail(error.to_string(), end);
                // The first error is the one to report.
                let _ = self.write_sidecar(&sidecar, true);
                Err(JobError::Run { error, resumable: true })
            }
        }
    }

    /// Removes the files that complete results do not need: earlier results, the journal and waiting rows.
    fn clear(&self, session: Session) -> Result<(), JobError> {
        let refused = |error| JobError::write(&self.out, error, true);
        if replaced::kept(&self.out).is_some() {
            replaced::remove(&self.out).map_err(refused)?;
        }
        session.forget().map_err(refused)
    }
}
