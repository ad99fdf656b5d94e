//! What is measured of a motion, whatever the model.
//!
//! - [`cycle`]: signals over one drive period: means, extrema, first harmonics
//! - [`strobe`]: whether the state repeats from period to period
//! - [`damped_sine`], [`spectrum`]: frequencies of a motion that dies away

pub mod cycle;
pub mod damped_sine;
pub mod spectrum;
pub mod strobe;
pub mod tracking;
