//! A unimorph actuator that drives a wing through a slider-crank and a four-bar. The wing pitches on a hinge.
//!
//! Arabagi, Hines and Sitti, "A simulation and design tool for a passive rotation flapping wing mechanism",
//! IEEE/ASME Transactions on Mechatronics 18, 787 (2013).
//!
//! The model contains a quasi-static actuator in series with a spring, and a transmission with the inertia of
//! its links. The inertia of the wing follows from Lagrange's equations, and the quasi-steady aerodynamic
//! forces are sums over strips. The model reports each component of the lift separately.
//!
//! The paper contains neither the equations of the actuator nor the dimensions of wing and actuator. The equations were
//! reconstructed, and the dimensions are assumed. Current and power are not in the paper.

mod aerodynamics;
mod constants;
mod general;
mod model;
mod params;
mod rhs;
mod strips;
mod variant;

pub use constants::Constants;
pub use model::Signals;
pub use params::{AddedMassSign, Arms, Params, Quadrature};
pub use rhs::{Transmission, transmission};
pub use variant::FourBar;
