//! Measurements of a motion, for any model.
//!
//! - [`cycle`]: signals over one drive period: means, extrema, first harmonics
//! - [`quarters`]: extrema in each quarter of a drive period
//! - [`size`]: the largest magnitude of each state
//! - [`multipliers`]: the monodromy matrix of an orbit and its Floquet multipliers
//! - [`strobe`]: repetition of the state from period to period
//! - [`damped_sine`], [`spectrum`]: frequencies of a motion that dies away
//! - [`tracking`]: stroke and pitch from points in images

mod asked;
mod course;
pub mod cycle;
pub mod damped_sine;
pub mod multipliers;
pub mod quarters;
pub mod size;
pub mod spectrum;
pub mod strobe;
pub mod tracking;
