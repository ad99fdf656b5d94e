//! Options of a session.

use std::time::Duration;

use crate::run::RunOptions;

/// Options of a session.
#[derive(Clone, Copy, Debug)]
pub struct SessionOptions {
    /// Options of the run.
    pub run: RunOptions,
    /// Time between checkpoints, each of which waits for the disk twice. A run that is killed loses the rows of this time.
    pub checkpoint: Duration,
}
