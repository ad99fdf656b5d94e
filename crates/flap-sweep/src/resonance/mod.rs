//! Resonances of designs: drive frequencies at which stroke, lift or efficiency is largest.
//!
//! - [`AtResonance`]: computes the row of each design at the resonance of this design.
//! - [`driven`]: searches for the highest peaks of one design over the drive frequency. The function
//!   [`impulse()`] checks the size of an impulse for the analysis of free motions.
//! - `search`: searches for the resonance of a design, or for all its peaks.
//! - `target`: the quantity that is largest at the resonance, and the range of the search.
//! - [`sequence`]: computations in which the rows of earlier points determine the next points.

pub mod driven;
mod rows;
mod search;
pub mod sequence;
mod target;

pub use driven::impulse;
pub use rows::{AtResonance, RESONANCE_HZ, RESONANCE_MARGIN_HZ, measures};
pub use target::{AT_RESONANCE, DRIVE_FREQUENCY, Objective, Range};
