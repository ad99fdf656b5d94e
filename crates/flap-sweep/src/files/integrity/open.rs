//! Results opened for reading: checked, up to the last row that is safe.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

use memchr::memrchr;

use super::check::check;
use super::{Damage, Note, OnDamage, OpenError, Unverified};
use crate::files::beside::{journal_of, rows_of, sidecar_of};
use crate::files::journal::{self, JournalContents, last_intact};
use crate::files::results::{Format, Reader};
use crate::files::sidecar::{ReadError, Sidecar, State};

/// Longest row of a result file (bytes).
const LONGEST_ROW: u64 = 1 << 20;

/// Format of the rows of a Parquet file that is not complete.
const WAITING: Format = Format::CsvZstd;

/// Results that can be read.
pub struct Opened {
    /// Their rows.
    pub reader: Reader,
    /// Their sidecar, if there is one and it is theirs.
    pub sidecar: Option<Sidecar>,
    /// Notes for the user.
    pub notes: Vec<Note>,
}

/// The column names of the results at `path`, complete or not. Reads the beginning of the file, or the end of a Parquet file,
/// and checks nothing.
///
/// # Errors
/// - [`OpenError::Format`] if the name stands for no format
/// - [`OpenError::Read`] if the file cannot be read
pub fn names(path: &Path) -> Result<Vec<String>, OpenError> {
    let format = Format::of(path)?;
    let waiting = rows_of(path, format);
    let reader = if format.is_columnar() && waiting.exists() {
        File::open(waiting).and_then(|rows| Reader::new(rows, WAITING))
    } else {
        File::open(path).and_then(|file| Reader::new(file, format))
    };
    let reader = reader.map_err(|source| OpenError::Read { path: path.to_owned(), source })?;
    Ok(reader.names().to_vec())
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
    let mut sidecar = beside(path, on_damage, &mut notes)?;
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    let is_complete = sidecar.as_ref().is_some_and(|sidecar| sidecar.state == State::Complete);
    let recorded = if is_complete { None } else { journal::read(&journal_of(path)).map_err(unreadable)? };
    let mut reader = if let Some(recorded) = recorded {
        unfinished(path, format, &recorded, &mut sidecar, (on_damage, &mut notes))?
    } else if let Some(sidecar) = &sidecar {
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
    } else {
        if notes.is_empty() {
            notes.push(Note::Unverified { path: path.to_owned(), why: Unverified::NoSidecar });
        }
        Reader::new(File::open(path).map_err(unreadable)?, format).map_err(unreadable)?
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

/// The whole rows of unfinished results that no journal limits: the last line may be half a row.
fn whole_rows(mut file: File, format: Format) -> io::Result<Reader> {
    let bytes = file.metadata()?.len();
    if format != Format::Csv && bytes > 0 {
        let mut reader = Reader::new(file, format)?;
        reader.tolerate();
        return Ok(reader);
    }
    let begin = bytes.saturating_sub(LONGEST_ROW);
    file.seek(SeekFrom::Start(begin))?;
    let mut end = Vec::new();
    file.read_to_end(&mut end)?;
    let last = memrchr(b'\n', &end).map_or(0, |last| last as u64 + 1);
    file.seek(SeekFrom::Start(0))?;
    Reader::of_text(file.take(begin + last), format)
}

/// The rows of unfinished results up to the last checkpoint, all of which must be those that the journal records. If damage is
/// tolerated, all whole rows in the file, and `sidecar` becomes `None` if it describes other rows.
fn unfinished(
    path: &Path,
    format: Format,
    recorded: &JournalContents,
    sidecar: &mut Option<Sidecar>,
    (on_damage, notes): (OnDamage, &mut Vec<Note>),
) -> Result<Reader, OpenError> {
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    let rows = rows_of(path, format);
    let file = File::open(&rows).map_err(unreadable)?;
    let intact = last_intact(&file, recorded).map_err(unreadable)?;
    let done = intact.as_ref().map(|intact| intact.checkpoint.summary.done());
    notes.push(Note::Unfinished { path: path.to_owned(), done });
    let own = &recorded.header.identity;
    let damage = Damage {
        altered: intact.is_none(),
        lost: intact.as_ref().map_or(0, |intact| intact.lost),
        foreign_sidecar: sidecar.as_ref().map_or(Vec::new(), |sidecar| own.differences(&sidecar.identity)),
        ..Damage::default()
    };
    let is_foreign = !damage.foreign_sidecar.is_empty();
    let are_sound = !damage.altered && damage.lost == 0;
    if !damage.is_none() {
        if on_damage == OnDamage::Refuse {
            return Err(OpenError::Damaged { path: path.to_owned(), damage: Box::new(damage) });
        }
        notes.push(Note::Damaged { path: path.to_owned(), damage });
    }
    if is_foreign {
        *sidecar = None;
    }
    let text = if format.is_columnar() { WAITING } else { format };
    let file = File::open(&rows).map_err(unreadable)?;
    match intact {
        Some(intact) if are_sound => Reader::of_text(file.take(intact.checkpoint.file.bytes), text),
        _ => whole_rows(file, text),
    }
    .map_err(unreadable)
}
