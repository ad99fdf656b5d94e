//! Writes the result file of a run. A session writes rows and checkpoints, and can continue the results of an
//! earlier run.
//!
//! A checkpoint is at the end of a row, or in compressed files at the end of a frame. The bytes of the file
//! before a checkpoint do not depend on later rows. A resumed run removes the rows after the last checkpoint,
//! computes these rows again, and writes the same bytes as before.
//!
//! A Parquet file can be neither read nor continued before its last byte is written. The rows of a Parquet
//! file are therefore first written to `<results>.part`, as compressed text like a `.csv.zst` file. When the
//! run is complete, flap converts the rows into the columns of the Parquet file.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::iter;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use csv::StringRecord;

use crate::files::beside::{journal_of, rows_of};
use crate::files::disk;
use crate::files::journal::{self, Checkpoint, Header, IntactRows, Journal, last_intact};
use crate::files::output::{self, CreateError, Lock};
use crate::files::results::{
    Checksums, FileSum, Format, FormatError, Provenance, Reader, TextRows, Writer, text_sum,
};
use crate::plan::Plan;
use crate::run::identity::Identity;
use crate::run::{RunOptions, Sink, Summary, Written};
use crate::table::layout::Cell;

/// Options of a session.
#[derive(Clone, Copy, Debug)]
pub struct SessionOptions {
    /// Options of the run.
    pub run: RunOptions,
    /// Time between checkpoints. For each checkpoint, flap waits until the rows are safe on disk, and then
    /// until the journal is safe on disk. A run that is killed loses the rows since the last checkpoint.
    pub checkpoint_interval: Duration,
}

/// Writes the rows of a plan into a file, with checkpoints from which the run can be resumed.
pub struct Session {
    path: PathBuf,
    format: Format,
    results: File,
    rows: TextRows,
    provenance: Provenance,
    /// Rows of earlier runs: the path of the file with these rows, the format of the file, and the number of
    /// bytes to read.
    earlier: Option<(PathBuf, Format, u64)>,
    /// Checksum of the Parquet file; `None` until the rows have been converted into the Parquet file.
    parquet_sum: Option<FileSum>,
    journal: Journal,
    checkpoint_interval: Duration,
    last_checkpoint: Instant,
    /// Checkpoint at the end of the last frame of a compressed file, if it is not yet in the journal.
    frame_end: Option<Checkpoint>,
    began: Instant,
    seconds_before: f64,
}

/// A session that continues an interrupted sweep.
pub struct Resumed {
    /// The session.
    pub session: Session,
    /// Summary of the rows that earlier sessions of the sweep have written.
    pub before: Summary,
    /// Time at which the sweep was first started, in the format of RFC 3339 and in UTC.
    pub started: String,
    /// Number of rows that earlier runs wrote, but that are missing in the file.
    pub lost: u64,
    /// Lock of the results.
    pub lock: Lock,
}

/// Reason why a run cannot be resumed.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The results cannot be written.
    #[error(transparent)]
    Create(#[from] CreateError),
    /// The file name has no supported ending, such as `.csv`.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The results have no journal.
    #[error("{} has no journal, so this file is not the result of an interrupted sweep", .0.display())]
    NoJournal(PathBuf),
    /// The grid, the settings or the build of flap have changed, so the new rows would not match the earlier
    /// rows.
    #[error("{} cannot be resumed: {}", path.display(), changes.join("; "))]
    Changed {
        /// The results.
        path: PathBuf,
        /// Descriptions of the differences.
        changes: Vec<String>,
    },
    /// Another program has changed the results.
    #[error("{} cannot be resumed: the file has changed since the sweep wrote it", .0.display())]
    Altered(PathBuf),
}

impl Session {
    /// Begins a session that writes to the empty file `results`, which [`output::create`] has opened at
    /// `path`.
    ///
    /// The journal records the start time `started`. If `replaces` is true, the journal also records that the
    /// new results will replace earlier results.
    ///
    /// # Errors
    /// - [`io::ErrorKind::AlreadyExists`] if there is already a journal, or a file `<results>.part` with
    ///   rows.
    /// - The error of the operating system if a file cannot be written.
    pub fn start(
        results: File,
        (path, format): (&Path, Format),
        plan: &Plan,
        options: &SessionOptions,
        started: String,
        replaces: bool,
    ) -> io::Result<Session> {
        let header = Header::new(started, replaces, Identity::of(plan, &options.run));
        let journal = Journal::create(&journal_of(path), &header)?;
        let rows_file = if format.is_columnar() {
            disk::create_new(&rows_of(path, format))?
        } else {
            results.try_clone()?
        };
        disk::sync_folder(path)?;
        let target = disk::target(path);
        if target != path {
            disk::sync_folder(&target)?;
        }
        let rows = TextRows::new(rows_file, format)?;
        Ok(Session::new(results, (path, format), rows, plan, options, journal))
    }

