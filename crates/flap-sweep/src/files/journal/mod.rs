//! The file beside unfinished results that records the progress of a run: `<results>.journal`.
//!
//! Its first line identifies the run; every other line is a checkpoint. Each line begins with its checksum. A line is
//! added only when the rows that it counts are safe on disk, and lines are never changed. A crash may leave an incomplete
//! line at the end; its checksum does not agree.

mod checkpoint;
mod file;
mod intact;

pub use checkpoint::{Checkpoint, Header};
pub use file::{Journal, Past, parse, read};
pub(crate) use intact::{Intact, last_intact};
