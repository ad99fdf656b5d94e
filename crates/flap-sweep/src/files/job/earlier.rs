//! Begins jobs whose result file exists already. If the earlier results are unfinished, the job continues
//! them. If the earlier results are complete, the job checks that they contain the rows of the job.

use std::path::Path;

use super::{Begun, Job, JobError, Target, write_sidecar};
use crate::files::beside::{journal_of, sidecar_of};
use crate::files::integrity::{self, OnDamage};
use crate::files::results::Format;
use crate::files::session::{ResumeError, Resumed, Session};
use crate::files::sidecar::{Sidecar, SidecarError, State};
use crate::files::{disk, journal, output, replacement};
use crate::plan::selection::Selection;
use crate::run::Summary;
use crate::run::identity::Identity;

impl<'a> Job<'a> {
    /// Begins the job at the first point that no earlier run has finished.
    pub(super) fn resume(&'a self) -> Result<Begun<'a>, JobError> {
        let format = Format::of(&self.out)?;
        let Some(new) = replacement::unfinished(&self.out) else {
            return self.resume_at(&self.out);
        };
        let lock = output::lock(&self.out)?;
        if replacement::is_over(&new, format) {
            replacement::discard(&self.out).map_err(|error| JobError::write(&self.out, error, false))?;
            drop(lock);
            return self.resume_at(&self.out);
        }
        if !has_checkpoint(&new)
            && let Some(sidecar) = self.without_refinement()
        {
            replacement::discard(&self.out).map_err(|error| JobError::write(&self.out, error, false))?;
            drop(lock);
            return self.continue_merged(&sidecar);
        }
        let mut begun = self.resume_at(&new)?;
        if let Begun::Writing(writing) = &mut begun {
            writing.locks.push(lock);
        }
        Ok(begun)
    }

    /// Begins the job at the first point that is not finished in the results at `place`.
    fn resume_at(&'a self, place: &Path) -> Result<Begun<'a>, JobError> {
        let has_journal =
            replacement::has_journal(place).map_err(|error| JobError::write(place, error, false))?;
        let sidecar = Sidecar::read(&sidecar_of(place));
        // If rows were moved elsewhere, their sidecar remains here.
        let is_alone = place == self.out && !place.exists();
        if let Ok(sidecar) = &sidecar
            && sidecar.state == State::Complete
            && !is_alone
        {
            if !has_journal && place == self.out && self.lacks_refinement(sidecar) {
                return self.continue_merged(sidecar);
            }
            return self.end_complete(place, sidecar, has_journal);
        }
        if !has_journal {
            return match sidecar {
                _ if disk::is_empty(place) => self.start(),
                Err(error @ SidecarError::Damaged { .. }) => Err(JobError::Open(error.into())),
                Err(_) => {
                    Err(JobError::Exists { path: place.to_owned(), changes: Vec::new(), changed: None })
                }
                _ => Err(self.cannot_resume(place, ResumeError::NoJournal(place.to_owned()))),
            };
        }
        let resumed = Session::resume(place, self.plan, &self.options)
            .map_err(|error| self.cannot_resume(place, error))?;
        let Resumed { session, before, started, lost, lock } = resumed;
        let sidecar = self.sidecar(started);
        write_sidecar(place, &sidecar, false)?;
        let target = Target::Session(Box::new(session), Box::new(sidecar));
        let locks = vec![lock];
        Ok(self.writing(target, before, Some(lost), locks))
    }

    /// Ends a job whose results at `place` are already complete.
    ///
    /// If `has_journal` is true, a run was killed after its last row, but before it removed its journal. With
    /// a journal, the function gives the results their final name if necessary, and then removes the journal.
    /// If `has_journal` is false, the function does not change the results.
    fn end_complete<'b>(
        &self,
        place: &Path,
        sidecar: &Sidecar,
        has_journal: bool,
    ) -> Result<Begun<'b>, JobError> {
        // The rows of a replacement may already have their final name.
        let rows = if place.exists() { place } else { &self.out };
        if !has_journal {
            output::remove_unused_locks(&self.out);
            return self.complete_if_same_rows(rows, sidecar);
        }
        let _lock = output::lock(place)?;
        let outcome = self.complete_if_same_rows(rows, sidecar)?;
        self.complete(place)?;
        Ok(outcome)
    }

