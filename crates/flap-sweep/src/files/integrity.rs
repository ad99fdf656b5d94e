//! Checks that result files are unchanged since flap wrote them.
//!
//! A sidecar contains two kinds of checksums of complete results. The checksum of all bytes of the file shows
//! quickly if the file has changed. The checksums of the blocks of rows show which rows have changed.
//!
//! For unfinished results, the journal records the number of rows that are safe on disk. The journal also
//! records the identity of the sweep: the build and the settings that determine the rows. From undamaged
//! unfinished results, flap reads only the rows before the last checkpoint of the journal. If the sidecar
//! and the journal record different identities of the sweep, the results count as damaged.

use std::fmt;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use memchr::memrchr;

use super::beside::{journal_of, rows_of, sidecar_of};
use super::journal::{self, JournalContents, last_intact};
use super::results::{BLOCK_ROWS, Checksums, FileSum, Format, FormatError, Reader, TextDigest, sum_up};
use super::sidecar::{Sidecar, SidecarError, State};
use crate::notation::text::count;

/// Treatment of damaged results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnDamage {
    /// Damaged results are rejected.
    Refuse,
    /// flap reads all readable rows of damaged results, and reports the damage in a [`Note`].
    Tolerate,
}

/// Largest number of ranges of damaged rows that a message lists. If there are more ranges, the message
/// contains the number of the ranges that are not listed.
const MOST_LISTED: usize = 5;

/// Differences between a result file and the contents that flap wrote into the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// Descriptions of the differences.
    differences: Vec<String>,
    /// Number of rows that are missing in the file although the journal records that they were safe on
    /// disk.
    pub lost: u64,
}

impl Damage {
    /// Compares the checksums of a text, which are in `found`, with the recorded `checksums`, and returns the
    /// differences. `rows` is the number of rows that flap wrote. If only the beginning of the text can be
    /// read, `unreadable` is the reason.
    fn of_text(
        found: &TextDigest,
        checksums: &Checksums,
        rows: Option<u64>,
        unreadable: Option<String>,
    ) -> Damage {
        let mut differences = Vec::new();
        let written = checksums.parts().filter(|_| checksums.block_rows == BLOCK_ROWS);
        match written {
            _ if found.text() == checksums.text => {}
            None => differences.push("the checksums cannot be read".to_owned()),
            Some(written) => {
                let parts = found.parts();
                if parts.first() != written.first() {
                    differences.push("the header has changed".to_owned());
                }
                let ranges = changed_rows(&parts, &written, rows.unwrap_or(0).max(found.rows()));
                if !ranges.is_empty() {
                    let ranges = listed(&ranges);
                    differences.push(format!("rows {ranges} have changed since they were written"));
                }
                // The number of unreadable rows is unknown.
                let other = rows.filter(|&rows| rows != found.rows() && unreadable.is_none());
                differences.extend(
                    other.map(|rows| format!("it contains {} rows, but {rows} were written", found.rows())),
                );
            }
        }
        differences.extend(unreadable.map(|reason| format!("the rest cannot be read ({reason})")));
        Damage { differences, lost: 0 }
    }

    /// Returns true if there is no damage.
    pub fn is_none(&self) -> bool {
        self.differences.is_empty()
    }
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.differences.join("; "))
    }
}

/// Returns the message that a sidecar belongs to a different sweep than the rows. `differences` contains the
/// differences between the settings in the sidecar and in the journal.
pub fn foreign_sidecar(differences: &[String]) -> String {
    format!("its sidecar belongs to another sweep: {}", differences.join("; "))
}

/// Returns the ranges of rows in the changed blocks. A block is changed if its checksums in `found` and
/// in `written` differ. Rows are counted from 1, and `last` is the number of the last row.
///
/// A range contains all rows of a changed block, even if only one row of the block has changed. If a row was
/// removed or added, all later rows count as changed.
fn changed_rows(found: &[u32], written: &[u32], last: u64) -> Vec<RangeInclusive<u64>> {
    let mut ranges: Vec<RangeInclusive<u64>> = Vec::new();
    let blocks = written.len().max(found.len());
    for block in (1..blocks).filter(|&block| found.get(block) != written.get(block)) {
        let begin = (block as u64 - 1) * u64::from(BLOCK_ROWS) + 1;
        let end = last.min(begin + u64::from(BLOCK_ROWS) - 1).max(begin);
        match ranges.last_mut() {
            Some(range) if range.end() + 1 == begin => *range = *range.start()..=end,
            _ => ranges.push(begin..=end),
        }
    }
    ranges
}

fn listed(ranges: &[RangeInclusive<u64>]) -> String {
    let range = |range: &RangeInclusive<u64>| format!("{} to {}", range.start(), range.end());
    let shown: Vec<String> = ranges.iter().take(MOST_LISTED).map(range).collect();
    let more = match ranges.len().saturating_sub(MOST_LISTED) {
        0 => String::new(),
        more => format!(" and {more} more ranges"),
    };
    shown.join(", ") + &more
}

