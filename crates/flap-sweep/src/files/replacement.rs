//! Removes and replaces result files and the files beside them. The functions of this module change only
//! files that flap wrote.
//!
//! The checksum of the first line shows that flap wrote a journal. The entries of a sidecar show that
//! flap wrote the sidecar. If a journal exists, flap also wrote the file `<results>.part`, because flap
//! creates a journal only if there is no file `<results>.part`.
//!
//! With `--restart`, the earlier results keep their names until the new results are complete. Until the new
//! results of `rows.csv` are complete, flap writes them to `rows.new.csv`, with a sidecar and a journal
//! beside this file. The journal records that `rows.new.csv` is a replacement, so flap never treats a user's
//! file with this name as a replacement.
//!
//! If the sidecar is missing, flap reports the results as unverified. If the sidecar was written for
//! different rows, flap reports damage. The function [`commit`] therefore removes the earlier sidecar,
//! renames the rows, and then writes the new sidecar. If the process is killed during a replacement, the next
//! call of [`commit`] completes the replacement.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::beside::{journal_of, part_of, rows_of, sidecar_of};
use super::results::Format;
use super::sidecar::Sidecar;
use super::{disk, journal};

/// Returns true if there is a sidecar beside the results, even if the sidecar is damaged.
pub(crate) fn has_sidecar(results: &Path) -> bool {
    Sidecar::read_damaged(&sidecar_of(results)).is_ok()
}

/// Returns true if there is a journal beside the results.
///
/// # Errors
/// Returns the error of the operating system if a file with the name of the journal cannot be read.
pub(crate) fn has_journal(results: &Path) -> io::Result<bool> {
    Ok(journal::read(&journal_of(results))?.is_some())
}

/// Removes the file `<results>.part` with the rows of an unfinished Parquet file, then the journal. If the
/// process is killed before it removes the journal, the journal still shows that flap wrote the remaining
/// files.
///
/// # Errors
/// Returns the error of the operating system if a file cannot be removed.
pub(crate) fn remove_progress(results: &Path) -> io::Result<()> {
    if has_journal(results)? {
        if Format::of(results).is_ok_and(Format::is_columnar) {
            disk::remove_if_there(&part_of(results))?;
        }
        disk::remove_if_there(&journal_of(results))?;
    }
    Ok(())
}

/// Removes the sidecar, the file `<results>.part` of an unfinished Parquet file, and the journal.
///
/// # Errors
/// Returns the error of the operating system if a file cannot be removed.
pub(crate) fn remove_companions(results: &Path) -> io::Result<()> {
    if has_sidecar(results) {
        disk::remove_if_there(&sidecar_of(results))?;
    }
    remove_progress(results)
}

/// Returns the path of the unfinished file that will replace `results`, such as `rows.new.csv`. Returns
/// `None` if there is no such file.
pub fn unfinished(results: &Path) -> Option<PathBuf> {
    let new = of(results);
    let past = journal::read(&journal_of(&new)).ok()??;
    past.header.replaces.then_some(new)
}

/// Returns the path of the results that `flap results resume` continues. The path is the unfinished
/// replacement of `results` if there is one, and otherwise `results`.
pub fn to_resume(results: &Path) -> PathBuf {
    unfinished(results).filter(|new| sidecar_of(new).exists()).unwrap_or_else(|| results.to_owned())
}

/// Returns the path of the new file that will replace `results`, such as `rows.new.csv`. If `results` is a
/// link, the new file is in the folder of the link's target.
pub(crate) fn of(results: &Path) -> PathBuf {
    Format::with_word(&disk::target(results), "new")
}

/// Returns true if the replacement `new` has a journal, but neither rows nor a sidecar. A killed process
/// leaves only the journal if it has already replaced the results, or has already removed the unfinished
/// replacement.
pub(crate) fn is_over(new: &Path, format: Format) -> bool {
    !disk::is_taken(&sidecar_of(new)) && disk::is_empty(new) && disk::is_empty(&rows_of(new, format))
}

/// Removes the unfinished replacement of `results` with its sidecar and its journal, if there is a
/// replacement.
///
/// # Errors
/// Returns the error of the operating system if a file cannot be removed.
pub(crate) fn discard(results: &Path) -> io::Result<()> {
    let Some(new) = unfinished(results) else { return Ok(()) };
    disk::remove_if_there(&new)?;
    // The journal is removed last: without it, the other files could not be identified.
    remove_companions(&new)
}

/// Replaces the file `results` and its sidecar by the complete new file and the new sidecar.
///
/// # Errors
/// Returns the error of the operating system if a file cannot be renamed, written or removed. After an error,
/// the next call of [`commit`] continues the interrupted replacement.
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
