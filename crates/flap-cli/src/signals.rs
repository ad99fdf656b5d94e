//! Signals that ask a sweep to end.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::failure::Exit;

/// A flag that the first SIGINT or SIGTERM raises; the second ends the process at once.
///
/// A signal that the parent lets the process ignore stays ignored: shells start jobs in the background so, lest Ctrl-C at the
/// terminal end them.
pub(crate) fn stop() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        if is_ignored(signal) {
            continue;
        }
        // Order matters: the flag is still down when the first signal asks whether to exit. If signals
        // cannot be caught they end the program at once, and what was written so far is in order.
        let _ = flag::register_conditional_shutdown(signal, Exit::Interrupted as i32, Arc::clone(&stop));
        let _ = flag::register(signal, Arc::clone(&stop));
    }
    stop
}

#[cfg(unix)]
#[expect(unsafe_code, reason = "there is no other way to ask")]
fn is_ignored(signal: i32) -> bool {
    // SAFETY: a `sigaction` is integers and pointers, for which zeros are valid. The call only writes to it.
    unsafe {
        let mut action: libc::sigaction = std::mem::zeroed();
        libc::sigaction(signal, std::ptr::null(), &raw mut action) == 0
            && action.sa_sigaction == libc::SIG_IGN
    }
}

#[cfg(not(unix))]
fn is_ignored(_signal: i32) -> bool {
    false
}
