//! Motions and waveforms in CSV files.

use std::io::{self, Write};
use std::path::Path;

use flap_core::drive::{Repeat, Samples};
use flap_core::simulate::Trajectory;
use flap_sweep::record::{self, Record};
use flap_sweep::{csv_sink, output, text};

use crate::failure::Failure;

/// Reads a column of a file against its time.
pub(super) fn samples(path: &Path, column: &[(&str, f64)], repeat: Repeat) -> Result<Samples, Failure> {
    column_of(&read(path)?, path, column, repeat)
}

pub(super) fn read(path: &Path) -> Result<Record, Failure> {
    Record::read(path).map_err(|error| Failure::usage(error.to_string()))
}

/// A column of a record against its time.
pub(super) fn column_of(
    record: &Record,
    path: &Path,
    column: &[(&str, f64)],
    repeat: Repeat,
) -> Result<Samples, Failure> {
    let refused = |error: record::RecordError| Failure::usage(error.to_string());
    let times = record.column(record::TIME).map_err(refused)?;
    let values = record.column(column).map_err(refused)?;
    Samples::new(&times, &values, repeat)
        .map_err(|invalid| Failure::usage(format!("{}: {invalid}", path.display())))
}

/// Writes a table to a new file, or over an existing one.
pub(super) fn write(motion: &Trajectory, path: &Path, overwrite: bool) -> Result<(), Failure> {
    let refused = |error| Failure::System(format!("cannot write {}: {error}", path.display()), Vec::new());
    let file = output::create(path, overwrite)?;
    output::empty(&file).and_then(|()| write_csv(motion, file)).map_err(refused)
}

pub(super) fn write_csv(motion: &Trajectory, target: impl Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(target);
    writer.write_record(&motion.columns).map_err(csv_sink::cause)?;
    for row in &motion.rows {
        let cells = row.iter().map(|&value| text::float(value));
        writer.write_record(cells).map_err(csv_sink::cause)?;
    }
    writer.flush()
}
