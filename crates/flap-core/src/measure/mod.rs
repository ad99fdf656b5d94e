//! What is measured of a motion, whatever the model.
//!
//! - [`cycle`]: signals over one drive period: means, extrema, first harmonics
//! - [`size`]: the largest magnitude of each state
//! - [`strobe`]: whether the state repeats from period to period
//! - [`damped_sine`], [`spectrum`]: frequencies of a motion that dies away

mod course;
pub mod cycle;
pub mod damped_sine;
pub mod size;
pub mod spectrum;
pub mod strobe;
pub mod tracking;
