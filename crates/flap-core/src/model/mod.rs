//! The published models: parameters in SI units → constants of a point → equations of motion → signals.
//!
//! Each paper has its own folder. A model consists of:
//!
//! - a parameter struct with its table ([`crate::parameters!`]) and the published presets,
//! - constants derived from the parameters once per point ([`crate::per_lane!`]),
//! - the signals, a struct with one field for each ([`crate::signals!`]),
//! - equations of motion ([`crate::ode::Ode`]) and the values of the signals ([`Model`]), written once for scalars and lanes,
//! - for experiments, the states and drives at their beginning ([`ExperimentModel`]).
//!
//! [`Runner`](crate::simulate::Runner) computes the rows of a model. Its page contains a complete user-defined model.

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
