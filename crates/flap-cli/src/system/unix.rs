//! Signals and stdout on Linux, macOS and other Unix systems.

use std::fs::File;
use std::io;
use std::os::fd::AsFd as _;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use signal_hook::consts::{SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::flag;

use crate::failure::Exit;

/// Returns a flag that becomes true at the first signal SIGINT or SIGTERM. A second SIGINT or SIGTERM ends
/// the process at once.
///
/// If the process ignores SIGINT or SIGTERM from its start, this signal remains ignored. Some shells start
/// background jobs with SIGINT ignored, so that Ctrl-C at the terminal does not stop the jobs.
pub(crate) fn stop() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        if is_ignored(signal) {
            continue;
        }
        // The order matters: at the first signal, the flag is still down when the shutdown checks it. If signals
        // cannot be caught, they end the program at once; the rows written so far are complete.
        let _ = flag::register_conditional_shutdown(signal, Exit::Interrupted as i32, Arc::clone(&stop));
        let _ = flag::register(signal, Arc::clone(&stop));
    }
    stop
}

#[expect(unsafe_code, reason = "the standard library cannot query a signal")]
fn is_ignored(signal: i32) -> bool {
    // SAFETY: a `sigaction` is integers and pointers, for which zeros are valid. The call only writes to it.
    unsafe {
        let mut action: libc::sigaction = std::mem::zeroed();
        libc::sigaction(signal, std::ptr::null(), &raw mut action) == 0
            && action.sa_sigaction == libc::SIG_IGN
    }
}

/// After this call, a write beyond the file size limit of the process (`ulimit -f`) returns an error and does
/// not end the process.
///
/// By default, a write beyond the limit causes the signal SIGXFSZ, which ends the process.
pub(crate) fn refuse_large_files() {
    let _ = flag::register(SIGXFSZ, Arc::default());
}

/// Returns stdout as a file.
///
/// # Errors
/// The error of the operating system.
pub(crate) fn stdout() -> io::Result<File> {
    io::stdout().as_fd().try_clone_to_owned().map(File::from)
}
