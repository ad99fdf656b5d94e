//! Writes motions over time to files.

use std::io;
use std::path::Path;

use flap_core::simulate::Trajectory;
use flap_sweep::notation::text::count;

use crate::console::{self, is_stdout};
use crate::failure::Failure;
use crate::job;
use crate::print::{Keyed, write_motions};

/// Writes a motion to a CSV file, and prints the number of rows. `row` is the word that flap prints for a
/// row, such as "sample". If the path is `-`, the motion goes to stdout.
///
/// # Errors
///
/// `Usage` if the file exists and `overwrite` is false, `System` if the file cannot be written. After an
/// error, no incomplete file remains.
pub(crate) fn write_file(
    motion: &Trajectory,
    path: &Path,
    overwrite: bool,
    row: &str,
) -> Result<(), Failure> {
    write_motions_file(&[Keyed { keys: &[], motion }], path, overwrite, row)
}

/// Writes several motions into one CSV file as [`write_file`] does. The motions are one below the other.
pub(crate) fn write_motions_file(
    motions: &[Keyed<'_>],
    path: &Path,
    overwrite: bool,
    row: &str,
) -> Result<(), Failure> {
    if is_stdout(path) {
        return Ok(write_motions(motions, io::stdout().lock())?);
    }
    let written = job::make(path, overwrite, |file| write_motions(motions, file).map(|()| None))?;
    written.map_err(|error: io::Error| Failure::cannot_write(path, &error))?;
    let rows: usize = motions.iter().map(|keyed| keyed.motion.rows.len()).sum();
    console::say(&format!("{} in {}", count(rows as u64, row), path.display()));
    Ok(())
}
