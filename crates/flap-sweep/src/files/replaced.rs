//! Results that are to be replaced: they are kept beside the new ones until those are complete.
//!
//! `rows.csv` becomes `rows.old.csv`, and the files beside it are renamed with it. The journal of the new results records
//! this, so that only files which flap has renamed are ever removed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::files::beside;
use crate::files::disk;
use crate::files::journal;
use crate::files::results::Format;

/// The file of the earlier results that the unfinished ones at `results` replace, such as `rows.old.csv`. `None` if there is
/// none.
pub fn kept(results: &Path) -> Option<PathBuf> {
    let past = journal::read(&beside::journal_of(results)).ok()??;
    Some(aside(&target(results))).filter(|kept| past.header.replaces && kept.exists())
}

/// Moves the results at `results` aside, with the files beside them.
///
/// # Errors
/// - [`io::ErrorKind::AlreadyExists`] if a file of the new name is in the way
/// - the error of the operating system if a file cannot be renamed
///
/// All files then have their old names.
pub(crate) fn set_aside(results: &Path) -> io::Result<()> {
    let moves = moves(results);
    for (_, to) in &moves {
        if fs::symlink_metadata(to).is_ok() {
            let message = format!(
                "{} exists already, and the earlier results would be kept under this name",
                to.display()
            );
            return Err(io::Error::new(io::ErrorKind::AlreadyExists, message));
        }
    }
    for (number, (from, to)) in moves.iter().enumerate() {
        if let Err(error) = rename(from, to) {
            moves[..number].iter().for_each(|(from, to)| drop(rename(to, from)));
            return Err(error);
        }
    }
    Ok(())
}

/// Moves earlier results back, in place of new ones without rows.
pub(crate) fn restore(results: &Path) {
    for (from, to) in moves(results) {
        // A file that cannot be renamed keeps the name that the documentation gives.
        if to.exists() {
            let _ = rename(&to, &from);
        } else {
            let _ = fs::remove_file(&from);
        }
    }
}

/// Removes the earlier results.
///
/// # Errors
/// The error of the operating system if a file cannot be removed.
pub(crate) fn remove(results: &Path) -> io::Result<()> {
    for (_, to) in moves(results) {
        disk::remove_if_there(&to)?;
    }
    Ok(())
}

/// The old and new names of the files that are moved, the rows last.
fn moves(results: &Path) -> Vec<(PathBuf, PathBuf)> {
    let rows = target(results);
    let kept = aside(&rows);
    let beside = beside::all_of(results).into_iter().zip(beside::all_of(&aside(results)));
    beside.chain([(rows, kept)]).collect()
}

/// The new name: `rows.old.csv` for `rows.csv`.
fn aside(results: &Path) -> PathBuf {
    let name = results.file_name().unwrap_or_default().to_string_lossy();
    let (stem, ending) = Format::split_ending(&name);
    results.with_file_name(format!("{stem}.old{ending}"))
}

/// The file that is moved: the target of a link, so that the link itself stays.
fn target(results: &Path) -> PathBuf {
    let is_link = fs::symlink_metadata(results).is_ok_and(|metadata| metadata.is_symlink());
    let target = is_link.then(|| fs::canonicalize(results).ok()).flatten();
    target.unwrap_or_else(|| results.to_owned())
}

/// Renames a file, if there is one.
fn rename(from: &Path, to: &Path) -> io::Result<()> {
    match fs::symlink_metadata(from) {
        Ok(metadata) if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(_) => fs::rename(from, to),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        Err(error) => Err(error),
    }
}
