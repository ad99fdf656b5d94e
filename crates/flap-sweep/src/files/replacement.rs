//! Files beside results that flap wrote. The functions of this module remove and replace only files that flap wrote.
//!
//! A journal is recognised by the checksum of its first line, and a sidecar is recognised by its entries. The rows of
//! an unfinished Parquet file belong to the journal in the same folder. flap begins a journal only if the name of these
//! rows is free.
//!
//! With `--restart`, the earlier results keep their names until the new results are complete. Until the new results of
//! `rows.csv` are complete, they are in `rows.new.csv`, with a sidecar and a journal of this name. The journal records
//! that the new results are a replacement, so flap never mistakes another file of this name for a replacement.
//!
//! Results without a sidecar are reported as not verified, not as damaged. [`commit`] therefore removes the earlier
//! sidecar, renames the rows, and then writes the new sidecar. If the process is killed at any time, the next call
//! completes the replacement.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::beside::{journal_of, part_of, rows_of, sidecar_of};
use super::results::Format;
use super::sidecar::Sidecar;
use super::{disk, journal};

/// Returns true if there is a sidecar beside the results, damaged or not.
pub(crate) fn has_sidecar(results: &Path) -> bool {
    Sidecar::read_damaged(&sidecar_of(results)).is_ok()
}

/// Returns true if there is a journal beside the results.
///
/// # Errors
/// The error of the operating system if a file of this name cannot be read.
pub(crate) fn has_journal(results: &Path) -> io::Result<bool> {
    Ok(journal::read(&journal_of(results))?.is_some())
}

/// Removes the rows of an unfinished Parquet file, then the journal. If the process is killed between the removals, the
/// journal still shows that flap wrote the rows.
///
/// # Errors
/// The error of the operating system if a file cannot be removed.
pub(crate) fn remove_progress(results: &Path) -> io::Result<()> {
    if has_journal(results)? {
        if Format::of(results).is_ok_and(Format::is_columnar) {
            disk::remove_if_there(&part_of(results))?;
        }
        disk::remove_if_there(&journal_of(results))?;
    }
    Ok(())
}

/// Removes the sidecar, the rows of an unfinished Parquet file, and the journal.
///
/// # Errors
/// The error of the operating system if a file cannot be removed.
pub(crate) fn remove_companions(results: &Path) -> io::Result<()> {
    if has_sidecar(results) {
        disk::remove_if_there(&sidecar_of(results))?;
    }
    remove_progress(results)
}

/// Returns the unfinished replacement of the results at `results`, such as `rows.new.csv`; `None` if there is no
/// replacement.
pub fn unfinished(results: &Path) -> Option<PathBuf> {
    let new = of(results);
    let past = journal::read(&journal_of(&new)).ok()??;
    past.header.replaces.then_some(new)
}

/// Returns the results that `flap results resume` continues: the unfinished replacement of `results`, or `results` if
/// there is no replacement.
pub fn to_resume(results: &Path) -> PathBuf {
    unfinished(results).filter(|new| sidecar_of(new).exists()).unwrap_or_else(|| results.to_owned())
}

/// Returns the path of a replacement. The replacement is in the folder of the rows, also if `results` is a link to the
/// rows.
pub(crate) fn of(results: &Path) -> PathBuf {
    Format::with_word(&disk::target(results), "new")
}

/// Returns true if only the journal of the replacement `new` is left. In this case, the replacement has replaced the
/// earlier results, or was discarded.
pub(crate) fn is_over(new: &Path, format: Format) -> bool {
    !disk::is_taken(&sidecar_of(new)) && disk::is_empty(new) && disk::is_empty(&rows_of(new, format))
}

/// Discards the unfinished replacement of `results`, if there is a replacement.
///
/// # Errors
/// The error of the operating system if a file cannot be removed.
pub(crate) fn discard(results: &Path) -> io::Result<()> {
    let Some(new) = unfinished(results) else { return Ok(()) };
    disk::remove_if_there(&new)?;
    // The journal is removed last: without it, the other files could not be identified.
    remove_companions(&new)
}

/// Replaces `results` by their complete replacement with its sidecar.
///
/// # Errors
/// The error of the operating system if a file cannot be renamed, written or removed. After an error, the next call
/// continues the replacement.
pub(crate) fn commit(results: &Path) -> io::Result<()> {
    let new = of(results);
    let beside = sidecar_of(&new);
    if new.exists() {
        if Format::of(&new).is_ok_and(Format::is_columnar) {
            disk::remove_if_there(&part_of(&new))?;
        }
        remove_companions(results)?;
        disk::rename(&new, &disk::target(results))?;
    }
    if beside.exists() {
        // The sidecar is copied, because a link to the rows and its sidecar may be in another file system.
        let whole = disk::Whole::begin(&sidecar_of(results))?;
        whole.file().write_all(&fs::read(&beside)?)?;
        whole.commit()?;
        fs::remove_file(&beside)?;
    }
    remove_progress(&new)
}
