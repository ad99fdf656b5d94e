//! Sidecars as files, whose first line is the checksum of the others.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::Sidecar;
use crate::files::output;
use crate::notation::text;

/// How the first line begins, which is also TOML: other readers need not know it.
const CHECKSUM: &str = "checksum = \"";

/// Why a file cannot be used as a sidecar.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// It cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// It is not a sidecar.
    #[error("{}: not a sidecar of results: {reason}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// It is not as flap wrote it.
    #[error("{} is damaged: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What tells.
        reason: String,
    },
}

/// Why a text is not that of a sidecar.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseError {
    /// It never was one.
    #[error("{0}")]
    Format(String),
    /// It is not as it was written.
    #[error("{0}")]
    Damaged(&'static str),
}

impl Sidecar {
    /// The text of the file.
    ///
    /// # Errors
    /// If a number has no place in TOML, such as 2^63 points.
    pub fn text(&self) -> Result<String, toml::ser::Error> {
        let contents = toml::to_string(self)?;
        Ok(format!("{CHECKSUM}{}\"\n{contents}", text::hash(&contents)))
    }

    /// Reads the file.
    ///
    /// # Errors
    /// If it cannot be read, is not a sidecar, or is not as it was written.
    pub fn read(path: &Path) -> Result<Sidecar, ReadError> {
        Sidecar::read_as(path, Sidecar::parse)
    }

    /// Reads the file whether or not it is as it was written.
    ///
    /// # Errors
    /// If it cannot be read or is not a sidecar.
    pub fn read_damaged(path: &Path) -> Result<Sidecar, ReadError> {
        Sidecar::read_as(path, Sidecar::parse_damaged)
    }

    fn read_as(
        path: &Path,
        parse: impl Fn(&str) -> Result<Sidecar, ParseError>,
    ) -> Result<Sidecar, ReadError> {
        let path = || path.to_owned();
        let bytes = fs::read(path()).map_err(|source| ReadError::Io { path: path(), source })?;
        parse(&String::from_utf8_lossy(&bytes)).map_err(|error| match error {
            ParseError::Format(reason) => ReadError::Format { path: path(), reason },
            ParseError::Damaged(reason) => ReadError::Damaged { path: path(), reason: reason.to_owned() },
        })
    }

    /// Reads the text of the file.
    ///
    /// # Errors
    /// What is wrong with it, in one line.
    pub fn parse(text: &str) -> Result<Sidecar, ParseError> {
        if let Some((checksum, contents)) =
            text.strip_prefix(CHECKSUM).and_then(|rest| rest.split_once("\"\n"))
        {
            if checksum != text::hash(contents) {
                return Err(ParseError::Damaged("its first line is not the checksum of the others"));
            }
            return Sidecar::parse_damaged(contents);
        }
        let sidecar = Sidecar::parse_damaged(text)?;
        // Those without a checksum are by a flap that recorded no builds either.
        if sidecar.build.is_empty() && sidecar.checksums.is_none() {
            Ok(sidecar)
        } else {
            Err(ParseError::Damaged("its first line should be its checksum, and is not"))
        }
    }

    /// Reads the text of the file, whatever its checksum is.
    fn parse_damaged(text: &str) -> Result<Sidecar, ParseError> {
        toml::from_str(text).map_err(|error| ParseError::Format(error.message().to_owned()))
    }

    /// Writes the file, in place of an earlier one.
    ///
    /// # Errors
    /// What writing says.
    pub fn write(&self, path: &Path) -> io::Result<()> {
        let text = self.text().map_err(io::Error::other)?;
        output::replace(path, |mut file| file.write_all(text.as_bytes()))
    }
}
