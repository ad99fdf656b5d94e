//! Piezoelectric actuators: what the models share.

mod laminate;

pub use laminate::{Laminate, Layer};
