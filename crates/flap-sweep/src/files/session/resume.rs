//! A session that continues an interrupted one.

use std::fs::File;
use std::io::{self, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use super::{Session, SessionOptions};
use crate::files::beside::{journal_of, rows_of};
use crate::files::disk;
use crate::files::journal::{self, Intact, Journal, last_intact};
use crate::files::output::{self, CreateError, Output};
use crate::files::results::{Format, FormatError, TextRows, text_sum};
use crate::plan::Plan;
use crate::run::Summary;
use crate::run::identity::Identity;

/// A session that continues the work of earlier ones.
pub struct Resumed {
    /// The session.
    pub session: Session,
    /// Summary of the earlier sessions.
    pub before: Summary,
    /// Start of the first session, as RFC 3339 in UTC.
    pub started: String,
    /// Number of rows that had been written but are no longer in the file.
    pub lost: u64,
    /// Reason why the results could not be locked.
    pub unlocked: Option<io::Error>,
}

/// A run that cannot be resumed.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The results cannot be written.
    #[error(transparent)]
    Create(#[from] CreateError),
    /// The name stands for no format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// There is nothing to resume.
    #[error("{} has no journal: it is not the result of an interrupted sweep", .0.display())]
    NoJournal(PathBuf),
    /// The remaining rows would differ from those of the earlier run.
    #[error("{} cannot be resumed: {}", path.display(), changes.join("; "))]
    Changed {
        /// The results.
        path: PathBuf,
        /// The differences, in words.
        changes: Vec<String>,
    },
    /// Another program has written to the results.
    #[error("{} cannot be resumed: it has changed since the sweep wrote it", .0.display())]
    Altered(PathBuf),
}

impl Session {
    /// Continues the results at `path`.
    ///
    /// # Errors
    /// - [`ResumeError::Format`] if the name stands for no format
    /// - [`ResumeError::Create`] if a file cannot be opened
    /// - [`ResumeError::NoJournal`] if there is no journal
    /// - [`ResumeError::Changed`] if the journal is of other rows
    /// - [`ResumeError::Altered`] if the results have changed since they were written
    pub fn resume(path: &Path, plan: &Plan, options: &SessionOptions) -> Result<Resumed, ResumeError> {
        let refused = |source| CreateError::Io { path: path.to_owned(), source };
        let format = Format::of(path)?;
        let Output { file: results, unlocked } = output::reopen(path)?;
        let journal_path = journal_of(path);
        let past = journal::read(&journal_path).map_err(refused)?;
        let past = past.ok_or_else(|| ResumeError::NoJournal(path.to_owned()))?;
        let changes = past.header.identity.differences(&Identity::of(plan, &options.run));
        if !changes.is_empty() {
            return Err(ResumeError::Changed { path: path.to_owned(), changes });
        }

        let rows_path = rows_of(path, format);
        let rows_file =
            if format.is_columnar() { disk::open_or_create(&rows_path) } else { results.try_clone() };
        let rows_file = rows_file.map_err(refused)?;
        let found = last_intact(&rows_file, &past).map_err(refused)?;
        let found = found.ok_or_else(|| ResumeError::Altered(rows_path.clone()))?;
        let Intact { checkpoint, journal_bytes, hash, lost } = found;
        let cut = |mut file: &File| {
            file.set_len(checkpoint.bytes)?;
            file.seek(SeekFrom::Start(checkpoint.bytes))
        };
        cut(&rows_file).map_err(refused)?;
        let journal = Journal::after(&journal_path, journal_bytes).map_err(refused)?;
        // Computed anew from all rows, checksums are those of a run that was not interrupted.
        let (text, summed) = text_sum(File::open(&rows_path).map_err(refused)?, format);
        summed.map_err(refused)?;
        let rows = TextRows::after(rows_file, format, (hash, checkpoint.bytes), text).map_err(refused)?;
        let mut session = Session::new(results, (path, format), rows, plan, options, journal);
        session.add_seconds(checkpoint.seconds);
        Ok(Resumed { session, before: checkpoint.summary(), started: past.header.started, lost, unlocked })
    }
}
