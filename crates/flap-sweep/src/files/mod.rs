//! Result files: formats, and the files beside results that record the origin of the rows and the progress of a run.
//!
//! `beside` names the files beside results, `disk` writes files, and [`results`] reads and writes rows. [`journal`] and
//! [`sidecar`] are the files beside results, and `replacement` removes the files that flap wrote. `output` opens a
//! result file and locks it, a [`session`] writes it, [`integrity`] checks it, and a [`job`] runs a whole plan.

pub mod beside;
pub mod csv_sink;
pub mod disk;
pub mod inputs;
pub mod integrity;
pub mod job;
pub mod journal;
pub mod linear_model;
mod lock;
pub mod matlab;
pub mod merge;
pub mod outline;
pub mod output;
pub mod record;
mod replacement;
pub mod rerun;
pub mod results;
pub mod session;
pub mod sidecar;
