//! The journal `<results>.journal` records the progress of a run whose results are unfinished.
//!
//! The first line of a journal identifies the run. Each line after the first line is a checkpoint. Each line
//! begins with the checksum of the rest of the line. A checkpoint is added to the journal only when all rows
//! before the checkpoint are safe on disk. Existing lines of a journal are never changed. After a crash, the
//! last line may be incomplete, so that its checksum is wrong.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use toml::de::ValueDeserializer;
use toml::ser::ValueSerializer;
use xxhash_rust::xxh3::Xxh3Default;

use crate::files::disk;
use crate::files::results::FileSum;
use crate::notation::text;
use crate::run::Summary;
use crate::run::identity::Identity;

/// Version of the format.
const FORMAT: u32 = 1;

/// First line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    format: u32,
    /// Time at which the sweep was first started, in the format of RFC 3339 and in UTC.
    pub started: String,
    /// True if the new results replace earlier results. The earlier results are kept until the new results
    /// are complete.
    pub replaces: bool,
    /// Build and settings that determine the rows of the run.
    pub identity: Identity,
}

impl Header {
    /// Returns the first line of the journal of a new run.
    pub fn new(started: String, replaces: bool, identity: Identity) -> Header {
        Header { format: FORMAT, started, replaces, identity }
    }
}

/// Progress of a run at a moment from which the run can be resumed. Each line of a journal except the
/// first line contains a checkpoint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Total running time of the sweep in seconds, without the time of interruptions.
    pub seconds: f64,
    /// Number and checksum of the bytes that the file of rows contained at the checkpoint.
    pub file: FileSum,
    /// Summary of the rows before the checkpoint.
    pub summary: Summary,
}

impl Checkpoint {
    /// Returns a checkpoint. `summary` is the summary of all rows before the checkpoint. `file` is the
    /// number and the checksum of the bytes before the checkpoint. `seconds` is the running time of the
    /// sweep before the checkpoint.
    pub fn new(seconds: f64, file: FileSum, mut summary: Summary) -> Checkpoint {
        // A checkpoint is one line, so reasons must not contain line ends.
        for invalid in &mut summary.invalid {
            invalid.reason = invalid.reason.replace(['\n', '\r'], " ");
        }
        Checkpoint { seconds, file, summary }
    }
}

/// Contents of a journal.
#[derive(Clone, Debug, PartialEq)]
pub struct JournalContents {
    /// First line.
    pub header: Header,
    /// Checkpoints, each with the number of bytes from the beginning of the journal to the end of the
    /// checkpoint's line.
    pub checkpoints: Vec<(Checkpoint, u64)>,
    /// Length of the first line of the journal in bytes.
    pub header_bytes: u64,
}

/// Parses the text of a journal up to the first incomplete or damaged line.
///
/// Returns `None` if the first line is incomplete, or if a version of flap with a different journal format
/// wrote the journal.
pub fn parse(text: &[u8]) -> Option<JournalContents> {
    let mut lines = text.split_inclusive(|&byte| byte == b'\n');
    let first = lines.next()?;
    let header = read_line(first).filter(|header: &Header| header.format == FORMAT)?;
    let header_bytes = first.len() as u64;
    let mut end = header_bytes;
    let mut checkpoints = Vec::new();
    for line in lines {
        let Some(checkpoint) = read_line(line) else { break };
        end += line.len() as u64;
        checkpoints.push((checkpoint, end));
    }
    Some(JournalContents { header, checkpoints, header_bytes })
}

