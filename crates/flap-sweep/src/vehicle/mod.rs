//! Computes control matrices, trims, the damping and stability of hover, and the flight of vehicles. The
//! module also adds hover and damping to the rows of sweeps.

pub mod control;
pub mod flight;
pub mod hover;
mod hover_slopes;
pub mod modes;
mod rows;
pub mod trim;

pub(crate) use hover::TRIM_LIMIT;
pub use rows::BodyRows;
pub(crate) use rows::HOVER_RESIDUAL;
