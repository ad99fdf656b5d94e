//! A unimorph that flaps a passively pitching wing through a slider-crank and a four-bar.
//!
//! Arabagi, Hines and Sitti, "A simulation and design tool for a passive rotation flapping wing mechanism",
//! IEEE/ASME Transactions on Mechatronics 18, 787 (2013). Quasi-static actuator in series with a spring, transmission
//! with the inertia of its links, Lagrangian wing inertia, quasi-steady aerodynamics by strips, lift by component.
//!
//! The paper prints neither the actuator's equations nor the sizes of wing and actuator: these are rebuilt and
//! assumed. Current and power are an extension.

mod aerodynamics;
mod constants;
mod model;
mod params;
mod rhs;

pub use constants::Constants;
pub use model::{FourBar, Signals};
pub use params::{AddedMassSign, Arms, Params, Quadrature};
pub use rhs::{Transmission, transmission};
