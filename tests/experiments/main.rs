//! Tests of flap-experiments: fits, spectra, free motions and tracked wings.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests may panic and print")]

mod damped_sines;
#[path = "../core/data.rs"]
mod data;
mod free;
mod frequencies;
mod tracking;
