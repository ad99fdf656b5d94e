//! Components of piezoelectric actuators: laminates and unimorphs.

mod laminate;
mod unimorph;

pub use laminate::{Laminate, Layer};
pub use unimorph::{TipResponse, Unimorph};
