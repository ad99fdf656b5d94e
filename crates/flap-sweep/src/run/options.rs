//! The options of a run.

use std::num::NonZeroUsize;
use std::thread;
use std::time::Duration;

use flap_core::num::Backend;

/// Time for points in hand: long enough for ordinary ones, and less than a second with what is around it.
const GRACE: Duration = Duration::from_millis(400);

/// The options of a run. None of them changes a byte of the output, but for the arithmetic class of the instruction
/// set.
#[derive(Clone, Copy, Debug)]
pub struct RunOptions {
    /// Instructions of the lanes.
    pub instructions: Backend,
    /// Worker threads.
    pub threads: NonZeroUsize,
    /// Most rows between the last row written and the last point begun.
    ///
    /// A point that takes long holds up the rows behind it: the wider the window, the longer the others
    /// can go on meanwhile. A row of 40 measures takes about half a kilobyte.
    pub window: usize,
    /// Time for the points in hand after the run is stopped: those that take longer are dropped.
    pub grace: Duration,
}

impl Default for RunOptions {
    /// The best instructions of the machine, a thread per core, a window that takes a few megabytes, and 0.4 s of grace.
    fn default() -> Self {
        let threads = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        RunOptions { instructions: Backend::best(), threads, window: 16_384, grace: GRACE }
    }
}
