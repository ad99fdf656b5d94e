//! The resonances of designs: the drive frequencies at which their stroke, lift or efficiency is largest.
//!
//! - [`AtResonance`]: rows of designs that are each run at their own resonance
//! - [`driven`]: the highest peaks of one design
//! - `search`: the search for both; `maximum` locates the top of one peak
//! - [`impulse()`]: the size of an impulse, after which free motions are examined
//! - `target`, `range`: the quantity that is largest, and the range of the search
//! - [`study`]: points that are chosen one after another, by the rows of earlier ones

pub mod driven;
mod error;
mod impulse;
mod maximum;
mod range;
mod rows;
mod search;
pub mod study;
mod target;

pub use error::SearchError;
pub use impulse::{LargeImpulse, impulse};
pub use range::{Objective, Range};
pub use rows::{AtResonance, RESONANCE_HZ, RESONANCE_MARGIN_HZ, measures};
pub use target::DRIVE_FREQUENCY;
