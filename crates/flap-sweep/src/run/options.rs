//! The options of a run.

use std::num::NonZeroUsize;
use std::thread;

use flap_core::num::InstructionSet;

/// The options of a run. None of them changes a byte of the output, but for the arithmetic class of the instruction
/// set.
#[derive(Clone, Copy, Debug)]
pub struct RunOptions {
    /// Instructions of the lanes.
    pub instructions: InstructionSet,
    /// Worker threads.
    pub threads: NonZeroUsize,
    /// Most rows between the last row written and the last point begun.
    ///
    /// A point that takes long holds up the rows behind it: the wider the window, the longer the others
    /// can go on meanwhile. A row of 40 measures takes about half a kilobyte.
    pub window: usize,
}

impl Default for RunOptions {
    /// The best instructions of the machine, a thread per core, and a window that takes a few megabytes.
    fn default() -> Self {
        let threads = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        RunOptions { instructions: InstructionSet::best(), threads, window: 16_384 }
    }
}
