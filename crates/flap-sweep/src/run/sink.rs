//! Where rows go.

use std::io;

use flap_core::simulate::{Point, Row};

use crate::run::Summary;

/// Takes the rows of a sweep in point order.
///
/// Calls come as `begin`, then any number of `write`, `done` and `flush`, then `finish`; nothing comes after an error.
pub trait Sink {
    /// Writes what stands before the rows.
    ///
    /// # Errors
    /// What writing says.
    fn begin(&mut self) -> io::Result<()>;

    /// Takes the next row.
    ///
    /// # Errors
    /// What writing says.
    fn write(&mut self, point: &Point, row: &Row) -> io::Result<()>;

    /// Told after every point what the run has come to, so that it can be resumed after it.
    ///
    /// # Errors
    /// What noting it says.
    fn done(&mut self, so_far: &Summary) -> io::Result<()> {
        let _ = so_far;
        Ok(())
    }

    /// Hands what has been written to the operating system, so that a killed process loses little.
    /// Called after every batch of rows, several times a second.
    ///
    /// # Errors
    /// What writing says.
    fn flush(&mut self) -> io::Result<()>;

    /// Completes the output and makes it durable.
    ///
    /// # Errors
    /// What writing says.
    fn finish(&mut self) -> io::Result<()>;
}
