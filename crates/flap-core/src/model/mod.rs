//! The papers' models: parameters in SI units → constants of a point → equations of motion → signals.
//!
//! Each paper has a folder of its own. A model consists of:
//!
//! - a parameter struct with its table ([`crate::parameters!`]) and the published presets,
//! - constants derived from the parameters once per point ([`crate::per_lane!`]),
//! - equations of motion ([`crate::ode::Ode`]) and the signals to be measured ([`Model`]), written once for scalars and lanes,
//! - for single motions, the states and drives with which they begin ([`Motions`]).

pub mod bimorph;
mod definition;
pub mod direct_drive;
mod energy;
pub mod four_bar;
mod load;
mod motions;
mod readings;
mod signal;
mod stroke_and_pitch;
mod units;

pub use definition::{Derived, Description, Instant, Model};
pub use energy::EnergyBalance;
pub use load::Load;
pub use motions::{Imposed, Motions};
pub(crate) use readings::{efficiency, grams_force};
pub(crate) use signal::RANGED;
pub use signal::{Measure, Principal, Signal, SignalCycle, position};
pub use stroke_and_pitch::Balance;
pub(crate) use units::GRAVITY;
pub use units::Unit;
