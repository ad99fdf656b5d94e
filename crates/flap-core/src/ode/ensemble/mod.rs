//! Many runs in SIMD lanes.
//!
//! Every lane has its own time, step size, acceptance of steps, and constants. A lane whose run has ended takes
//! the next one from the queue while its neighbours go on, so lanes are full until the queue is empty; a run
//! that fails is reported and replaced likewise. No operation mixes lanes: a run's results do not depend on
//! its neighbours, and equal those of [`super::solve`] to the last bit.

mod bank;
mod integrate;
mod queue;
mod schedule;

pub use integrate::{Integrated, integrate};
pub use queue::{NewRun, Next, Observer, Queue, Restart, SpanEnd, Unobserved};
pub use schedule::{Occupancy, run};

pub(crate) use schedule::run_with_responses;
