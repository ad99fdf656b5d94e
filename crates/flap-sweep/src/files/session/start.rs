//! The start of a new session.

use std::fs::File;
use std::io;
use std::path::Path;

use super::{Session, SessionOptions};
use crate::files::beside::{journal_of, rows_of};
use crate::files::journal::{Header, Journal};
use crate::files::results::{Format, TextRows};
use crate::files::{disk, output};
use crate::plan::Plan;
use crate::run::identity::Identity;

impl Session {
    /// Begins to write to `results`, which [`output::create`] opened at `path`, and empties it. The journal records the time
    /// `started`, and in `replaces` that earlier results are kept until these are complete.
    ///
    /// # Errors
    /// The error of the operating system if a file cannot be written.
    pub fn start(
        results: File,
        (path, format): (&Path, Format),
        plan: &Plan,
        options: &SessionOptions,
        (started, replaces): (String, bool),
    ) -> io::Result<Session> {
        // An old journal must not outlive the rows that it counts.
        output::forget(path)?;
        disk::empty(&results)?;
        let mut header = Header::new(started, Identity::of(plan, &options.run));
        header.replaces = replaces;
        let journal = Journal::create(&journal_of(path), &header)?;
        let rows_file =
            if format.is_columnar() { File::create(rows_of(path, format))? } else { results.try_clone()? };
        disk::sync_folder(path);
        let rows = TextRows::new(rows_file, format)?;
        Ok(Session::new(results, (path, format), rows, plan, options, journal))
    }
}
