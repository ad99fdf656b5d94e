//! A unimorph piezoelectric actuator attached directly to a wing. The wing pitches on a flexure hinge.
//!
//! Ozaki and Hamaguchi, "Electro-aero-mechanical model of piezoelectric direct-driven flapping-wing
//! actuator", Applied Sciences 8, 1699 (2018). The model contains the inertia of the wing from Lagrange's
//! equations, added mass in the mass matrix, and quasi-steady translational and rotational aerodynamics. The
//! model also computes the current and the electrical power.

mod chord;
mod constants;
mod general;
mod model;
mod params;
mod rhs;
mod variant;

pub use constants::Constants;
pub use model::Signals;
pub use params::{AddedMass, CentreOfPressure, FlowDirection, LiftSign, Params};
pub use variant::DirectDrive;
