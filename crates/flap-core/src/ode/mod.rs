//! Dormand-Prince 5(4), for one run at a time or for many runs in SIMD lanes.
//!
//! - [`tableau`]: coefficients, checked when the crate is compiled
//! - [`step`]: one step: stages, new state, error estimate, interpolation. It contains no step-size control
//! - [`norm`], `controller`, `start`: size of the error, next step size, first step size
//! - `switch`: right-hand sides that jump where a function changes sign
//! - `replay`: a run repeated on the same steps, with other constants and initial states
//! - `variation`: a run with its responses to small changes of the initial state
//! - [`solve`]: one run on scalars, in simple code: the reference for the ensemble
//! - [`ensemble`]: many runs in lanes, each with its own time, step size and constants
//!
//! Time runs from 0 to the end of a *span*, usually one drive period, and every span ends exactly on a step. At its
//! end the caller checks the state, and stops or starts another span. If the inputs repeat with the span, times
//! therefore never grow.
//!
//! Other equations implement [`Ode`]. `examples/jafferis_fig2_3` integrates three systems to their settled motions,
//! and `examples/own_equations` runs thousands of points in lanes.

mod controller;
pub mod ensemble;
pub mod norm;
mod problem;
pub(crate) mod replay;
pub mod solve;
mod start;
pub mod step;
mod switch;
pub mod tableau;
mod variation;

pub use problem::{Ending, Interrupt, Ode, Outcome, Start, Tolerances, never};
pub(crate) use problem::{INTERRUPT_STEPS, MIN_STEP, STRETCH, input, slope};
