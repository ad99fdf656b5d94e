//! The hold of a run on its result file: rows into it, checkpoints beside it, and the continuation of an earlier run.
//!
//! Checkpoints are at places where the bytes so far do not depend on what follows: behind any row, or in compressed files
//! at the end of a frame. A run that is resumed drops the rows behind the last checkpoint and computes them again, to the
//! same bytes.
//!
//! A Parquet file can be neither read nor continued before its last byte is written. Its rows wait in `<results>.part`,
//! compressed text like that of a `.csv.zst` file, and are turned into columns when all are there.

mod assemble;
mod resume;
mod start;
mod writing;

pub use resume::{ResumeError, Resumed};
pub use writing::{Session, SessionOptions};