    /// Continues the unfinished results at `path`.
    ///
    /// # Errors
    /// - [`ResumeError::Format`] if the file name has no supported ending, such as `.csv`.
    /// - [`ResumeError::Create`] if a file cannot be opened.
    /// - [`ResumeError::NoJournal`] if there is no journal.
    /// - [`ResumeError::Changed`] if the journal records a different grid, different settings or a different
    ///   build of flap.
    /// - [`ResumeError::Altered`] if the results have changed since flap wrote them.
    pub fn resume(path: &Path, plan: &Plan, options: &SessionOptions) -> Result<Resumed, ResumeError> {
        let refused = |source| CreateError::Io { path: path.to_owned(), source };
        let format = Format::of(path)?;
        let (results, lock) = output::reopen(path)?;
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
        let IntactRows { checkpoint, journal_bytes, hash, lost } = found;
        let bytes = checkpoint.file.bytes;
        let cut = |mut file: &File| {
            file.set_len(bytes)?;
            file.seek(SeekFrom::Start(bytes))
        };
        cut(&rows_file).map_err(refused)?;
        let journal = Journal::after(&journal_path, journal_bytes).map_err(refused)?;
        // Checksums computed from all rows equal the checksums of an uninterrupted run.
        let (text, summed) = text_sum(File::open(&rows_path).map_err(refused)?, format);
        summed.map_err(refused)?;
        let rows = TextRows::after(rows_file, format, (hash, bytes), text).map_err(refused)?;
        let mut session = Session::new(results, (path, format), rows, plan, options, journal);
        session.seconds_before += checkpoint.seconds;
        let text_format = if format.is_columnar() { Format::CsvZstd } else { format };
        session.earlier = Some((rows_path, text_format, bytes));
        Ok(Resumed { session, before: checkpoint.summary, started: past.header.started, lost, lock })
    }

