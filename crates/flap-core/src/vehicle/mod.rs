//! Vehicles: several wings of one model, whose mean forces and torques add up.
//!
//! A vehicle is a [`Simulator`](crate::simulate::Simulator), as a model is. The parameters of a vehicle are the
//! parameters of the model for all wings, the parameters of single wings, and the positions of the wings. The rows of a
//! vehicle contain the mean force and torque of the air in the body axes.
//!
//! Wings do not interact, and the body is at rest or moves steadily through still air. Each wing is therefore
//! an independent design point, and the mean inertial force of a wing over a period is zero.
//!
//! In the body axes, x points forward, y to the left, and z up.

mod columns;
mod geometry;
mod gradient;
mod layout;
mod mount;
mod moving;
mod parameters;
mod rows;

pub use geometry::{FORCES, TORQUES};
pub use layout::Vehicle;
pub use mount::{DIFFERENCE, MOST_WINGS, Mount, VehicleError};
pub use moving::MovingWings;
pub use parameters::{MassProperties, of_all_wings, standing};
