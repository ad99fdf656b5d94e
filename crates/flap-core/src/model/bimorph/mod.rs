//! A bimorph piezoelectric actuator that drives a wing through a transmission; the wing pitches on a hinge.
//!
//! Jafferis, Graule and Wood, "Non-linear resonance modeling and system design improvements for
//! underactuated flapping-wing vehicles", ICRA 2016. Two plates with field- and strain-dependent force and
//! stiffness, a lumped mass, quasi-steady aerodynamics of the whole wing, a passive hinge.

mod actuator;
mod columns;
mod constants;
mod definition;
mod dynamics;
mod params;
mod rhs;
mod transmission;
mod wing;

pub use actuator::{Actuator, taper_gain};
pub use columns::Signals;
pub use constants::Constants;
pub use dynamics::Bimorph;
pub use params::{ActuatorStiffness, CentreOfPressure, FieldTransition, Params};
pub use rhs::{
    Plate, charges, charging_power, currents, derivative, drag_coefficient, elastic_force, hinge_drag,
    leakage, lift_and_drag, plate_forces, plates, secant_stiffness, stiffening, tip_drag,
};
pub use transmission::{Law, Transmission};
