//! Measurements of a motion, for any model.
//!
//! - [`cycle`]: signals over one drive period: means, extrema, first harmonics
//! - [`quarters`]: extrema in each quarter of a drive period
//! - `size`: the largest magnitude of each state
//! - [`multipliers`]: the monodromy matrix of an orbit and its Floquet multipliers
//! - [`strobe`]: repetition of the state from period to period

pub mod cycle;
pub mod multipliers;
pub mod quarters;
pub(crate) mod size;
mod step_polynomial;
pub mod strobe;
