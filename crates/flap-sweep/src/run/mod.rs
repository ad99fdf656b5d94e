//! The parallel runner: work in units that run on all cores, and whose rows are written in order.
//!
//! A unit is a point of a plan with its one row, or a design with the rows of its response. Each worker is one lane
//! ensemble for the whole run, so its lanes stay full until the end of the run. Units finish in any
//! order. A bounded window puts them back in order, so that memory does not grow with their number and the output does
//! not depend on the number of threads.
//!
//! - `points`: the runner of plans; `parcel`: the same in several processes
//! - `ordered`: the runner of any units, with its parts `window`, `queue`, `hand` (a worker's side) and `collect`
//! - `ledger`: writes rows to a [`sink`] and counts them in a [`Summary`]
//! - [`identity`]: the settings and the build that decide the bytes of rows

mod error;
mod finished;
mod gradient;
mod hand;
pub mod identity;
mod ledger;
mod options;
pub(crate) mod ordered;
mod parcel;
mod points;
mod progress;
mod queue;
pub mod sink;
pub(crate) mod solver;
mod summary;
mod window;

pub use error::RunError;
pub(crate) use hand::Hand;
pub(crate) use ledger::Ledger;
pub use options::RunOptions;
pub use parcel::{Parcel, feed, part};
pub use points::{alone, resume, run};
pub use progress::Progress;
pub use summary::{Counts, Doubts, Summary};
