//! A job that continues earlier work.

use flap_core::simulate::Status;

use super::{Before, Engine, Job, JobError, Outcome};
use crate::files::beside::{journal_of, sidecar_of};
use crate::files::disk;
use crate::files::integrity::{self, OnDamage};
use crate::files::journal;
use crate::files::results::Format;
use crate::files::session::{ResumeError, Resumed, Session};
use crate::files::sidecar::{ReadError, Sidecar, State};
use crate::run::identity::Identity;

impl Job<'_> {
    /// Runs the points that are not done yet.
    pub(super) fn resume(
        &self,
        engine: Engine<'_>,
        tell: &mut dyn FnMut(Before),
    ) -> Result<Outcome, JobError> {
        let resumed = match Session::resume(&self.out, self.plan, &self.options) {
            Ok(resumed) => resumed,
            Err(ResumeError::NoJournal { .. }) if disk::is_empty(&self.out) => return self.start(engine),
            Err(error @ ResumeError::NoJournal { .. }) => return self.without_journal(error),
            Err(error) => return Err(self.cannot_resume(error)),
        };
        let Resumed { session, before, started, lost } = resumed;
        tell(Before { lost, done: before.done() });
        let sidecar = self.sidecar(started);
        self.write_sidecar(&sidecar, false)?;
        self.work(session, before, sidecar, engine)
    }

    /// The outcome if there is no journal: the rows wanted are all there, or the `error` is one.
    fn without_journal(&self, error: ResumeError) -> Result<Outcome, JobError> {
        match Sidecar::read(&sidecar_of(&self.out)) {
            Ok(sidecar) if sidecar.state == State::Complete => self.compared(&sidecar),
            Err(error @ ReadError::Damaged { .. }) => Err(JobError::Open(error.into())),
            _ => Err(self.cannot_resume(error)),
        }
    }

    /// The outcome if a file has the name of the results: it holds the rows wanted, or it is in the way.
    pub(super) fn existing(&self) -> Result<Outcome, JobError> {
        match Sidecar::read(&sidecar_of(&self.out)) {
            Ok(sidecar) if sidecar.state == State::Complete => self.compared(&sidecar),
            _ => Err(JobError::Exists { path: self.out.clone(), changes: Vec::new(), changed: None }),
        }
    }

    /// The outcome if complete results with this sidecar have the name of the results.
    fn compared(&self, sidecar: &Sidecar) -> Result<Outcome, JobError> {
        let changes = sidecar.identity().differences(&self.identity());
        if !changes.is_empty() {
            let changed = self.changed_line(sidecar);
            return Err(JobError::Exists { path: self.out.clone(), changes, changed });
        }
        self.complete(sidecar)
    }

    /// The error if unfinished results have the name of the results.
    pub(super) fn unfinished(&self) -> JobError {
        let path = self.out.clone();
        let past = journal::read(&journal_of(&path)).ok().flatten();
        let changes = past.map(|past| past.header.identity.differences(&self.identity())).unwrap_or_default();
        let changed = self.changed_since(!changes.is_empty());
        JobError::Unfinished { path, changes, changed, continues: self.continues() }
    }

    /// True if the sweep that began the unfinished results can be continued from their sidecar, by this build on this machine.
    fn continues(&self) -> bool {
        let own = self.identity();
        let past = journal::read(&journal_of(&self.out)).ok().flatten().map(|past| past.header.identity);
        let sidecar = Sidecar::read(&sidecar_of(&self.out)).ok().map(|sidecar| sidecar.identity());
        past == sidecar && past.is_some_and(|past| past.is_by_program_of(&own))
    }

    /// The identity of the rows of the job.
    fn identity(&self) -> Identity {
        Identity::of(self.plan, &self.options.run)
    }

    /// The outcome if the results hold the rows wanted, and are sound.
    fn complete(&self, sidecar: &Sidecar) -> Result<Outcome, JobError> {
        let format = Format::of(&self.out)?;
        integrity::check(&self.out, format, sidecar, OnDamage::Refuse).map_err(JobError::Open)?;
        let periodic = sidecar.statuses.as_ref().and_then(|counts| counts.get(Status::Periodic.name()));
        Ok(Outcome::Complete { all_periodic: periodic == sidecar.rows.as_ref() })
    }

    /// The error, with the first line of the grid file that has changed.
    fn cannot_resume(&self, error: ResumeError) -> JobError {
        let changed = self.changed_since(matches!(error, ResumeError::Changed { .. }));
        JobError::Resume { error, changed, continues: self.continues() }
    }

    /// The first line of the grid file that has changed since the results were begun, in words; `None` unless they are
    /// `other` rows.
    fn changed_since(&self, other: bool) -> Option<String> {
        let before = Sidecar::read(&sidecar_of(&self.out)).ok().filter(|_| other)?;
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

/// The first line of the file called `name` that differs, in words.
fn difference(before: &str, now: &str, name: &str) -> Option<String> {
    let (before, now): (Vec<&str>, Vec<&str>) = (before.lines().collect(), now.lines().collect());
    let line = (0..before.len().max(now.len())).find(|&line| before.get(line) != now.get(line))?;
    let shown = |lines: &[&str]| lines.get(line).map_or("not there".to_owned(), |text| format!("`{text}`"));
    Some(format!("line {} of {name} was {}, it is {}", line + 1, shown(&before), shown(&now)))
}
