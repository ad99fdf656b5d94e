//! Aerodynamics that models share: the wing as a row of strips.

mod strips;

pub use strips::{Cut, Strip, StripSums, Strips, sum};
