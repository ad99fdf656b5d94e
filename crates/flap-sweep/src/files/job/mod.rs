//! The rows of a plan into a result file with its sidecar, such that the run can be resumed.
//!
//! The caller chooses who computes the rows: [`run::resume`](crate::run::resume) on this machine, or
//! [`run::feed`](crate::run::feed) with rows of others.

mod error;
mod outcome;
mod resume;
mod run;
mod stream;

pub use error::JobError;
pub use outcome::{Done, Notice, Outcome};
pub use run::{Begin, Job, run};
pub use stream::{Engine, to_stream};

pub use crate::files::replacement::{to_resume, unfinished};
