//! The file beside unfinished results that says how far they are: `<results>.journal`.
//!
//! One line of text each for what is run and for every checkpoint, with a checksum before it. A line is added only when
//! the rows it tells of are safe on disk, and lines are never changed. What a crash may leave is half a line at the end,
//! which its checksum tells.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use flap_core::simulate::Status;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use toml::de::ValueDeserializer;
use toml::ser::ValueSerializer;

use crate::files::sidecar::InvalidPoint;
use crate::notation::text;
use crate::run::identity::Identity;
use crate::run::{Doubts, Summary};

/// Version of the format.
const FORMAT: u32 = 1;

/// The first line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    format: u32,
    /// Start of the first session, as RFC 3339 in UTC.
    pub started: String,
    /// What is run.
    pub identity: Identity,
    /// Whether earlier results wait beside these until these are complete.
    #[serde(default)]
    pub replaces: bool,
}

/// A place at which a run can be resumed: every line but the first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Rows written.
    pub rows: u64,
    /// Points that were excluded.
    excluded: u64,
    /// Bytes of the file that holds them.
    pub bytes: u64,
    /// XXH3 of these bytes, in hexadecimal digits.
    pub xxh3: String,
    /// Seconds of running, in all sessions.
    pub seconds: f64,
    cycles: u64,
    rhs_evals: u64,
    statuses: BTreeMap<String, u64>,
    unsatisfied: BTreeMap<String, u64>,
    #[serde(default)]
    doubts: Doubts,
    invalid: Vec<InvalidPoint>,
}

impl Header {
    /// The first line of a run that starts now.
    pub fn new(started: String, identity: Identity) -> Header {
        Header { format: FORMAT, started, identity, replaces: false }
    }
}

impl Checkpoint {
    /// The checkpoint after the rows that `summary` counts.
    pub fn new(summary: &Summary, bytes: u64, digest: u64, seconds: f64) -> Checkpoint {
        let statuses = summary.counts.iter().filter(|(_, count)| *count > 0);
        // A checkpoint is one line, and so are reasons.
        let invalid = |(point, reason): &(u64, String)| InvalidPoint {
            point: *point,
            reason: reason.replace(['\n', '\r'], " "),
        };
        Checkpoint {
            rows: summary.rows,
            excluded: summary.excluded,
            bytes,
            xxh3: format!("{digest:016x}"),
            seconds,
            cycles: summary.cycles,
            rhs_evals: summary.rhs_evals,
            statuses: statuses.map(|(status, count)| (status.name().to_owned(), count)).collect(),
            unsatisfied: summary.unsatisfied.iter().cloned().collect(),
            doubts: summary.doubts,
            invalid: summary.invalid.iter().map(invalid).collect(),
        }
    }

    /// What the rows up to here came to.
    pub fn summary(&self) -> Summary {
        let count = |status: Status| (status, self.statuses.get(status.name()).copied().unwrap_or(0));
        Summary {
            points: 0,
            rows: self.rows,
            excluded: self.excluded,
            unsatisfied: self.unsatisfied.clone().into_iter().collect(),
            interrupted: false,
            counts: Status::ALL.into_iter().map(count).collect(),
            rhs_evals: self.rhs_evals,
            cycles: self.cycles,
            doubts: self.doubts,
            invalid: self.invalid.iter().map(|invalid| (invalid.point, invalid.reason.clone())).collect(),
        }
    }
}

/// What a journal says.
#[derive(Clone, Debug, PartialEq)]
pub struct Past {
    /// The first line.
    pub header: Header,
    /// The other lines, each with the number of bytes up to its end.
    pub checkpoints: Vec<(Checkpoint, u64)>,
    /// Bytes up to the end of the first line.
    pub header_bytes: u64,
}

/// Reads the text of a journal as far as its lines are whole; `None` if the first one is not, or is of another format.
pub fn parse(text: &[u8]) -> Option<Past> {
    let mut lines = text.split_inclusive(|&byte| byte == b'\n');
    let first = lines.next()?;
    let header: Header = read_line(first).filter(|header: &Header| header.format == FORMAT)?;
    let header_bytes = first.len() as u64;
    let mut end = header_bytes;
    let mut checkpoints = Vec::new();
    for line in lines {
        let Some(checkpoint) = read_line(line) else { break };
        end += line.len() as u64;
        checkpoints.push((checkpoint, end));
    }
    Some(Past { header, checkpoints, header_bytes })
}

/// The contents of a line, if it is whole.
fn read_line<T: DeserializeOwned>(line: &[u8]) -> Option<T> {
    let line = str::from_utf8(line).ok()?.strip_suffix('\n')?;
    let (checksum, contents) = line.split_once(' ')?;
    if checksum != text::hash(contents) {
        return None;
    }
    T::deserialize(ValueDeserializer::parse(contents).ok()?).ok()
}

fn line(contents: &impl Serialize) -> io::Result<String> {
    let mut text = String::new();
    contents.serialize(ValueSerializer::new(&mut text)).map_err(io::Error::other)?;
    Ok(format!("{} {text}\n", text::hash(&text)))
}

/// A journal that is being written.
#[derive(Debug)]
pub struct Journal(File);

impl Journal {
    /// Begins a journal, in place of an earlier one.
    ///
    /// # Errors
    /// What writing says.
    pub fn create(path: &Path, header: &Header) -> io::Result<Journal> {
        let mut journal = Journal(File::create(path)?);
        journal.add_line(header)?;
        Ok(journal)
    }

    /// Goes on with a journal after its first `bytes`, and drops the rest.
    ///
    /// # Errors
    /// What opening says.
    pub fn after(path: &Path, bytes: u64) -> io::Result<Journal> {
        let file = OpenOptions::new().append(true).open(path)?;
        file.set_len(bytes)?;
        Ok(Journal(file))
    }

    /// Adds a checkpoint. The rows it tells of must be safe on disk.
    ///
    /// # Errors
    /// What writing says.
    pub fn add(&mut self, checkpoint: &Checkpoint) -> io::Result<()> {
        self.add_line(checkpoint)
    }

    fn add_line(&mut self, contents: &impl Serialize) -> io::Result<()> {
        self.0.write_all(line(contents)?.as_bytes())?;
        self.0.sync_data()
    }
}

/// The path of the journal that belongs to a result file.
pub fn path_of(results: &Path) -> PathBuf {
    let mut path = results.as_os_str().to_owned();
    path.push(".journal");
    PathBuf::from(path)
}

/// Reads the journal at `path`; `None` if there is none, or no whole line in it: nothing was written then.
///
/// # Errors
/// What reading says.
pub fn read(path: &Path) -> io::Result<Option<Past>> {
    match fs::read(path) {
        Ok(text) => Ok(parse(&text)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}
