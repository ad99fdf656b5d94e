//! A run's hold on its result file: rows into it, checkpoints beside it, and going on where an earlier run ended.
//!
//! Rows are cut into checkpoints at places where the bytes so far do not depend on what comes after: after any row, or in
//! compressed files at the end of a frame. A run that is resumed drops what was written behind the last checkpoint and
//! computes it again, to the same bytes.
//!
//! A Parquet file cannot be read, nor gone on with, before its last byte is written. Its rows wait in
//! `<results>.part`, compressed text like that of a `.csv.zst` file, and are turned into columns when all are there.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::files::integrity::{Intact, last_intact};
use crate::files::journal::{self, Checkpoint, Header, Journal};
use crate::files::output::{self, CreateError};
use crate::files::results::{
    Checksums, ConvertError, FileSum, Format, FormatError, Provenance, Reader, TextRows, convert, text,
};
use crate::plan::Plan;
use crate::run::identity::Identity;
use crate::run::sink::Sink;
use crate::run::{RunOptions, Summary};
use crate::table::layout::Layout;
use flap_core::simulate::{Point, Row};

/// What a session needs to know besides the plan.
#[derive(Clone, Copy, Debug)]
pub struct SessionOptions {
    /// How the plan is run.
    pub run: RunOptions,
    /// Time between checkpoints, each of which waits for the disk twice. A killed run loses the rows of this time.
    pub checkpoint: Duration,
}

/// Writes the rows of a plan to a file such that the run can be resumed.
pub struct Session {
    path: PathBuf,
    format: Format,
    /// Locked for as long as the session lasts.
    results: File,
    rows: TextRows,
    layout: Layout,
    provenance: Provenance,
    /// The results, once rows have been turned into columns.
    columns: Option<FileSum>,
    journal: Journal,
    checkpoint: Duration,
    last_checkpoint: Instant,
    began: Instant,
    seconds_before: f64,
}

/// A session that goes on with the work of earlier ones.
pub struct Resumed {
    /// The session.
    pub session: Session,
    /// What the earlier ones came to.
    pub before: Summary,
    /// When the first one started, as RFC 3339 in UTC.
    pub started: String,
    /// Rows that had been written but are no longer there.
    pub lost: u64,
}

/// Why a run cannot be resumed.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The results cannot be written.
    #[error(transparent)]
    Create(#[from] CreateError),
    /// The name stands for no format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// There is nothing to resume.
    #[error("{} has no journal: it is not the result of an interrupted sweep", path.display())]
    NoJournal {
        /// The results.
        path: PathBuf,
    },
    /// The rows to come would not belong to those that are there.
    #[error("{} cannot be resumed: {}", path.display(), changes.join("; "))]
    Changed {
        /// The results.
        path: PathBuf,
        /// What has changed.
        changes: Vec<String>,
    },
    /// Somebody has written to the results.
    #[error("{} cannot be resumed: it is not as the sweep left it", path.display())]
    Altered {
        /// The file with the rows.
        path: PathBuf,
    },
}

impl Session {
    /// Begins to write to `results`, which [`output::create`] opened at `path`. Drops what it holds. The journal notes when
    /// the run started, and whether earlier results wait beside it.
    ///
    /// # Errors
    /// What writing says.
    pub fn start(
        results: File,
        (path, format): (&Path, Format),
        plan: &Plan,
        options: &SessionOptions,
        (started, replaces): (String, bool),
    ) -> io::Result<Session> {
        let journal_path = journal::path_of(path);
        // An old journal must not outlive the rows it tells of.
        forget(path)?;
        output::empty(&results)?;
        let mut header = Header::new(started, Identity::of(plan, &options.run));
        header.replaces = replaces;
        let journal = Journal::create(&journal_path, &header)?;
        let rows_file = match format {
            Format::Parquet => File::create(part_of(path))?,
            Format::Csv | Format::CsvZstd => results.try_clone()?,
        };
        sync_folder(path);
        let rows = TextRows::new(rows_file, format)?;
        Ok(Session::new(results, (path, format), rows, plan, options, journal))
    }

