#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! Each module uses only modules above it in this list:
//!
//! - `system`: operations that differ between operating systems.
//! - [`notation`]: numbers, units, times and formulas as text.
//! - [`input`]: text of input files, with a limit on their size.
//! - [`derivative`]: derivatives of measures: names, units, and sizes of changes.
//! - [`resonance`]: rows of designs, each at its own resonance.
//! - [`vehicle`]: control matrix, trims, stability of hover and flight of vehicles, and rows with these numbers.
//! - [`plan`]: the design space: axes, samples, derived parameters, conditions, selections.
//! - [`table`]: columns of rows, rows as text, formats of files.
//! - [`refine`]: the points that a refined grid adds after the points of its axes.
//! - [`picture`]: properties of pictures that are the same in the command line and in Python.
//! - [`grid`]: conversion of grid files to plans, with diagnostics.
//! - [`run`]: the parallel runner, which passes rows to sinks in the order of the points.
//! - [`study`]: response curves, deviations of parameters, most important parameters, surveys of a plan, optima.
//! - [`files`]: result files: formats, sidecars, journals, checksums; resuming, merging, running again.

pub mod derivative;
pub mod files;
pub mod grid;
pub mod input;
pub mod notation;
pub mod picture;
pub mod plan;
pub mod refine;
pub mod resonance;
pub mod run;
pub mod study;
mod system;
pub mod table;
pub mod vehicle;
