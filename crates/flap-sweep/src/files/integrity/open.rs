//! Results to be read: checked, and as far as they are complete.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use memchr::memrchr;

use super::damage::Damage;
use super::unfinished::last_intact;
use super::verify;
use crate::files::journal::{self, Past};
use crate::files::results::{Format, FormatError, Reader};
use crate::files::session;
use crate::files::sidecar::{self, ReadError, Sidecar, State};

/// The treatment of damage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnDamage {
    /// Nothing is read.
    Refuse,
    /// What can be read is read, and a [`Note`] tells of it.
    Tolerate,
}

/// Results that can be read.
pub struct Opened {
    /// Their rows.
    pub reader: Reader,
    /// Their sidecar, if there is one.
    pub sidecar: Option<Sidecar>,
    /// Notes for the user.
    pub notes: Vec<Note>,
}

/// A note on results for the user.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Note {
    /// They are not as they were written.
    #[error("{} is damaged: {damage}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// How.
        damage: Damage,
    },
    /// Their sidecar is damaged, or of an unknown format.
    #[error("{0}")]
    Sidecar(String),
    /// They are not complete.
    #[error("{} is unfinished: {}", path.display(), so_far(*done))]
    Unfinished {
        /// The file.
        path: PathBuf,
        /// Points whose rows are read or that are excluded, if that is known.
        done: Option<u64>,
    },
    /// They cannot be checked.
    #[error("{} could not be verified: {why}", path.display())]
    Unverified {
        /// The file.
        path: PathBuf,
        /// Why.
        why: Unverified,
    },
}

/// Why results cannot be checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unverified {
    /// They have no sidecar.
    #[error("there is no sidecar beside it")]
    NoSidecar,
    /// Their sidecar has no checksums.
    #[error("its sidecar has no checksums")]
    NoChecksums,
}

fn so_far(done: Option<u64>) -> String {
    match done {
        Some(done) => format!("{done} points are done so far, `flap resume` goes on"),
        None => "there are fewer rows than points to be run".to_owned(),
    }
}

/// Why results cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The name stands for no format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The operating system refuses, or they are something else.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Their sidecar cannot be read, or is damaged.
    #[error(transparent)]
    Sidecar(#[from] ReadError),
    /// They are not as they were written.
    #[error("{} is damaged: {damage}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// How.
        damage: Box<Damage>,
    },
}

/// Opens the results at `path`. Of unfinished ones the rows up to the last checkpoint are read.
///
/// # Errors
/// If they cannot be read, or are damaged and that is not tolerated.
pub fn open(path: &Path, on_damage: OnDamage) -> Result<Opened, OpenError> {
    let format = Format::of(path)?;
    let mut notes = Vec::new();
    let sidecar = beside(path, on_damage, &mut notes)?;
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    let is_complete = sidecar.as_ref().is_some_and(|sidecar| sidecar.state == State::Complete);
    let past = if is_complete { None } else { journal::read(&journal::path_of(path)).map_err(unreadable)? };
    let mut reader = match (past, &sidecar) {
        (Some(past), _) => unfinished(path, format, &past, on_damage, &mut notes)?,
        (None, Some(sidecar)) => {
            checked(path, format, sidecar, on_damage, &mut notes)?;
            let file = File::open(path).map_err(unreadable)?;
            if is_complete {
                Reader::new(file, format).map_err(unreadable)?
            } else {
                notes.push(Note::Unfinished { path: path.to_owned(), done: None });
                whole_rows(file, format).map_err(unreadable)?
            }
        }
        (None, None) => {
            if notes.is_empty() {
                notes.push(Note::Unverified { path: path.to_owned(), why: Unverified::NoSidecar });
            }
            Reader::new(File::open(path).map_err(unreadable)?, format).map_err(unreadable)?
        }
    };
    if on_damage == OnDamage::Tolerate {
        reader.tolerate();
    }
    Ok(Opened { reader, sidecar, notes })
}

/// The sidecar of the results at `path`; `None` if there is none, or a damaged one that is no use.
fn beside(path: &Path, on_damage: OnDamage, notes: &mut Vec<Note>) -> Result<Option<Sidecar>, OpenError> {
    let beside = sidecar::path_of(path);
    match Sidecar::read(&beside) {
        Ok(sidecar) => Ok(Some(sidecar)),
        Err(ReadError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error @ ReadError::Damaged { .. }) if on_damage == OnDamage::Tolerate => {
            notes.push(Note::Sidecar(error.to_string()));
            Ok(Sidecar::read_damaged(&beside).ok())
        }
        // Perhaps by another version, or of another program.
        Err(error @ ReadError::Format { .. }) => {
            notes.push(Note::Sidecar(error.to_string()));
            Ok(None)
        }
        Err(error) => Err(error.into()),
    }
}

/// Compares results with the checksums in their sidecar.
fn checked(
    path: &Path,
    format: Format,
    sidecar: &Sidecar,
    on_damage: OnDamage,
    notes: &mut Vec<Note>,
) -> Result<(), OpenError> {
    let path = path.to_owned();
    if sidecar.checksums.is_none() {
        notes.push(Note::Unverified { path, why: Unverified::NoChecksums });
        return Ok(());
    }
    match verify::check(&path, format, sidecar) {
        Ok(None) => Ok(()),
        Ok(Some(damage)) if on_damage == OnDamage::Tolerate => {
            notes.push(Note::Damaged { path, damage });
            Ok(())
        }
        Ok(Some(damage)) => Err(OpenError::Damaged { path, damage: Box::new(damage) }),
        Err(source) => Err(OpenError::Read { path, source }),
    }
}

/// The rows of results that have lost their journal: the last one may be half of one.
fn whole_rows(mut file: File, format: Format) -> io::Result<Reader> {
    if format != Format::Csv {
        let mut reader = Reader::new(file, format)?;
        reader.tolerate();
        return Ok(reader);
    }
    let bytes = file.metadata()?.len();
    // No row is longer.
    let begin = bytes.saturating_sub(1 << 20);
    file.seek(SeekFrom::Start(begin))?;
    let mut end = Vec::new();
    file.read_to_end(&mut end)?;
    let last = memrchr(b'\n', &end).map_or(0, |last| last as u64 + 1);
    file.seek(SeekFrom::Start(0))?;
    Reader::of_text(file.take(begin + last), format)
}

/// The rows up to the last checkpoint.
fn unfinished(
    path: &Path,
    format: Format,
    past: &Past,
    on_damage: OnDamage,
    notes: &mut Vec<Note>,
) -> Result<Reader, OpenError> {
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    // Rows of a Parquet file wait as text.
    let rows = if format == Format::Parquet { session::part_of(path) } else { path.to_owned() };
    let open = || File::open(&rows).map_err(unreadable);
    let intact = last_intact(&open()?, past).map_err(unreadable)?;
    let done = intact.as_ref().map(|intact| intact.checkpoint.summary().done());
    notes.push(Note::Unfinished { path: path.to_owned(), done });
    let mut bytes = u64::MAX;
    if let Some(intact) = intact {
        bytes = intact.checkpoint.bytes;
    } else {
        let damage = Damage { altered: true, ..Damage::default() };
        if on_damage == OnDamage::Refuse {
            return Err(OpenError::Damaged { path: rows, damage: Box::new(damage) });
        }
        notes.push(Note::Damaged { path: rows.clone(), damage });
    }
    Reader::of_text(open()?.take(bytes), format).map_err(unreadable)
}
