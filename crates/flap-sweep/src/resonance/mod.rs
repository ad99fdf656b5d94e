//! The resonances of designs: the drive frequencies at which their stroke, lift or efficiency is largest.
//!
//! - [`AtResonance`]: rows of designs that are each run at their own resonance
//! - [`driven`]: the highest peaks of one design, and with [`impulse()`] the size of an impulse, after which free motions are examined
//! - `search`: the search for both, and for the top of one peak
//! - `target`: the quantity that is largest, and the range of the search
//! - [`sequence`]: points that are chosen one after another, by the rows of earlier ones

pub mod driven;
mod rows;
mod search;
pub mod sequence;
mod target;

pub use driven::{LargeImpulse, impulse};
pub use rows::{AtResonance, RESONANCE_HZ, RESONANCE_MARGIN_HZ, measures};
pub use target::{DRIVE_FREQUENCY, Objective, Range, SearchError};
