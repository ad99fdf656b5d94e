//! New results that are to replace earlier ones (`--restart`).
//!
//! The earlier results keep their names until the new ones are complete. Until then the new results of `rows.csv` are
//! `rows.new.csv`, with a sidecar and a journal of that name. The journal records that they are a replacement, so a file that
//! only has such a name is never taken for one.
//!
//! Results without a sidecar count as unverified, never as damaged. [`commit`] therefore removes the earlier sidecar before it
//! renames the rows, and writes the new sidecar afterwards. It may be killed anywhere, and completes its work when it is called
//! again.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::files::beside::{journal_of, part_of, replacement_of, rows_of, sidecar_of};
use crate::files::companions;
use crate::files::disk;
use crate::files::journal;
use crate::files::results::Format;

/// The unfinished replacement of the results at `results`, such as `rows.new.csv`. `None` if there is none.
pub fn unfinished(results: &Path) -> Option<PathBuf> {
    let new = of(results);
    let past = journal::read(&journal_of(&new)).ok()??;
    past.header.replaces.then_some(new)
}

/// The results that `flap results resume` continues: the unfinished replacement if there is one, else `results`.
pub fn to_resume(results: &Path) -> PathBuf {
    unfinished(results).filter(|new| sidecar_of(new).exists()).unwrap_or_else(|| results.to_owned())
}

/// The path of a replacement: it lies beside the rows, wherever a link to them is.
pub(crate) fn of(results: &Path) -> PathBuf {
    replacement_of(&disk::target(results))
}

/// True if nothing but the journal of the replacement `new` is left: it has replaced the earlier results, or was dropped.
pub(crate) fn is_over(new: &Path, format: Format) -> bool {
    !disk::is_taken(&sidecar_of(new)) && disk::is_empty(new) && disk::is_empty(&rows_of(new, format))
}

/// Drops the unfinished replacement of `results`, if there is one.
///
/// # Errors
/// The error of the operating system if a file cannot be removed.
pub(crate) fn discard(results: &Path) -> io::Result<()> {
    let Some(new) = unfinished(results) else { return Ok(()) };
    disk::remove_if_there(&new)?;
    // The journal goes last: without it the others would be nobody's.
    companions::remove(&new)
}

/// Puts the replacement of `results`, which is complete with its sidecar, in their place.
///
/// # Errors
/// The error of the operating system if a file cannot be renamed, written or removed. The next call goes on from there.
pub(crate) fn commit(results: &Path) -> io::Result<()> {
    let new = of(results);
    let beside = sidecar_of(&new);
    if new.exists() {
        if Format::of(&new).is_ok_and(Format::is_columnar) {
            disk::remove_if_there(&part_of(&new))?;
        }
        companions::remove(results)?;
        disk::rename(&new, &disk::target(results))?;
    }
    if beside.exists() {
        // Copied, since a link to the rows and its sidecar may lie in another file system.
        let whole = disk::Whole::begin(&sidecar_of(results))?;
        whole.file().write_all(&fs::read(&beside)?)?;
        whole.commit()?;
        fs::remove_file(&beside)?;
    }
    companions::remove_progress(&new)
}
