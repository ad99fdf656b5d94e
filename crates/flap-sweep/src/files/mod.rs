//! Result files: their formats, and the files beside them that record their origin and the progress of a run.
//!
//! From the bottom up: `beside` names the files and `disk` writes them; [`results`] are rows in files; [`journal`] and
//! [`sidecar`] are the files beside them, and `replacement` removes those that flap wrote; `output` opens a result file,
//! a [`session`] writes it, [`integrity`] checks it, and a [`job`] runs a plan from beginning to end.

pub mod beside;
pub mod csv_sink;
pub mod disk;
pub mod inputs;
pub mod integrity;
pub mod job;
pub mod journal;
pub mod merge;
pub mod outline;
pub mod output;
pub mod record;
mod replacement;
pub mod rerun;
pub mod results;
pub mod session;
pub mod sidecar;
