//! Motions and tables of numbers as CSV.

use std::io::{self, Write};
use std::path::Path;

use flap_core::simulate::Trajectory;
use flap_sweep::files::csv_sink;
use flap_sweep::notation::text::{self, count};

use crate::failure::Failure;
use crate::{console, job};

/// Writes a CSV file, all of it or nothing, and says how many rows it has. `row` is the noun for one, such as `sample`.
///
/// # Errors
///
/// `Usage` if the file exists and `overwrite` is false, `System` if it cannot be written.
pub(crate) fn write_file(
    motion: &Trajectory,
    path: &Path,
    overwrite: bool,
    row: &str,
) -> Result<(), Failure> {
    let written = job::make(path, overwrite, |file| write_csv(motion, file).map(|()| None))?;
    written.map_err(|error: io::Error| Failure::cannot_write(path, &error))?;
    console::say(&format!("{} in {}", count(motion.rows.len() as u64, row), path.display()));
    Ok(())
}

/// Writes a CSV table with one line per row.
pub(crate) fn write_csv(motion: &Trajectory, target: impl Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(target);
    writer.write_record(&motion.columns).map_err(csv_sink::cause)?;
    for row in &motion.rows {
        let cells = row.iter().map(|&value| text::float(value));
        writer.write_record(cells).map_err(csv_sink::cause)?;
    }
    writer.flush()
}
