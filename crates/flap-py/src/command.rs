//! The command `flap` of an installed wheel.

use std::ffi::OsString;
use std::panic;

use flap_core::simulate;
use pyo3::prelude::*;

/// The exit code of a Rust program that panics.
const PANICKED: u8 = 101;

/// Run a command line and return its exit code. The first word of the line is the name of the program.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, line: Vec<OsString>) -> u8 {
    py.detach(|| {
        // The panic itself prints its message.
        panic::catch_unwind(|| flap_cli::run_line(line, simulate::all().to_vec())).unwrap_or(PANICKED)
    })
}
