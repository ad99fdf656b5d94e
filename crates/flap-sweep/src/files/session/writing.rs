//! Rows into a result file, with checkpoints in the journal beside it.

use std::fs::File;
use std::io::{self, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::assemble::assemble;
use crate::files::beside::rows_of;
use crate::files::disk;
use crate::files::journal::{Checkpoint, Journal};
use crate::files::results::{Checksums, FileSum, Format, Provenance, TextRows};
use crate::plan::Plan;
use crate::run::identity::Identity;
use crate::run::sink::Sink;
use crate::run::{RunOptions, Summary};
use crate::table::layout::Cell;

/// Options of a session.
#[derive(Clone, Copy, Debug)]
pub struct SessionOptions {
    /// Options of the run.
    pub run: RunOptions,
    /// Time between checkpoints, each of which waits for the disk twice. A run that is killed loses the rows of this time.
    pub checkpoint: Duration,
}

/// Writes the rows of a plan to a file such that the run can be resumed.
pub struct Session {
    path: PathBuf,
    format: Format,
    /// Locked for as long as the session lasts.
    results: File,
    rows: TextRows,
    provenance: Provenance,
    /// Checksum of a Parquet file, once rows have been turned into columns.
    columns: Option<FileSum>,
    journal: Journal,
    checkpoint: Duration,
    last_checkpoint: Instant,
    began: Instant,
    seconds_before: f64,
}

impl Session {
    /// A session that writes `rows` for the results at `path`, and their checkpoints to `journal`.
    pub(super) fn new(
        results: File,
        (path, format): (&Path, Format),
        rows: TextRows,
        plan: &Plan,
        options: &SessionOptions,
        journal: Journal,
    ) -> Session {
        let now = Instant::now();
        Session {
            path: path.to_owned(),
            format,
            results,
            rows,
            provenance: Provenance::of(plan, &Identity::of(plan, &options.run)),
            columns: None,
            journal,
            checkpoint: options.checkpoint,
            last_checkpoint: now,
            began: now,
            seconds_before: 0.0,
        }
    }

    /// Adds the running time of earlier sessions.
    pub(super) fn add_seconds(&mut self, seconds: f64) {
        self.seconds_before += seconds;
    }

    /// Running time so far of all sessions (s).
    pub fn seconds(&self) -> f64 {
        self.seconds_before + self.began.elapsed().as_secs_f64()
    }

    /// The file that holds the rows until they are complete: not the results themselves for a Parquet file.
    pub fn rows_path(&self) -> PathBuf {
        rows_of(&self.path, self.format)
    }

    /// Adds the last checkpoint, after [`Sink::finish`]; completes the results if the run came to its end.
    ///
    /// # Errors
    /// - [`io::ErrorKind::Other`] if a file was removed or replaced
    /// - the error of the operating system if a file cannot be written
    pub fn close(&mut self, summary: &Summary) -> io::Result<()> {
        if !summary.interrupted || self.rows.may_be_cut() {
            self.note(summary)?;
        }
        if !summary.interrupted && self.format.is_columnar() {
            disk::empty(&self.results)?;
            self.results.seek(SeekFrom::Start(0))?;
            let results = self.results.try_clone()?;
            let text = self.checksums().text;
            self.columns = assemble(&self.rows_path(), results, &self.provenance, &text)?.file;
        }
        Ok(())
    }

    /// The checksums of complete results.
    pub fn checksums(&self) -> Checksums {
        self.rows.checksums(self.columns.clone())
    }

    /// The results.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Makes the rows durable, then adds a checkpoint behind them.
    fn note(&mut self, so_far: &Summary) -> io::Result<()> {
        self.rows.flush()?;
        disk::check_in_place(&self.results, &self.path)?;
        disk::check_in_place(self.rows.file(), &self.rows_path())?;
        self.rows.file().sync_data()?;
        self.journal.add(&Checkpoint::new(so_far, self.rows.extent(), self.seconds()))?;
        self.last_checkpoint = Instant::now();
        Ok(())
    }
}

impl Sink for Session {
    fn begin(&mut self) -> io::Result<()> {
        let names = self.provenance.columns.iter().map(|column| &column.name);
        if self.rows.extent().bytes == 0 { self.rows.header(names) } else { Ok(()) }
    }

    fn write(&mut self, cells: &[Cell]) -> io::Result<()> {
        self.rows.cells(cells)
    }

    fn done(&mut self, so_far: &Summary) -> io::Result<()> {
        if self.rows.may_be_cut() && self.last_checkpoint.elapsed() >= self.checkpoint {
            self.note(so_far)?;
        }
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.rows.flush()
    }

    fn finish(&mut self) -> io::Result<()> {
        self.rows.finish()?;
        self.rows.file().sync_data()
    }
}
