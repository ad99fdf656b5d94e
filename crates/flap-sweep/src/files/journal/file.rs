//! Journals as files.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;
use toml::de::ValueDeserializer;
use toml::ser::ValueSerializer;

use super::{Checkpoint, Header};
use crate::files::disk;
use crate::notation::text;

/// The contents of a journal.
#[derive(Clone, Debug, PartialEq)]
pub struct Past {
    /// The first line.
    pub header: Header,
    /// The other lines, each with the number of bytes up to its end.
    pub checkpoints: Vec<(Checkpoint, u64)>,
    /// Bytes up to the end of the first line.
    pub header_bytes: u64,
}

/// Reads the text of a journal up to the first line that is not whole. `None` if that is the first line, or the journal is
/// of another format.
pub fn parse(text: &[u8]) -> Option<Past> {
    let mut lines = text.split_inclusive(|&byte| byte == b'\n');
    let first = lines.next()?;
    let header: Header = read_line(first).filter(Header::is_known)?;
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

/// Reads the journal at `path`. `None` if there is none, or its first line is not whole: no row was written then.
///
/// # Errors
/// The error of the operating system if the file cannot be read.
pub fn read(path: &Path) -> io::Result<Option<Past>> {
    match fs::read(path) {
        Ok(text) => Ok(parse(&text)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
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
    /// Begins a journal.
    ///
    /// # Errors
    /// - [`io::ErrorKind::AlreadyExists`] if a file with contents has its name
    /// - the error of the operating system if the file cannot be written
    pub fn create(path: &Path, header: &Header) -> io::Result<Journal> {
        let mut journal = Journal(disk::create_new(path)?);
        journal.add_line(header)?;
        Ok(journal)
    }

    /// Continues a journal after its first `bytes`, and drops the rest.
    ///
    /// # Errors
    /// The error of the operating system if the file cannot be opened or cut.
    pub fn after(path: &Path, bytes: u64) -> io::Result<Journal> {
        let file = OpenOptions::new().append(true).open(path)?;
        file.set_len(bytes)?;
        Ok(Journal(file))
    }

    /// Adds a checkpoint. Its rows must be safe on disk.
    ///
    /// # Errors
    /// The error of the operating system if the file cannot be written.
    pub fn add(&mut self, checkpoint: &Checkpoint) -> io::Result<()> {
        self.add_line(checkpoint)
    }

    fn add_line(&mut self, contents: &impl Serialize) -> io::Result<()> {
        self.0.write_all(line(contents)?.as_bytes())?;
        self.0.sync_data()
    }
}
