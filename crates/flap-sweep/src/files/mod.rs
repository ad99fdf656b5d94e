//! Result files: their formats, and the files beside them that say how they were made and how far they are.

pub mod csv_sink;
pub mod inputs;
pub mod integrity;
pub mod job;
pub mod journal;
pub mod merge;
pub mod output;
pub mod record;
mod replaced;
pub mod rerun;
pub mod results;
pub mod session;
pub mod sidecar;
