//! Errors of a run.

use std::io;

/// An error that ends a run. The rows written until then are in order and complete.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Rows could not be written.
    #[error("cannot write rows: {0}")]
    Sink(#[source] io::Error),
    /// The threads could not be started.
    #[error("cannot start the worker threads: {0}")]
    Threads(#[source] rayon::ThreadPoolBuildError),
    /// The model broke its contract; this is a mistake in the program.
    #[error("the model does not keep its contract: {0}")]
    Model(String),
    /// Rows that another process has computed do not belong here.
    #[error("rows of a worker do not fit: {0}")]
    Parcel(String),
    /// The caller that fetches rows from other processes has given up.
    #[error("rows cannot be fetched: {0}")]
    Fetch(String),
    /// A worker panicked; this is a mistake in the program.
    #[error("a worker panicked: {0}")]
    Panic(String),
}
