//! Results that are replaced: they wait beside the new ones until those are complete.
//!
//! `rows.csv` becomes `rows.old.csv`, and what lies beside it keeps lying beside it. The journal of the new results says that
//! it was done, so that only what flap has moved is ever removed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::files::journal;
use crate::files::results::Format;
use crate::files::session;
use crate::files::sidecar;

/// Where the results that those at `results` replace wait; `None` if there are none.
pub(crate) fn kept(results: &Path) -> Option<PathBuf> {
    let past = journal::read(&journal::path_of(results)).ok()??;
    Some(aside(&target(results))).filter(|kept| past.header.replaces && kept.exists())
}

/// Moves the results at `results` aside, with what lies beside them.
///
/// # Errors
/// If something is in the way, or the operating system refuses. Then all is where it was.
pub(crate) fn set_aside(results: &Path) -> io::Result<()> {
    let moves = moves(results);
    for (_, to) in &moves {
        if fs::symlink_metadata(to).is_ok() {
            let message = format!("{} is in the way: the earlier results would wait there", to.display());
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

/// Moves earlier results back, in place of new ones that nothing was written to.
pub(crate) fn restore(results: &Path) {
    for (from, to) in moves(results) {
        // A name that cannot be moved stays where the documentation says.
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
/// What the operating system says.
pub(crate) fn remove(results: &Path) -> io::Result<()> {
    for (_, to) in moves(results) {
        session::remove_if_there(&to)?;
    }
    Ok(())
}

/// The files that are moved, and where to: the rows last.
fn moves(results: &Path) -> [(PathBuf, PathBuf); 4] {
    let beside = |of: fn(&Path) -> PathBuf| (of(results), of(&aside(results)));
    let rows = target(results);
    let aside = aside(&rows);
    [beside(sidecar::path_of), beside(journal::path_of), beside(session::part_of), (rows, aside)]
}

/// `rows.old.csv` for `rows.csv`.
fn aside(results: &Path) -> PathBuf {
    let name = results.file_name().unwrap_or_default().to_string_lossy();
    let (stem, ending) = Format::split_ending(&name);
    results.with_file_name(format!("{stem}.old{ending}"))
}

/// The file that the name stands for: a link stays a link.
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
