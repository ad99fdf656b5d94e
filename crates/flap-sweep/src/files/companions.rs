//! The files beside results that flap wrote itself. No other files are ever removed or replaced.
//!
//! A journal is recognised by the checksum of its first line, a sidecar by its entries. Waiting rows belong to the journal
//! beside them: it is begun only where there is no file of their name.

use std::io;
use std::path::Path;

use crate::files::beside::{journal_of, part_of, sidecar_of};
use crate::files::disk;
use crate::files::journal;
use crate::files::results::Format;
use crate::files::sidecar::Sidecar;

/// True if there is a sidecar beside the results, damaged or not.
pub(crate) fn has_sidecar(results: &Path) -> bool {
    Sidecar::read_damaged(&sidecar_of(results)).is_ok()
}

/// True if there is a journal beside the results.
///
/// # Errors
/// The error of the operating system if a file of that name cannot be read.
pub(crate) fn has_journal(results: &Path) -> io::Result<bool> {
    Ok(journal::read(&journal_of(results))?.is_some())
}

/// Removes the waiting rows and the journal. Killed in between, the journal still names the rows as flap's.
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

/// Removes the sidecar, the waiting rows and the journal.
///
/// # Errors
/// The error of the operating system if a file cannot be removed.
pub(crate) fn remove(results: &Path) -> io::Result<()> {
    if has_sidecar(results) {
        disk::remove_if_there(&sidecar_of(results))?;
    }
    remove_progress(results)
}
