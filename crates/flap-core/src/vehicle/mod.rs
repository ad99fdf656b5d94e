//! Vehicles: several wings of one model, whose mean forces and torques add up.
//!
//! A vehicle is a [`Simulator`](crate::simulate::Simulator) like a model: its parameters are those of the model, which hold for
//! all wings, those of single wings, and the places of the wings; its rows have the mean force and torque of the air in the
//! body's axes. Wings do not feel each other, and the body is held still: so each wing is a design point of its own, and the
//! mean of its inertial reaction over a period is zero.
//!
//! Axes of the body: x forward, y to the left, z up.

mod columns;
mod geometry;
mod gradient;
mod layout;
mod mount;
mod parameters;
mod rows;

pub use geometry::{FORCES, TORQUES};
pub use layout::Vehicle;
pub use mount::{DIFFERENCE, MOST_WINGS, Mount, VehicleError};
pub use parameters::{of_all_wings, standing};