/// Reads the journal at `path`. Returns `None` if there is no journal, or if [`parse`] returns `None`. If the
/// first line of a journal is incomplete, the run has written no rows.
///
/// # Errors
/// Returns the error of the operating system if the file cannot be read.
pub fn read(path: &Path) -> io::Result<Option<JournalContents>> {
    match fs::read(path) {
        Ok(text) => Ok(parse(&text)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// Returns the contents of a line, or `None` if the line is incomplete or its checksum is wrong.
fn read_line<T: DeserializeOwned>(line: &[u8]) -> Option<T> {
    let line = str::from_utf8(line).ok()?.strip_suffix('\n')?;
    let (checksum, contents) = line.split_once(' ')?;
    if checksum != text::hash(contents) {
        return None;
    }
    T::deserialize(ValueDeserializer::parse(contents).ok()?).ok()
}

/// A journal that is open for writing.
#[derive(Debug)]
pub struct Journal(File);

impl Journal {
    /// Creates a journal.
    ///
    /// # Errors
    /// - [`io::ErrorKind::AlreadyExists`] if a file with contents has this name.
    /// - The error of the operating system if the file cannot be written.
    pub fn create(path: &Path, header: &Header) -> io::Result<Journal> {
        let mut journal = Journal(disk::create_new(path)?);
        journal.add_line(header)?;
        Ok(journal)
    }

    /// Opens a journal to add checkpoints after its first `bytes` bytes, and removes all later bytes.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be opened or truncated.
    pub fn after(path: &Path, bytes: u64) -> io::Result<Journal> {
        // Not opened for appending: Windows cannot truncate such a file.
        let mut file = OpenOptions::new().write(true).open(path)?;
        file.set_len(bytes)?;
        file.seek(SeekFrom::End(0))?;
        Ok(Journal(file))
    }

    /// Adds a checkpoint. The rows before the checkpoint must be safe on disk.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be written.
    pub fn add(&mut self, checkpoint: &Checkpoint) -> io::Result<()> {
        self.add_line(checkpoint)
    }

    fn add_line(&mut self, contents: &impl Serialize) -> io::Result<()> {
        let mut text = String::new();
        contents.serialize(ValueSerializer::new(&mut text)).map_err(io::Error::other)?;
        self.0.write_all(format!("{} {text}\n", text::hash(&text)).as_bytes())?;
        self.0.sync_data()
    }
}

/// The last checkpoint at which the file of rows is complete: the file contains all rows before the
/// checkpoint.
pub(crate) struct IntactRows {
    pub(crate) checkpoint: Checkpoint,
    /// Number of bytes from the beginning of the journal to the end of the checkpoint's line.
    pub(crate) journal_bytes: u64,
    /// Hash of the bytes that the file of rows contained at the checkpoint.
    pub(crate) hash: Xxh3Default,
    /// Number of rows between this checkpoint and the last checkpoint of the journal. These rows are
    /// missing in the file of rows.
    pub(crate) lost: u64,
}

/// Returns the last checkpoint in `journal` at which `file` is complete. Returns `None` if the bytes in
/// `file` differ from the bytes that the run wrote.
pub(crate) fn last_intact(mut file: &File, journal: &JournalContents) -> io::Result<Option<IntactRows>> {
    let mut hash = Xxh3Default::new();
    let mut intact = IntactRows {
        checkpoint: Checkpoint::default(),
        journal_bytes: journal.header_bytes,
        hash: hash.clone(),
        lost: journal.checkpoints.last().map_or(0, |(checkpoint, _)| checkpoint.summary.rows),
    };
    for (checkpoint, journal_bytes) in &journal.checkpoints {
        let Some(missing) = checkpoint.file.bytes.checked_sub(intact.checkpoint.file.bytes) else {
            return Ok(None);
        };
        if io::copy(&mut Read::by_ref(&mut file).take(missing), &mut hash)? < missing {
            return Ok(Some(intact));
        }
        if text::digits(hash.digest()) != checkpoint.file.xxh3 {
            return Ok(None);
        }
        let lost = (intact.lost + intact.checkpoint.summary.rows).saturating_sub(checkpoint.summary.rows);
        let checkpoint = checkpoint.clone();
        intact = IntactRows { checkpoint, journal_bytes: *journal_bytes, hash: hash.clone(), lost };
    }
    Ok(Some(intact))
}
