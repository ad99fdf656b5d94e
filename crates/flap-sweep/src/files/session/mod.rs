//! The hold of a run on its result file: rows into it, checkpoints beside it, and the continuation of an earlier run.
//!
//! Checkpoints are at places where the bytes so far do not depend on later rows: behind any row, or in compressed files
//! at the end of a frame. A resumed run drops the rows behind the last checkpoint and computes them again, to the same
//! bytes.
//!
//! A Parquet file can be neither read nor continued before its last byte is written. Its rows are first written to
//! `<results>.part`, compressed text like that of a `.csv.zst` file, and become columns when the run is complete.

mod assemble;
mod resume;
mod start;
mod writing;

pub use resume::{ResumeError, Resumed};
pub use writing::{Session, SessionOptions};
