//! Computation of measures from a motion, for any model.
//!
//! - [`cycle`]: means, extrema and first harmonics of the signals over one drive period
//! - [`quarters`]: extrema of the signals in each quarter of a drive period
//! - `size`: the largest magnitude of each component of the state
//! - [`multipliers`]: the monodromy matrix of an orbit and its Floquet multipliers
//! - [`strobe`]: test for a periodic motion, from the states at the ends of the drive periods

pub mod cycle;
pub mod multipliers;
pub mod quarters;
pub(crate) mod size;
mod step_polynomial;
pub mod strobe;