    /// Returns a session for the results at `path`. The session writes rows with the writer `rows`, and
    /// checkpoints into `journal`.
    fn new(
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
            earlier: None,
            parquet_sum: None,
            journal,
            checkpoint_interval: options.checkpoint_interval,
            last_checkpoint: now,
            frame_end: None,
            began: now,
            seconds_before: 0.0,
        }
    }

    /// Copies all rows of the complete results at `path` to the beginning of the new results. The copied rows
    /// must be rows of the same plan. `summary` is the summary of the copied rows.
    ///
    /// # Errors
    /// Returns the error of the operating system if a file cannot be read or written.
    pub(crate) fn take_over(&mut self, path: &Path, summary: &Summary, seconds: f64) -> io::Result<()> {
        let format = Format::of(path).map_err(io::Error::other)?;
        let mut reader = Reader::new(File::open(path)?, format)?;
        self.begin()?;
        let mut row = StringRecord::new();
        while reader.next(&mut row)? {
            self.rows.row(&row)?;
        }
        self.seconds_before += seconds;
        self.earlier = Some((path.to_owned(), format, u64::MAX));
        if self.rows.may_be_cut() { self.write_checkpoint(summary) } else { Ok(()) }
    }

    /// Returns the total running time of the sweep so far in seconds, without the time of interruptions.
    pub fn seconds(&self) -> f64 {
        self.seconds_before + self.began.elapsed().as_secs_f64()
    }

    /// Returns the path of the file into which the session writes rows. For Parquet, this file is
    /// `<results>.part` instead of the result file.
    pub fn rows_path(&self) -> PathBuf {
        rows_of(&self.path, self.format)
    }

    /// Adds the last checkpoint. If a run is interrupted within a frame of a compressed file, the last
    /// checkpoint is at the end of the frame before. If the run is complete and the results are a Parquet
    /// file, the function also writes the Parquet file. Call this function after [`Sink::finish`].
    ///
    /// # Errors
    /// - [`io::ErrorKind::Other`] if a file into which the session writes was removed, replaced or changed.
    /// - The error of the operating system if a file cannot be written.
    pub fn end(&mut self, summary: &Summary) -> io::Result<()> {
        if !summary.is_interrupted() || self.rows.may_be_cut() {
            self.write_checkpoint(summary)?;
        } else if let Some(checkpoint) = self.frame_end.take() {
            self.add(&checkpoint)?;
        }
        if !summary.is_interrupted() && self.format.is_columnar() {
            disk::empty(&self.results)?;
            self.results.seek(SeekFrom::Start(0))?;
            let results = self.results.try_clone()?;
            let text = self.checksums().text;
            self.parquet_sum = assemble(&self.rows_path(), results, &self.provenance, &text)?.file;
        }
        Ok(())
    }

    /// Returns the checksums of complete results.
    pub fn checksums(&self) -> Checksums {
        self.rows.checksums(self.parquet_sum.clone())
    }

    /// Returns the path of the results.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the buffered rows, and adds a checkpoint after them to the journal.
    fn write_checkpoint(&mut self, so_far: &Summary) -> io::Result<()> {
        self.rows.flush()?;
        self.add(&self.checkpoint(so_far))
    }

    /// Returns a checkpoint after the bytes that are written so far.
    fn checkpoint(&self, so_far: &Summary) -> Checkpoint {
        Checkpoint::new(self.seconds(), self.rows.extent(), so_far.clone())
    }

    /// Waits until the written rows are safe on disk (fsync), then adds the checkpoint to the journal.
    fn add(&mut self, checkpoint: &Checkpoint) -> io::Result<()> {
        disk::check_in_place(&self.results, &self.path)?;
        disk::check_in_place(self.rows.file(), &self.rows_path())?;
        self.rows.file().sync_data()?;
        self.journal.add(checkpoint)?;
        self.last_checkpoint = Instant::now();
        self.frame_end = None;
        Ok(())
    }
}

impl Sink for Session {
    fn written(&self) -> io::Result<Written> {
        let Some((path, format, bytes)) = &self.earlier else { return Ok(Box::new(iter::empty())) };
        let file = File::open(path)?;
        let mut reader = match format {
            Format::Parquet => Reader::new(file, *format)?,
            _ => Reader::of_text(file.take(*bytes), *format)?,
        };
        Ok(Box::new(iter::from_fn(move || {
            let mut row = StringRecord::new();
            reader.next(&mut row).map(|found| found.then_some(row)).transpose()
        })))
    }

    fn begin(&mut self) -> io::Result<()> {
        let names = self.provenance.columns.iter().map(|column| &column.name);
        if self.rows.extent().bytes == 0 { self.rows.header(names) } else { Ok(()) }
    }

    fn write(&mut self, cells: &[Cell]) -> io::Result<()> {
        self.rows.cells(cells)
    }

    fn after_point(&mut self, so_far: &Summary) -> io::Result<()> {
        if !self.rows.may_be_cut() {
            return Ok(());
        }
        if self.last_checkpoint.elapsed() >= self.checkpoint_interval {
            return self.write_checkpoint(so_far);
        }
        if self.rows.is_compressed() {
            self.frame_end = Some(self.checkpoint(so_far));
        }
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.rows.flush()
    }

    fn finish(&mut self) -> io::Result<()> {
        self.rows.finish()
    }
}

/// Converts the rows of the text file `part` into the empty Parquet file `results`, and returns the checksums
/// of `results`.
///
/// # Errors
/// - [`io::ErrorKind::Other`] if the rows do not have the checksum `text`.
/// - The error of the operating system if a file cannot be read or written.
fn assemble(part: &Path, results: File, provenance: &Provenance, text: &str) -> io::Result<Checksums> {
    let mut rows = Reader::new(File::open(part)?, Format::CsvZstd)?;
    let mut writer = Writer::new(results, Format::Parquet, provenance)?;
    let mut row = StringRecord::new();
    while rows.next(&mut row)? {
        writer.row(&row)?;
    }
    let checksums = writer.finish()?;
    if checksums.text != text {
        return Err(io::Error::other(format!(
            "the rows in {} have changed since they were written",
            part.display()
        )));
    }
    Ok(checksums)
}
