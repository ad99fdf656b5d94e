//! Vehicles: control matrix and trims, damping and stability of hover, flight, and rows with these numbers.

pub mod control;
pub mod flight;
pub mod hover;
mod rows;

pub use rows::BodyRows;