/// Reason why results cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The file name has no supported ending, such as `.csv`.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The operating system reports an error, or the contents of the file do not match the ending of the file
    /// name.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// The sidecar cannot be read or is damaged.
    #[error(transparent)]
    Sidecar(#[from] SidecarError),
    /// Another program has changed the results.
    #[error("{} is damaged: {damage}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The damage.
        damage: Box<Damage>,
    },
}

/// A message for the user about damaged or unverified results.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Note {
    /// Another program has changed the results.
    #[error("{} is damaged: {damage}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The damage.
        damage: Damage,
    },
    /// The sidecar is damaged or has an unknown format.
    #[error("{0}")]
    Sidecar(String),
    /// The results are unfinished.
    #[error("{} is unfinished: {}", path.display(), so_far(*done))]
    Unfinished {
        /// The file.
        path: PathBuf,
        /// Number of finished points, if known. A point is finished if all its rows are written, or if a
        /// condition excludes the point.
        done: Option<u64>,
    },
    /// The results cannot be checked.
    #[error("{} could not be verified: {why}", path.display())]
    Unverified {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: &'static str,
    },
}

const NO_SIDECAR: &str = "there is no sidecar beside the file";
const NO_CHECKSUMS: &str = "the sidecar has no checksums";

fn so_far(done: Option<u64>) -> String {
    match done {
        Some(done) => {
            format!("{} done so far; `flap results resume` continues the run", count(done, "point"))
        }
        None => "the file has fewer rows than points".to_owned(),
    }
}

/// Compares the complete results at `path` with the checksums in `sidecar`, and returns the damage. Returns
/// `None` if the results are undamaged, or if the sidecar has no checksums.
///
/// The function reads the file once. If the checksum of all bytes is wrong, the function reads the file again
/// to find the changed rows.
///
/// # Errors
/// - [`OpenError::Read`] if the file cannot be read.
/// - [`OpenError::Damaged`] if the file is damaged and `on_damage` is [`OnDamage::Refuse`].
pub fn check(
    path: &Path,
    format: Format,
    sidecar: &Sidecar,
    on_damage: OnDamage,
) -> Result<Option<Damage>, OpenError> {
    let Some(checksums) = sidecar.checksums.as_ref() else { return Ok(None) };
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    let bytes = match &checksums.file {
        Some(sum) if File::open(path).and_then(FileSum::of).map_err(unreadable)? == *sum => return Ok(None),
        sum => sum.is_some(),
    };
    let mut damage = locate(path, format, sidecar, checksums).map_err(unreadable)?;
    if bytes && damage.is_none() {
        let difference = "the rows are unchanged, but other bytes of the file have changed";
        damage.differences.push(difference.to_owned());
    }
    if damage.is_none() {
        return Ok(None);
    }
    match on_damage {
        OnDamage::Refuse => Err(OpenError::Damaged { path: path.to_owned(), damage: Box::new(damage) }),
        OnDamage::Tolerate => Ok(Some(damage)),
    }
}

/// Reads all rows of the file to find the damaged rows, and returns the damage.
fn locate(path: &Path, format: Format, sidecar: &Sidecar, checksums: &Checksums) -> io::Result<Damage> {
    let (found, read) = sum_up(File::open(path)?, format);
    let unreadable = match read {
        Ok(()) => None,
        Err(error) if error.raw_os_error().is_some() => return Err(error),
        Err(error) => Some(error.to_string()),
    };
    Ok(Damage::of_text(&found, checksums, sidecar.rows(), unreadable))
}

/// Largest length of a row in a result file, in bytes.
const LONGEST_ROW: u64 = 1 << 20;

/// Format of the file that contains the rows of a Parquet file until the Parquet file is complete.
const WAITING: Format = Format::CsvZstd;

/// Results that are open for reading.
pub struct Opened {
    /// Reader of the rows.
    pub reader: Reader,
    /// Sidecar of the rows; `None` if the sidecar is missing, unreadable or from a different sweep.
    pub sidecar: Option<Sidecar>,
    /// Notes for the user.
    pub notes: Vec<Note>,
}

/// Returns the column names of the complete or unfinished results at `path`.
///
/// The function reads only the part of the file that contains the column names, and does not check the rows.
///
/// # Errors
/// - [`OpenError::Format`] if the file name has no supported ending, such as `.csv`.
/// - [`OpenError::Read`] if the file cannot be read.
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

