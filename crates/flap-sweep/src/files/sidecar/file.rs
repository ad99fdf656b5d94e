//! Sidecars as files, whose first line is the checksum of the others.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use memchr::memmem;
use xxhash_rust::xxh3::xxh3_64;

use super::Sidecar;
use crate::files::disk;
use crate::input::{self, InputError, MOST_LISTED};
use crate::notation::text;

/// The beginning of the first line, which is also TOML: other readers need not know it.
const CHECKSUM: &str = "checksum = \"";

/// A file that cannot be used as a sidecar.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// It cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// It is not a sidecar.
    #[error("{}: not a sidecar of results: {reason}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The mistake in it.
        reason: String,
    },
    /// It has changed since flap wrote it.
    #[error("{} is damaged: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The sign of the change.
        reason: &'static str,
    },
}

/// A text that is not one of a sidecar.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseError {
    /// It never was one.
    #[error("{0}")]
    Format(String),
    /// It has changed since it was written.
    #[error("{0}")]
    Damaged(&'static str),
}

impl Sidecar {
    /// The text of the file.
    ///
    /// # Errors
    /// [`toml::ser::Error`] if TOML cannot hold a number, such as 2^63 points.
    pub fn text(&self) -> Result<String, toml::ser::Error> {
        let contents = toml::to_string(self)?;
        Ok(format!("{CHECKSUM}{}\"\n{contents}", text::hash(&contents)))
    }

    /// Reads the file.
    ///
    /// # Errors
    /// - [`ReadError::Io`] if it cannot be read
    /// - [`ReadError::Format`] if it is not a sidecar
    /// - [`ReadError::Damaged`] if it does not match its checksum
    pub fn read(path: &Path) -> Result<Sidecar, ReadError> {
        Sidecar::read_as(path, Sidecar::parse)
    }

    /// Reads the file, damaged or not.
    ///
    /// # Errors
    /// - [`ReadError::Io`] if it cannot be read
    /// - [`ReadError::Format`] if it is not a sidecar
    pub fn read_damaged(path: &Path) -> Result<Sidecar, ReadError> {
        Sidecar::read_as(path, Sidecar::parse_damaged)
    }

    fn read_as(
        path: &Path,
        parse: impl Fn(&[u8]) -> Result<Sidecar, ParseError>,
    ) -> Result<Sidecar, ReadError> {
        let path = || path.to_owned();
        let bytes = input::bytes(&path(), MOST_LISTED).map_err(|error| match error {
            InputError::Missing | InputError::Unreadable(_) => {
                ReadError::Io { path: path(), source: error.into() }
            }
            _ => ReadError::Format { path: path(), reason: error.to_string() },
        })?;
        parse(&bytes).map_err(|error| match error {
            ParseError::Format(reason) => ReadError::Format { path: path(), reason },
            ParseError::Damaged(reason) => ReadError::Damaged { path: path(), reason },
        })
    }

    /// Reads the bytes of the file.
    ///
    /// # Errors
    /// - [`ParseError::Format`] if they are not a sidecar
    /// - [`ParseError::Damaged`] if they do not match their checksum
    pub fn parse(bytes: &[u8]) -> Result<Sidecar, ParseError> {
        if let Some(rest) = bytes.strip_prefix(CHECKSUM.as_bytes())
            && let Some(end) = memmem::find(rest, b"\"\n")
        {
            let (checksum, contents) = (&rest[..end], &rest[end + 2..]);
            if checksum != text::digits(xxh3_64(contents)).as_bytes() {
                return Err(ParseError::Damaged("its first line is not the checksum of the others"));
            }
            return Sidecar::parse_damaged(contents);
        }
        Sidecar::parse_damaged(bytes)?;
        Err(ParseError::Damaged("its first line is not its checksum"))
    }

    /// Reads the bytes of the file without its checksum line, or with one that is ignored. Bytes that are not UTF-8 become
    /// U+FFFD.
    fn parse_damaged(bytes: &[u8]) -> Result<Sidecar, ParseError> {
        toml::from_str(&String::from_utf8_lossy(bytes))
            .map_err(|error| ParseError::Format(error.message().to_owned()))
    }

    /// Writes the file, in place of an earlier one.
    ///
    /// # Errors
    /// The error of the operating system if it cannot be written.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        self.prepare(path)?.commit()
    }

    /// Writes the file, which has its name once it is committed.
    pub(crate) fn prepare(&self, path: &Path) -> io::Result<disk::Whole> {
        let text = self.text().map_err(io::Error::other)?;
        let whole = disk::Whole::begin(path)?;
        whole.file().write_all(text.as_bytes())?;
        Ok(whole)
    }
}
