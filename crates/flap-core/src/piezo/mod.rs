//! Components of piezoelectric actuators: laminates, unimorphs, electrical losses.

mod electrical;
mod laminate;
mod unimorph;

pub use electrical::{ElectricalParameters, supplied};
pub use laminate::{Laminate, Layer};
pub use unimorph::{TipResponse, Unimorph};
