//! What is measured of a motion, whatever the model.
//!
//! - [`cycle`]: signals over one drive period: means, extrema, first harmonics
//! - [`strobe`]: whether the state repeats from period to period

pub mod cycle;
pub mod strobe;
pub mod tracking;
