#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! A module in the following list uses only modules above itself:
//!
//! - `system`: operations that differ between operating systems.
//! - [`notation`]: conversion of numbers, units, times and formulas from text and to text.
//! - [`input`]: reads input files, with a limit on the size of each file.
//! - [`derivative`]: derivatives of measures: names and units of columns, and reference sizes of parameters.
//! - [`resonance`]: search for the resonance of a design, and rows of designs at their resonances.
//! - [`vehicle`]: control matrix, trims, stability of hover and flight of vehicles, and rows that contain
//!   these results.
//! - [`plan`]: the design space: axes, samples, derived parameters, conditions, selections.
//! - [`table`]: columns of results, rows as text, and file formats.
//! - [`refine`]: the points that a refined grid adds after the points of its axes.
//! - [`picture`]: properties of pictures that are the same in the command line and in Python.
//! - [`grid`]: conversion of grid files to plans, with diagnostics.
//! - [`run`]: the parallel computation of rows, which are passed to outputs (sinks) in the order of the
//!   points.
//! - [`study`]: studies of designs, such as response curves, tolerances of parameters, most important
//!   parameters and optima.
//! - [`files`]: result files with their sidecars, journals and checksums. The module also resumes, merges and
//!   repeats sweeps.

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
