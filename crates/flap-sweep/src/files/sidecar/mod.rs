//! The file beside the results that records where they come from: `<results>.meta.toml`.
//!
//! It is written when a sweep starts, with `state = "running"`, and again when it ends. Each time it is replaced as a whole,
//! so a reader never sees an incomplete sidecar. It has all that is needed to run the sweep again and to check the results.
//! Its first line is the checksum of the others.

mod contents;
mod file;
mod plan;
mod written;

pub use contents::{Followed, Grid, Origin, PointsFile, Rerun, Sidecar, State};
pub use file::{ParseError, ReadError};
pub use plan::PlanError;
pub use written::{End, Start};
