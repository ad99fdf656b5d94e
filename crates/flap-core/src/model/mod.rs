//! The published models. A model computes constants from parameters in SI units, and signals from the
//! solution of the equations of motion.
//!
//! The model of each paper has its own folder. A model consists of:
//!
//! - a parameter struct with its table ([`crate::parameters!`]) and the published presets,
//! - constants that flap computes from the parameters, once for each point ([`crate::per_lane!`]),
//! - the signals, declared as a struct with one field for each signal ([`crate::signals!`]),
//! - the equations of motion ([`crate::ode::Ode`]) and the formulas of the signals ([`Model`]), in code for
//!   scalars and for lanes,
//! - the states and drives with which experiments begin ([`ExperimentModel`]).
//!
//! [`Runner`](crate::simulate::Runner) computes the rows of a model. The documentation of `Runner` contains a
//! complete example of a user-defined model.

pub mod bimorph;
mod definition;
pub mod direct_drive;
mod experiment;
pub mod four_bar;
mod load;
pub mod readings;
mod signal;
mod signals;
pub mod stroke_and_pitch;
mod terms;
mod totals;

pub use definition::{Derived, Description, Instant, Model, SecondHalf, Symmetry, WingParameters};
pub use experiment::{ExperimentModel, Imposed};
pub use load::Load;
pub(crate) use signal::GRAVITY;
pub use signal::{Measure, OverWings, Principal, Signal, SignalCycle, Statistics, Unit};
pub use signals::{Each, SignalSet, SignalsOf};
pub use terms::Terms;
pub use totals::Totals;
