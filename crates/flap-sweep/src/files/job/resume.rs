//! A job that continues earlier work.

use std::path::Path;

use flap_core::simulate::Status;

use super::run::write_sidecar;
use super::{Engine, Job, JobError, Notice, Outcome};
use crate::files::beside::{journal_of, sidecar_of};
use crate::files::integrity::{self, OnDamage};
use crate::files::journal;
use crate::files::results::Format;
use crate::files::session::{ResumeError, Resumed, Session};
use crate::files::sidecar::{ReadError, Sidecar, State};
use crate::files::{companions, disk, output, replacement};
use crate::run::identity::Identity;

impl Job<'_> {
    /// Runs the points that are not done yet.
    pub(super) fn resume(
        &self,
        engine: Engine<'_>,
        tell: &mut dyn FnMut(Notice),
    ) -> Result<Outcome, JobError> {
        let format = Format::of(&self.out)?;
        let Some(new) = replacement::unfinished(&self.out) else {
            return self.resume_at(&self.out, engine, tell);
        };
        // Locked until the end of the job.
        let held = output::hold(&self.out)?;
        if replacement::is_over(&new, format) {
            replacement::discard(&self.out).map_err(|error| JobError::write(&self.out, error, false))?;
            drop(held);
            return self.resume_at(&self.out, engine, tell);
        }
        self.resume_at(&new, engine, tell)
    }

    /// Runs the points that are not done yet of the results at `place`.
    fn resume_at(
        &self,
        place: &Path,
        engine: Engine<'_>,
        tell: &mut dyn FnMut(Notice),
    ) -> Result<Outcome, JobError> {
        let has_journal =
            companions::has_journal(place).map_err(|error| JobError::write(place, error, false))?;
        let sidecar = Sidecar::read(&sidecar_of(place));
        // Rows that were moved away leave a sidecar in the way of others.
        let is_alone = place == self.out && !place.exists();
        if let Ok(sidecar) = &sidecar
            && sidecar.state == State::Complete
            && !is_alone
        {
            return self.is_complete(place, sidecar, has_journal);
        }
        if !has_journal {
            return match sidecar {
                _ if disk::is_empty(place) => self.start(engine, tell),
                Err(error @ ReadError::Damaged { .. }) => Err(JobError::Open(error.into())),
                Err(_) => self.existing(),
                _ => Err(self.cannot_resume(place, ResumeError::NoJournal(place.to_owned()))),
            };
        }
        let resumed = Session::resume(place, self.plan, &self.options)
            .map_err(|error| self.cannot_resume(place, error))?;
        let Resumed { session, before, started, lost, unlocked } = resumed;
        unlocked.map(Notice::Unlocked).into_iter().for_each(&mut *tell);
        tell(Notice::Continued { lost, done: before.done() });
        let sidecar = self.sidecar(started);
        write_sidecar(place, &sidecar, false)?;
        self.work(session, before, sidecar, engine)
    }

    /// The outcome if the sidecar of the results at `place` calls them complete. Only a run that was killed at its very end
    /// `has_journal` left: its last steps are repeated, and nothing is written otherwise.
    fn is_complete(&self, place: &Path, sidecar: &Sidecar, has_journal: bool) -> Result<Outcome, JobError> {
        // The rows of a replacement may have their name already.
        let rows = if place.exists() { place } else { &self.out };
        if !has_journal {
            return self.compared(rows, sidecar);
        }
        // The earlier results of a replacement are locked already.
        let _held = if place == self.out { output::hold(place)? } else { None };
        let outcome = self.compared(rows, sidecar)?;
        self.complete(place)?;
        Ok(outcome)
    }

    /// The outcome if a file has the name of the results: it holds the rows wanted, or it is in the way.
    pub(super) fn existing(&self) -> Result<Outcome, JobError> {
        match Sidecar::read(&sidecar_of(&self.out)) {
            Ok(sidecar) if sidecar.state == State::Complete => self.compared(&self.out, &sidecar),
            _ => Err(JobError::Exists { path: self.out.clone(), changes: Vec::new(), changed: None }),
        }
    }

    /// The outcome if complete results at `rows` have this sidecar: they are the rows wanted, and sound, or in the way.
    fn compared(&self, rows: &Path, sidecar: &Sidecar) -> Result<Outcome, JobError> {
        let changes = sidecar.identity().differences(&self.identity());
        if !changes.is_empty() {
            let changed = self.changed_line(sidecar);
            return Err(JobError::Exists { path: self.out.clone(), changes, changed });
        }
        sound(rows, sidecar)
    }

    /// The error if unfinished results, or an unfinished replacement, have the name of the results.
    pub(super) fn unfinished(&self) -> JobError {
        let place = replacement::to_resume(&self.out);
        let past = journal::read(&journal_of(&place)).ok().flatten();
        let changes = past.map(|past| past.header.identity.differences(&self.identity())).unwrap_or_default();
        let changed = self.changed_since(&place, !changes.is_empty());
        let continues = self.continues(&place);
        JobError::Unfinished { path: self.out.clone(), changes, changed, continues }
    }

    /// True if the sweep that began the unfinished results at `place` can be continued from their sidecar, by this build on
    /// this machine.
    fn continues(&self, place: &Path) -> bool {
        let own = self.identity();
        let past = journal::read(&journal_of(place)).ok().flatten().map(|past| past.header.identity);
        let sidecar = Sidecar::read(&sidecar_of(place)).ok().map(|sidecar| sidecar.identity());
        past == sidecar && past.is_some_and(|past| past.is_by_program_of(&own))
    }

    /// The identity of the rows of the job.
    fn identity(&self) -> Identity {
        Identity::of(self.plan, &self.options.run)
    }

    /// The error, with the first line of the grid file that has changed.
    fn cannot_resume(&self, place: &Path, error: ResumeError) -> JobError {
        let changed = self.changed_since(place, matches!(error, ResumeError::Changed { .. }));
        JobError::Resume { error, changed, continues: self.continues(place) }
    }

    /// The first line of the grid file that has changed since the results at `place` were begun, in words; `None` unless they
    /// are `other` rows.
    fn changed_since(&self, place: &Path, other: bool) -> Option<String> {
        let before = Sidecar::read(&sidecar_of(place)).ok().filter(|_| other)?;
        self.changed_line(&before)
    }

    /// The first line of the grid file that has changed since the rows of a sidecar were begun, in words.
    fn changed_line(&self, before: &Sidecar) -> Option<String> {
        let of_devices = before.devices.iter().zip(self.plan.devices());
        let mut of_devices = of_devices.map(|(before, now)| difference(&before.text, &now.text, &now.name));
        let of_grid = difference(&before.grid.text, &self.plan.source().text, "the grid");
        of_grid.or_else(|| of_devices.find_map(|difference| difference))
    }
}

/// The outcome if the results at `rows` hold the rows wanted, and are sound.
fn sound(rows: &Path, sidecar: &Sidecar) -> Result<Outcome, JobError> {
    let format = Format::of(rows)?;
    integrity::check(rows, format, sidecar, OnDamage::Refuse).map_err(JobError::Open)?;
    let periodic = sidecar.statuses.as_ref().and_then(|counts| counts.get(Status::Periodic.name()));
    Ok(Outcome::Complete { all_periodic: periodic == sidecar.rows.as_ref() })
}

/// The first line of the file called `name` that differs, in words.
fn difference(before: &str, now: &str, name: &str) -> Option<String> {
    let (before, now): (Vec<&str>, Vec<&str>) = (before.lines().collect(), now.lines().collect());
    let line = (0..before.len().max(now.len())).find(|&line| before.get(line) != now.get(line))?;
    let shown = |lines: &[&str]| lines.get(line).map_or("not there".to_owned(), |text| format!("`{text}`"));
    Some(format!("line {} of {name} was {}, it is {}", line + 1, shown(&before), shown(&now)))
}
