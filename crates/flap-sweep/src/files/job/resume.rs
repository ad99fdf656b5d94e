//! A job that continues earlier work.

use flap_core::simulate::Status;

use super::{Before, Engine, Job, JobError, Outcome};
use crate::files::beside::sidecar_of;
use crate::files::disk;
use crate::files::integrity::{self, OnDamage};
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
            Err(error @ ResumeError::NoJournal { .. }) => return self.complete(error),
            Err(error) => return Err(self.cannot_resume(error)),
        };
        let Resumed { session, before, started, lost } = resumed;
        tell(Before { lost, done: before.done() });
        let sidecar = self.sidecar(started);
        self.write_sidecar(&sidecar, false)?;
        self.work(session, before, sidecar, engine)
    }

    /// The outcome if there is no journal: the rows wanted are all there, or the `error` is one.
    fn complete(&self, error: ResumeError) -> Result<Outcome, JobError> {
        let sidecar = match Sidecar::read(&sidecar_of(&self.out)) {
            Ok(sidecar) if sidecar.state == State::Complete => sidecar,
            Err(error @ ReadError::Damaged { .. }) => return Err(JobError::Open(error.into())),
            _ => return Err(self.cannot_resume(error)),
        };
        let own = Identity::of(self.plan, &self.options.run);
        let changes = sidecar.identity().differences(&own);
        if !changes.is_empty() {
            return Err(self.cannot_resume(ResumeError::Changed { path: self.out.clone(), changes }));
        }
        let format = Format::of(&self.out)?;
        integrity::check(&self.out, format, &sidecar, OnDamage::Refuse).map_err(JobError::Open)?;
        let periodic = sidecar.statuses.as_ref().and_then(|counts| counts.get(Status::Periodic.name()));
        Ok(Outcome::Complete { all_periodic: periodic == sidecar.rows.as_ref() })
    }

    /// The error, with the first line of the grid file that has changed.
    fn cannot_resume(&self, error: ResumeError) -> JobError {
        let is_changed = matches!(error, ResumeError::Changed { .. });
        let before = Sidecar::read(&sidecar_of(&self.out)).ok().filter(|_| is_changed);
        let changed = before.and_then(|before| difference(&before.grid.text, &self.plan.source().text));
        JobError::Resume { error, changed }
    }
}

/// The first line that differs, in words.
fn difference(before: &str, now: &str) -> Option<String> {
    let (before, now): (Vec<&str>, Vec<&str>) = (before.lines().collect(), now.lines().collect());
    let line = (0..before.len().max(now.len())).find(|&line| before.get(line) != now.get(line))?;
    let shown = |lines: &[&str]| lines.get(line).map_or("not there".to_owned(), |text| format!("`{text}`"));
    Some(format!("line {} of the grid was {}, it is {}", line + 1, shown(&before), shown(&now)))
}
