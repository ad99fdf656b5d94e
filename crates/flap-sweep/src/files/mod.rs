//! Reads and writes result files. Files beside a result file record the origin of the rows and the progress
//! of the run.
//!
//! The module `beside` contains the names of the files beside results. The module `disk` writes files, and
//! the module [`results`] reads and writes rows. The modules [`journal`] and [`sidecar`] read and write the
//! files beside results. The module `replacement` replaces and removes results. The module `output` opens and
//! locks a result file, the module [`session`] writes rows into the file, and the module [`integrity`] checks
//! the file. The module [`job`] writes the results of a whole plan.

pub mod beside;
pub mod csv_sink;
pub mod disk;
mod fmu;
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
