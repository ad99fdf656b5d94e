//! Checks that results are unchanged since they were written.
//!
//! A sidecar contains two kinds of checksums of complete results. The checksum of the file's bytes is fast to compare.
//! The checksums of blocks of rows locate damage.
//!
//! For unfinished results, the journal records the rows that are safe and the identity of the sweep. Of unfinished
//! results, only the rows that the journal counts are read, and only with a sidecar of the same identity.

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
    /// Readable rows are read, and a [`Note`] reports the damage.
    Tolerate,
}

/// Largest number of ranges in a message. The message also states the number of damaged ranges that it does not list.
const MOST_LISTED: usize = 5;

/// Differences between a result file and the file that flap wrote.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// Descriptions of the differences.
    differences: Vec<String>,
    /// Number of rows in the journal that are missing in the file.
    pub lost: u64,
}

impl Damage {
    /// Returns the damage of a text: the differences between the digest `found` of the text and the `checksums` of
    /// `rows` written rows. `unreadable` is the reason why the rest of the text cannot be read.
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

/// Returns the message about a sidecar of another sweep. `differences` describes how the identities in the sidecar and
/// in the journal differ.
pub fn foreign_sidecar(differences: &[String]) -> String {
    format!("its sidecar belongs to another sweep: {}", differences.join("; "))
}

/// Returns the ranges of rows in changed blocks, counted from 1. `last` is the number of the last row.
///
/// Each block contains at least one changed row. After a missing or additional row, all rows count as changed.
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

/// Error of results that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The ending of the name belongs to no format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The operating system reports an error, or the file does not have the format of its name.
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

/// A note about results for the user.
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
        /// Number of points that have rows or are excluded, if known.
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

/// Returns the damage of the complete results at `path`; `None` if there is no damage, or the sidecar has no checksums.
///
/// The file is read once, and a second time if its bytes have changed.
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

/// Returns the damage of the rows. All rows are read from the file to locate the damage.
fn locate(path: &Path, format: Format, sidecar: &Sidecar, checksums: &Checksums) -> io::Result<Damage> {
    let (found, read) = sum_up(File::open(path)?, format);
    let unreadable = match read {
        Ok(()) => None,
        Err(error) if error.raw_os_error().is_some() => return Err(error),
        Err(error) => Some(error.to_string()),
    };
    Ok(Damage::of_text(&found, checksums, sidecar.rows(), unreadable))
}

/// Longest row of a result file (bytes).
const LONGEST_ROW: u64 = 1 << 20;

/// Format of the file that contains the rows of an unfinished Parquet file.
const WAITING: Format = Format::CsvZstd;

/// Results that are open for reading.
pub struct Opened {
    /// Reader of the rows.
    pub reader: Reader,
    /// Sidecar, if there is a sidecar that belongs to the rows.
    pub sidecar: Option<Sidecar>,
    /// Notes for the user.
    pub notes: Vec<Note>,
}

/// Returns the column names of the results at `path`, complete or not.
///
/// The function reads the beginning of the file, or the end of a Parquet file, and checks nothing.
///
/// # Errors
/// - [`OpenError::Format`] if the ending of the name belongs to no format.
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

/// Opens the results at `path`. Unfinished results end at their last checkpoint.
///
/// # Errors
/// - [`OpenError::Format`] if the ending of the name belongs to no format.
/// - [`OpenError::Read`] if the file cannot be read.
/// - [`OpenError::Sidecar`] if the sidecar cannot be read, or is damaged and `on_damage` is [`OnDamage::Refuse`].
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

/// Returns the sidecar of the results at `path`; `None` if there is no sidecar, or the sidecar cannot be used.
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

/// Returns the complete rows of unfinished results without a journal. The last line may be incomplete.
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

/// Returns the rows of unfinished results up to the last checkpoint.
///
/// All rows must match the journal. If damage is tolerated, the function returns all complete rows, and sets `sidecar`
/// to `None` if the sidecar describes other rows.
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
    /// The results cannot be checked. The variant contains the reason.
    Unverified(&'static str),
    /// Another program has changed the results.
    Damaged(Damage),
}

/// Checks the results at `path` completely: every byte of the file, and every row.
///
/// # Errors
/// - [`OpenError::Format`] if the ending of the name belongs to no format.
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