    /// Goes on with the results at `path`.
    ///
    /// # Errors
    /// If there is no journal, it is of other rows, the results were changed, or they cannot be opened.
    pub fn resume(path: &Path, plan: &Plan, options: &SessionOptions) -> Result<Resumed, ResumeError> {
        let refused = |source| CreateError::Io { path: path.to_owned(), source };
        let format = Format::of(path)?;
        let results = output::reopen(path)?;
        let journal_path = journal::path_of(path);
        let past = journal::read(&journal_path).map_err(refused)?;
        let past = past.ok_or_else(|| ResumeError::NoJournal { path: path.to_owned() })?;
        let changes = past.header.identity.differences(&Identity::of(plan, &options.run));
        if !changes.is_empty() {
            return Err(ResumeError::Changed { path: path.to_owned(), changes });
        }

        let (rows_path, rows_file) = match format {
            Format::Parquet => (part_of(path), open(&part_of(path)).map_err(refused)?),
            Format::Csv | Format::CsvZstd => (path.to_owned(), results.try_clone().map_err(refused)?),
        };
        let found = last_intact(&rows_file, &past).map_err(refused)?;
        let found = found.ok_or_else(|| ResumeError::Altered { path: rows_path.clone() })?;
        let Intact { checkpoint, journal_bytes, hash, lost } = found;
        let cut = |mut file: &File| {
            file.set_len(checkpoint.bytes)?;
            file.seek(SeekFrom::Start(checkpoint.bytes))
        };
        cut(&rows_file).map_err(refused)?;
        let journal = Journal::after(&journal_path, journal_bytes).map_err(refused)?;
        // Summed up anew, checksums are those of a run that was not interrupted.
        let (text, summed) = text::sum_up(File::open(&rows_path).map_err(refused)?, format);
        summed.map_err(refused)?;
        let rows = TextRows::after(rows_file, format, (hash, checkpoint.bytes), text).map_err(refused)?;
        let mut session = Session::new(results, (path, format), rows, plan, options, journal);
        session.seconds_before = checkpoint.seconds;
        Ok(Resumed { session, before: checkpoint.summary(), started: past.header.started, lost })
    }

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
            layout: Layout::of(plan),
            provenance: Provenance::of(plan, &Identity::of(plan, &options.run)),
            columns: None,
            journal,
            checkpoint: options.checkpoint,
            last_checkpoint: now,
            began: now,
            seconds_before: 0.0,
        }
    }

    /// Seconds of running so far, in all sessions.
    pub fn seconds(&self) -> f64 {
        self.seconds_before + self.began.elapsed().as_secs_f64()
    }

    /// Where the rows are: not in the results themselves before a Parquet file is complete.
    pub fn rows_path(&self, complete: bool) -> PathBuf {
        if self.format == Format::Parquet && !complete { part_of(&self.path) } else { self.path.clone() }
    }

    /// Notes what the run came to, after [`Sink::finish`]; completes the results if it came to its end.
    ///
    /// # Errors
    /// What writing says.
    pub fn close(&mut self, summary: &Summary) -> io::Result<()> {
        if !summary.interrupted || self.rows.may_be_cut() {
            self.note(summary)?;
        }
        if !summary.interrupted && self.format == Format::Parquet {
            self.assemble()?;
        }
        Ok(())
    }

    /// The checksums of complete results.
    pub fn checksums(&self) -> Checksums {
        self.rows.checksums(self.columns.clone())
    }

    /// Removes what was there for the case of an interruption. Comes last.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn forget(self) -> io::Result<()> {
        let Session { path, journal, rows, .. } = self;
        drop((journal, rows));
        forget(&path)
    }

    /// Makes what is written safe, then notes that it is.
    fn note(&mut self, so_far: &Summary) -> io::Result<()> {
        self.rows.flush()?;
        output::check_in_place(&self.results, &self.path)?;
        if self.format == Format::Parquet {
            output::check_in_place(self.rows.file(), &part_of(&self.path))?;
        }
        self.rows.file().sync_data()?;
        let extent = self.rows.extent();
        self.journal.add(&Checkpoint::new(so_far, extent.bytes, extent.digest, self.seconds()))?;
        self.last_checkpoint = Instant::now();
        Ok(())
    }

    /// Turns the rows that wait into the columns of the results.
    fn assemble(&mut self) -> io::Result<()> {
        output::empty(&self.results)?;
        self.results.seek(SeekFrom::Start(0))?;
        let part = part_of(&self.path);
        let mut rows = Reader::new(File::open(&part)?, Format::CsvZstd)?;
        let to = (self.results.try_clone()?, self.format);
        let turned = convert(&mut rows, to, &self.provenance, None).map_err(|error| match error {
            ConvertError::Read(source) | ConvertError::Write(source) => source,
            error @ (ConvertError::Columns | ConvertError::Rows(_)) => io::Error::other(error),
        })?;
        if turned.checksums.text != self.checksums().text {
            return Err(io::Error::other(format!("the rows in {} are not those written", part.display())));
        }
        self.columns = turned.checksums.file;
        Ok(())
    }
}

impl Sink for Session {
    fn begin(&mut self) -> io::Result<()> {
        if self.rows.extent().bytes == 0 { self.rows.header(self.layout.names()) } else { Ok(()) }
    }

    fn write(&mut self, point: &Point, row: &Row) -> io::Result<()> {
        self.rows.cells(&self.layout.cells(point, row))
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

/// Removes what an interrupted run of the results at `path` has left beside them.
///
/// # Errors
/// What the operating system says.
pub fn forget(path: &Path) -> io::Result<()> {
    remove_if_there(&journal::path_of(path))?;
    remove_if_there(&part_of(path))
}

/// Where the rows of a Parquet file wait.
pub fn part_of(results: &Path) -> PathBuf {
    let mut path = results.as_os_str().to_owned();
    path.push(".part");
    PathBuf::from(path)
}

fn open(path: &Path) -> io::Result<File> {
    OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)
}

pub(crate) fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Makes new names in the folder of `path` safe. Where folders cannot be synchronised, names need no such care.
fn sync_folder(path: &Path) {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
}
