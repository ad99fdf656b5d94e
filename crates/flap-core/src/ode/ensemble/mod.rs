//! Many runs in SIMD lanes.
//!
//! Every lane has its own time, step size, error control and constants. When the run in a lane ends or fails, the
//! lane takes the next run from the queue while the other lanes go on. All lanes are used until the queue is empty.
//!
//! No operation mixes lanes: a run's results do not depend on the other runs, and equal the results of
//! [`super::solve`] to the last bit.

mod bank;
mod integrate;
mod queue;
mod schedule;

pub use integrate::{Integrated, integrate};
pub use queue::{MOST_LANES, Next, Observer, Queue, Restart, SpanEnd, Unobserved};
pub use schedule::{Occupancy, run};

pub(crate) use schedule::run_with_responses;