    /// Ends the job if the complete results at `rows` contain the rows of this job and are undamaged. If the
    /// results contain different rows or are damaged, the function returns an error.
    fn complete_if_same_rows<'b>(&self, rows: &Path, sidecar: &Sidecar) -> Result<Begun<'b>, JobError> {
        let changes = sidecar.identity.differences(&self.identity());
        if !changes.is_empty() {
            let changed = self.changed_line(sidecar);
            return Err(JobError::Exists { path: self.out.clone(), changes, changed });
        }
        let format = Format::of(rows)?;
        integrity::check(rows, format, sidecar, OnDamage::Refuse).map_err(JobError::Open)?;
        let all_periodic = sidecar.summary.as_ref().is_some_and(Summary::all_periodic);
        Ok(Begun::Complete { all_periodic })
    }

    /// Returns true if the grid has a `[refine]` table, but the complete results contain only the points of
    /// the axes.
    ///
    /// Merged shards lack the points that a refinement adds, because a shard contains only points of the
    /// axes.
    fn lacks_refinement(&self, sidecar: &Sidecar) -> bool {
        let is_refined = sidecar.summary.as_ref().is_some_and(|summary| summary.refined.is_some());
        self.plan.refine().is_some() && *self.plan.selection() == Selection::All && !is_refined
    }

    /// Returns the sidecar of the results if the results are complete, but lack the points that the
    /// refinement adds.
    fn without_refinement(&self) -> Option<Sidecar> {
        let sidecar = Sidecar::read(&sidecar_of(&self.out)).ok()?;
        (sidecar.state == State::Complete && self.lacks_refinement(&sidecar)).then_some(sidecar)
    }

    /// Begins the job at the first point that the refinement adds. The complete results already contain the
    /// points of the axes.
    ///
    /// The function copies the rows of the results into a new file. When the new file is complete, the new
    /// file replaces the results.
    fn continue_merged(&'a self, sidecar: &Sidecar) -> Result<Begun<'a>, JobError> {
        self.complete_if_same_rows(&self.out, sidecar)?;
        let format = Format::of(&self.out)?;
        let mut locks = vec![output::lock(&self.out)?];
        let mut target = self.start_beside(format, &mut locks)?;
        let before = sidecar.summary.clone().unwrap_or_default();
        if let Target::Session(session, _) = &mut target {
            let taken = session.take_over(&self.out, &before, sidecar.seconds.unwrap_or_default());
            taken.map_err(|error| JobError::write(session.path(), error, true))?;
        }
        Ok(self.writing(target, before, Some(0), locks))
    }

    /// Returns the identity of the job's rows: the build and the settings that determine the rows.
    fn identity(&self) -> Identity {
        Identity::of(self.plan, &self.options.run)
    }

    /// Converts `error` into a [`JobError::Resume`] that describes the first changed line of the grid file.
    fn cannot_resume(&self, place: &Path, error: ResumeError) -> JobError {
        let sidecar = Sidecar::read(&sidecar_of(place)).ok();
        let before = sidecar.as_ref().filter(|_| matches!(error, ResumeError::Changed { .. }));
        let changed = before.and_then(|before| self.changed_line(before));
        let past = journal::read(&journal_of(place)).ok().flatten().map(|past| past.header.identity);
        // This build on this machine can continue the sweep of the unfinished results from their sidecar.
        let continues = past == sidecar.map(|sidecar| sidecar.identity)
            && past.is_some_and(|past| past.is_by_program_of(&self.identity()));
        JobError::Resume { error, changed, continues }
    }

    /// Describes the first line in which the grid file or a device differs from its copy in the sidecar
    /// `before`.
    fn changed_line(&self, before: &Sidecar) -> Option<String> {
        let of_devices = before.devices.iter().zip(self.plan.devices());
        let mut of_devices = of_devices.map(|(before, now)| difference(&before.text, &now.text, &now.name));
        let of_grid = difference(&before.grid.text, &self.plan.source().text, "the grid");
        of_grid.or_else(|| of_devices.find_map(|difference| difference))
    }
}

/// Returns true if the journal of the results at `place` has a checkpoint.
fn has_checkpoint(place: &Path) -> bool {
    let past = journal::read(&journal_of(place)).ok().flatten();
    past.is_some_and(|past| !past.checkpoints.is_empty())
}

/// Describes the first line in which two versions of the file `name` differ.
fn difference(before: &str, now: &str, name: &str) -> Option<String> {
    let (before, now): (Vec<&str>, Vec<&str>) = (before.lines().collect(), now.lines().collect());
    let line = (0..before.len().max(now.len())).find(|&line| before.get(line) != now.get(line))?;
    let shown = |lines: &[&str]| lines.get(line).map_or("not there".to_owned(), |text| format!("`{text}`"));
    Some(format!("line {} of {name} was {}, it is {}", line + 1, shown(&before), shown(&now)))
}
