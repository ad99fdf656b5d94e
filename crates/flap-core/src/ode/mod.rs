//! Dormand-Prince 5(4), for one run at a time or for many runs in SIMD lanes.
//!
//! - [`tableau`]: coefficients, checked when the crate is compiled
//! - [`step`]: computation of one step without step-size control: stages, new state, error estimate,
//!   interpolation
//! - [`norm`], `controller`, `start`: computation of the size of the error, of the next step size, and of the
//!   first step size
//! - `switch`: integration of right-hand sides that jump where a switching function changes sign
//! - `replay`: integration of runs with the step sizes of an earlier run, from changed constants and initial
//!   states
//! - `variation`: integration of a run together with its responses to small changes of the initial state
//! - [`solve`]: integration of one run on scalars, in simple code. Tests compare the results of `solve` and
//!   of the ensemble
//! - [`ensemble`]: integration of many runs in lanes, each with its own time, step size and constants
//!
//! The integration of a run is divided into *time spans*, usually drive periods. Time is 0 at the beginning
//! of each time span, and the last step ends exactly at the end of the time span. At the end of a time span,
//! the caller checks the state, and stops the run or starts the next time span. The time therefore stays a
//! small number in long runs, but the inputs must be the same in each time span.
//!
//! To integrate your own equations, implement [`Ode`]. `examples/jafferis_fig2_3` integrates three systems
//! until their motions have settled, and `examples/own_equations` runs thousands of points in lanes.

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
