#![doc = include_str!("../README.md")]
//!
//! # Rooms
//!
//! Each room uses only those above it:
//!
//! - [`notation`]: numbers, units, times and formulas as text
//! - [`input`]: the text of input files, which have a largest size
//! - [`resonance`]: rows of designs that are each run at their own resonance
//! - [`plan`]: the design space: axes, samples, derived parameters, conditions, selections
//! - [`table`]: the columns of rows, rows as text, formats of files
//! - [`picture`]: the choices that pictures of the command and of Python share
//! - [`grid`]: grid files into plans, with diagnostics
//! - [`run`]: the parallel runner, which hands rows to sinks in point order
//! - [`study`]: response curves, deviations of parameters, strongest parameters, surveys of a plan
//! - [`files`]: result files: formats, sidecars, journals, checksums; resumed, merged, run again

pub mod files;
pub mod grid;
pub mod input;
pub mod notation;
pub mod picture;
pub mod plan;
pub mod resonance;
pub mod run;
pub mod study;
pub mod table;
