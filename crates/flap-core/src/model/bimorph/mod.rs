//! A bimorph piezoelectric actuator that drives a wing through a transmission. The wing pitches on a hinge.
//!
//! Jafferis, Graule and Wood, "Non-linear resonance modeling and system design improvements for underactuated
//! flapping-wing vehicles", ICRA 2016.
//!
//! The force and the stiffness of the two piezoelectric plates depend on electric field and strain. The model
//! also contains a lumped mass, quasi-steady aerodynamics of the whole wing, and a passive hinge.

mod actuator;
mod constants;
mod general;
mod model;
mod params;
mod rhs;
mod strips;
mod transmission;
mod variant;

pub use constants::Constants;
pub use model::Signals;
pub use params::{ActuatorStiffness, CentreOfPressure, FieldTransition, Params};
pub use rhs::{Plate, plates, secant_stiffness};
pub use transmission::Law;
pub use variant::Bimorph;
