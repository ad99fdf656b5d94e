//! Piezoelectric actuators: what the models share.

mod laminate;
mod unimorph;

pub use laminate::{Laminate, Layer};
pub use unimorph::{TipResponse, Unimorph};
