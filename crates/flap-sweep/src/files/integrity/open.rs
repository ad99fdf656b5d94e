//! Results opened for reading: checked, up to the last row that is safe.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

use memchr::memrchr;

use super::check::check;
use super::{Damage, Note, OnDamage, OpenError, Unverified};
use crate::files::beside::{journal_of, rows_of, sidecar_of};
use crate::files::journal::{self, Past, last_intact};
use crate::files::results::{Format, Reader};
use crate::files::sidecar::{ReadError, Sidecar, State};

/// Longest row of a result file (bytes).
const LONGEST_ROW: u64 = 1 << 20;

/// Results that can be read.
pub struct Opened {
    /// Their rows.
    pub reader: Reader,
    /// Their sidecar, if there is one.
    pub sidecar: Option<Sidecar>,
    /// Notes for the user.
    pub notes: Vec<Note>,
}

/// Opens the results at `path`. Unfinished results end at their last checkpoint.
///
/// # Errors
/// - [`OpenError::Format`] if the name stands for no format
/// - [`OpenError::Read`] if the file cannot be read
/// - [`OpenError::Sidecar`] if the sidecar cannot be read, or is damaged and that is not tolerated
/// - [`OpenError::Damaged`] if the results are damaged and that is not tolerated
pub fn open(path: &Path, on_damage: OnDamage) -> Result<Opened, OpenError> {
    let format = Format::of(path)?;
    let mut notes = Vec::new();
    let sidecar = beside(path, on_damage, &mut notes)?;
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    let is_complete = sidecar.as_ref().is_some_and(|sidecar| sidecar.state == State::Complete);
    let past = if is_complete { None } else { journal::read(&journal_of(path)).map_err(unreadable)? };
    let mut reader = match (past, &sidecar) {
        (Some(past), _) => unfinished(path, format, &past, on_damage, &mut notes)?,
        (None, Some(sidecar)) => {
            notes.extend(match &sidecar.checksums {
                None => Some(Note::Unverified { path: path.to_owned(), why: Unverified::NoChecksums }),
                Some(_) => check(path, format, sidecar, on_damage)?
                    .map(|damage| Note::Damaged { path: path.to_owned(), damage }),
            });
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

/// The sidecar of the results at `path`; `None` if there is none, or it cannot be used.
fn beside(path: &Path, on_damage: OnDamage, notes: &mut Vec<Note>) -> Result<Option<Sidecar>, OpenError> {
    let beside = sidecar_of(path);
    match Sidecar::read(&beside) {
        Ok(sidecar) => Ok(Some(sidecar)),
        Err(ReadError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error @ ReadError::Damaged { .. }) if on_damage == OnDamage::Tolerate => {
            notes.push(Note::Sidecar(error.to_string()));
            Ok(Sidecar::read_damaged(&beside).ok())
        }
        // The file may be one of another version, or of another program.
        Err(error @ ReadError::Format { .. }) => {
            notes.push(Note::Sidecar(error.to_string()));
            Ok(None)
        }
        Err(error) => Err(error.into()),
    }
}

/// The whole rows of results that have lost their journal: the last line may be half a row.
fn whole_rows(mut file: File, format: Format) -> io::Result<Reader> {
    if format != Format::Csv {
        let mut reader = Reader::new(file, format)?;
        reader.tolerate();
        return Ok(reader);
    }
    let bytes = file.metadata()?.len();
    let begin = bytes.saturating_sub(LONGEST_ROW);
    file.seek(SeekFrom::Start(begin))?;
    let mut end = Vec::new();
    file.read_to_end(&mut end)?;
    let last = memrchr(b'\n', &end).map_or(0, |last| last as u64 + 1);
    file.seek(SeekFrom::Start(0))?;
    Reader::of_text(file.take(begin + last), format)
}

/// The rows of unfinished results, up to the last checkpoint.
fn unfinished(
    path: &Path,
    format: Format,
    past: &Past,
    on_damage: OnDamage,
    notes: &mut Vec<Note>,
) -> Result<Reader, OpenError> {
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    let rows = rows_of(path, format);
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
