//! A unimorph that flaps a passively pitching wing through a slider-crank and a four-bar.
//!
//! Arabagi, Hines and Sitti, "A simulation and design tool for a passive rotation flapping wing mechanism",
//! IEEE/ASME Transactions on Mechatronics 18, 787 (2013). Quasi-static actuator in series with a spring, transmission
//! with the inertia of its links, Lagrangian wing inertia, quasi-steady aerodynamics by strips, lift by component.
//!
//! The paper prints neither the actuator's equations nor the sizes of wing and actuator: these are rebuilt and
//! assumed. Current and power are an extension.

mod aerodynamics;
mod columns;
mod constants;
mod definition;
mod dynamics;
mod params;
mod rhs;
mod wing;

pub use aerodynamics::{Aerodynamics, added_mass_lift, aerodynamics, coefficients, side_of};
pub use columns::Signals;
pub use constants::{Actuator, Air, Constants, Wing};
pub use dynamics::FourBar;
pub use params::{AddedMassSign, Arms, MAX_STRIPS, Params, Quadrature};
pub use rhs::{
    Transmission, balance, charging_current, current, driving_force, force, mass_matrix, tip, transmission,
};
