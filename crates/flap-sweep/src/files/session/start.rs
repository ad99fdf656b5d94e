//! The start of a new session.

use std::fs::File;
use std::io;
use std::path::Path;

use super::{Session, SessionOptions};
use crate::files::beside::{journal_of, rows_of};
use crate::files::disk;
use crate::files::journal::{Header, Journal};
use crate::files::results::{Format, TextRows};
use crate::plan::Plan;
use crate::run::identity::Identity;

impl Session {
    /// Begins to write to `results`, an empty file which [`output::create`](crate::files::output::create) opened at `path`. The
    /// journal records the time `started`, and in `replaces` that the results are to replace earlier ones.
    ///
    /// # Errors
    /// - [`io::ErrorKind::AlreadyExists`] if there is a journal, or a file of waiting rows
    /// - the error of the operating system if a file cannot be written
    pub fn start(
        results: File,
        (path, format): (&Path, Format),
        plan: &Plan,
        options: &SessionOptions,
        (started, replaces): (String, bool),
    ) -> io::Result<Session> {
        let mut header = Header::new(started, Identity::of(plan, &options.run));
        header.replaces = replaces;
        let journal = Journal::create(&journal_of(path), &header)?;
        let rows_file = if format.is_columnar() {
            disk::create_new(&rows_of(path, format))?
        } else {
            results.try_clone()?
        };
        disk::sync_folder(path)?;
        disk::sync_folder(&disk::target(path))?;
        let rows = TextRows::new(rows_file, format)?;
        Ok(Session::new(results, (path, format), rows, plan, options, journal))
    }
}
