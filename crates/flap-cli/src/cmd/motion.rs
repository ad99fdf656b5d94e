//! Motions and tables of numbers as CSV.

use std::io::{self, Write};
use std::path::Path;

use flap_core::simulate::Trajectory;
use flap_sweep::{csv_sink, output, text};

use crate::failure::Failure;

/// Writes to a file, which must not exist unless it may be overwritten.
pub(crate) fn write_file(motion: &Trajectory, path: &Path, overwrite: bool) -> Result<(), Failure> {
    let refused = |error| Failure::System(format!("cannot write {}: {error}", path.display()), Vec::new());
    let file = output::create(path, overwrite)?;
    output::empty(&file).and_then(|()| write_csv(motion, file)).map_err(refused)
}

/// Writes one line per row.
pub(crate) fn write_csv(motion: &Trajectory, target: impl Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(target);
    writer.write_record(&motion.columns).map_err(csv_sink::cause)?;
    for row in &motion.rows {
        let cells = row.iter().map(|&value| text::float(value));
        writer.write_record(cells).map_err(csv_sink::cause)?;
    }
    writer.flush()
}
