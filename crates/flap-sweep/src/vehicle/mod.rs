//! Vehicles: control matrix and trims, damping and stability of hover, flight, and rows with these numbers.

pub mod control;
pub mod flight;
pub mod hover;
mod hover_slopes;
mod rows;
pub mod trim;

pub(crate) use hover::TRIM_LIMIT;
pub use rows::BodyRows;
pub(crate) use rows::HOVER_RESIDUAL;