/// Opens the results at `path` for reading. If the results are unfinished, the reader stops at the last
/// checkpoint of the journal. Without a usable journal, the reader stops at the last complete row.
///
/// # Errors
/// - [`OpenError::Format`] if the file name has no supported ending, such as `.csv`.
/// - [`OpenError::Read`] if the file cannot be read.
/// - [`OpenError::Sidecar`] if the sidecar cannot be read, or if it is damaged and `on_damage` is
///   [`OnDamage::Refuse`].
/// - [`OpenError::Damaged`] if the results are damaged and `on_damage` is [`OnDamage::Refuse`].
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
            None => Some(Note::Unverified { path: path.to_owned(), why: NO_CHECKSUMS }),
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
            notes.push(Note::Unverified { path: path.to_owned(), why: NO_SIDECAR });
        }
        Reader::new(File::open(path).map_err(unreadable)?, format).map_err(unreadable)?
    };
    if on_damage == OnDamage::Tolerate {
        reader.tolerate();
    }
    Ok(Opened { reader, sidecar, notes })
}

/// Returns the sidecar of the results at `path`, or `None` if the sidecar is missing or cannot be used. Adds
/// a note about an unusable sidecar to `notes`.
fn beside(path: &Path, on_damage: OnDamage, notes: &mut Vec<Note>) -> Result<Option<Sidecar>, OpenError> {
    let beside = sidecar_of(path);
    match Sidecar::read(&beside) {
        Ok(sidecar) => Ok(Some(sidecar)),
        Err(SidecarError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error @ SidecarError::Damaged { .. }) if on_damage == OnDamage::Tolerate => {
            notes.push(Note::Sidecar(error.to_string()));
            Ok(Sidecar::read_damaged(&beside).ok())
        }
        // The file may belong to another version or another program.
        Err(error @ SidecarError::Format { .. }) => {
            notes.push(Note::Sidecar(error.to_string()));
            Ok(None)
        }
        Err(error) => Err(error.into()),
    }
}

/// Returns a reader of the complete rows in an unfinished file. The reader leaves out an incomplete last
/// line.
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

/// Returns a reader of unfinished results that stops at the last checkpoint of the journal.
///
/// The rows must have the checksums that the journal records. If the rows have different checksums and
/// `on_damage` tolerates damage, the reader returns all complete rows. If the sidecar is from a different
/// sweep and damage is tolerated, the function sets `sidecar` to `None`.
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
    let foreign = sidecar.as_ref().map_or(Vec::new(), |sidecar| own.differences(&sidecar.identity));
    let is_foreign = !foreign.is_empty();
    let lost = intact.as_ref().map_or(0, |intact| intact.lost);
    let mut damage = Damage { differences: Vec::new(), lost };
    if intact.is_none() {
        damage.differences.push("the file has changed since the sweep wrote it".to_owned());
    }
    if lost > 0 {
        let rows = count(lost, "row");
        damage.differences.push(format!("it lacks {rows} that its journal records"));
    }
    if is_foreign {
        damage.differences.push(foreign_sidecar(&foreign));
    }
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
        Some(intact) if lost == 0 => Reader::of_text(file.take(intact.checkpoint.file.bytes), text),
        _ => whole_rows(file, text),
    }
    .map_err(unreadable)
}

/// Result of a check of result files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Integrity {
    /// The results are unchanged since they were written.
    Sound {
        /// Number of rows.
        rows: u64,
    },
    /// The results are unfinished. The rows are unchanged since flap wrote them.
    Unfinished {
        /// Number of finished points, if the number is known.
        done: Option<u64>,
    },
    /// The results cannot be checked. The text contains the reason.
    Unverified(&'static str),
    /// Another program has changed the results.
    Damaged(Damage),
}

/// Checks the results at `path` completely: every byte of the file, and every row.
///
/// # Errors
/// - [`OpenError::Format`] if the file name has no supported ending, such as `.csv`.
/// - [`OpenError::Read`] if the results cannot be read.
/// - [`OpenError::Sidecar`] if the sidecar cannot be read, or is damaged.
pub fn verify(path: &Path) -> Result<Integrity, OpenError> {
    match Sidecar::read(&sidecar_of(path)) {
        Err(SidecarError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => {}
        read => drop(read?),
    }
    let opened = match open(path, OnDamage::Refuse) {
        Err(OpenError::Damaged { damage, .. }) => return Ok(Integrity::Damaged(*damage)),
        opened => opened?,
    };
    for note in &opened.notes {
        match note {
            Note::Unfinished { done, .. } => return Ok(Integrity::Unfinished { done: *done }),
            Note::Unverified { why, .. } => return Ok(Integrity::Unverified(why)),
            Note::Damaged { .. } | Note::Sidecar(_) => {}
        }
    }
    let Some(sidecar) = opened.sidecar else { return Ok(Integrity::Unverified(NO_SIDECAR)) };
    let Some(checksums) = &sidecar.checksums else {
        return Ok(Integrity::Unverified(NO_CHECKSUMS));
    };
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    // The file's bytes are unchanged. This checks that reading them gives the computed rows.
    let damage = locate(path, Format::of(path)?, &sidecar, checksums).map_err(unreadable)?;
    if damage.is_none() {
        return Ok(Integrity::Sound { rows: sidecar.rows().unwrap_or_default() });
    }
    Ok(Integrity::Damaged(damage))
}
