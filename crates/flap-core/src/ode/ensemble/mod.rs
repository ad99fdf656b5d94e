//! Integration of many runs at the same time, one run in each SIMD lane.
//!
//! Every lane has its own time, step size, error control and constants. If the run in a lane ends or fails, the lane
//! takes the next run from the queue, while the other lanes continue. All lanes are used until the queue is empty.
//!
//! No operation combines numbers of different lanes. The results of a run therefore do not depend on other
//! runs. The results of an ensemble equal the results of [`super::solve`] to the last bit.

mod integrate;
mod lane_runs;
mod queue;
mod schedule;

pub use integrate::{Integrated, integrate};
pub use queue::{MOST_LANES, Next, Observer, Queue, Restart, SpanEnd, Unobserved};
pub use schedule::{Occupancy, run};

pub(crate) use schedule::run_with_responses;
