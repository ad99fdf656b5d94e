//! Resonances of designs: drive frequencies at which stroke, lift or efficiency is largest.
//!
//! - [`AtResonance`]: rows of designs, each at its own resonance.
//! - [`driven`]: highest peaks of one design, and with [`impulse()`] the size of an impulse for the analysis of free
//!   motions.
//! - `search`: search for the resonance and for all peaks, and for the maximum of one peak.
//! - `target`: quantity to maximise, and range of the search.
//! - [`sequence`]: computations that wait for rows, which determine the next points.

pub mod driven;
mod rows;
mod search;
pub mod sequence;
mod target;

pub use driven::impulse;
pub use rows::{AtResonance, RESONANCE_HZ, RESONANCE_MARGIN_HZ, measures};
pub use target::{DRIVE_FREQUENCY, Objective, Range};
