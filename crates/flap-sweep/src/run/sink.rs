//! The sinks of rows.

use std::io;

use super::summary::Summary;
use crate::table::layout::Cell;

/// Takes the rows of a run in order.
///
/// Calls come as `begin`, then any number of `write`, `done` and `flush`, then `finish`; nothing comes after an error.
pub trait Sink {
    /// Writes the header, if the sink has one.
    ///
    /// # Errors
    /// If it cannot be written.
    fn begin(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Takes the next row: one cell per column.
    ///
    /// # Errors
    /// If it cannot be written.
    fn write(&mut self, cells: &[Cell]) -> io::Result<()>;

    /// Takes the summary of all rows so far, after every row and every excluded point, so that the run can be resumed
    /// there.
    ///
    /// # Errors
    /// If it cannot be noted.
    fn done(&mut self, so_far: &Summary) -> io::Result<()> {
        let _ = so_far;
        Ok(())
    }

    /// Hands the rows so far to the operating system, so that a killed process loses little. Called after every batch of
    /// rows, several times a second. Does nothing for a sink in memory.
    ///
    /// # Errors
    /// If the rows cannot be written.
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// Completes the output and makes it durable. Does nothing for a sink in memory.
    ///
    /// # Errors
    /// If the rows cannot be written.
    fn finish(&mut self) -> io::Result<()> {
        Ok(())
    }
}
