//! Signals and stdout on Windows.

use std::fs::File;
use std::os::windows::io::AsHandle as _;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;
use std::{io, process, thread};

use windows_sys::Win32::System::Console::{CTRL_BREAK_EVENT, CTRL_C_EVENT, SetConsoleCtrlHandler};
use windows_sys::core::BOOL;

use crate::failure::Exit;

/// Flag that becomes true at an event of the Windows console, such as Ctrl-C.
static STOP: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// Longest time that Windows waits before it ends a process whose console is closed.
const CLOSING: Duration = Duration::from_secs(5);

/// Returns a flag that becomes true at the first Ctrl-C or Ctrl-Break. The second Ctrl-C or Ctrl-Break ends
/// the process at once.
///
/// If the user closes the console or logs off, the flag also becomes true, and Windows ends the process
/// within seconds. If the parent process disables Ctrl-C, Ctrl-C has no effect.
#[expect(unsafe_code, reason = "the standard library cannot handle events of the console")]
pub(crate) fn stop() -> Arc<AtomicBool> {
    let stop = STOP.get_or_init(Arc::default);
    // SAFETY: the handler has the required type and remains valid. If it cannot be added, events end the process at
    // once; the rows written so far are complete.
    unsafe { SetConsoleCtrlHandler(Some(handle), 1) };
    Arc::clone(stop)
}

/// Handles an event of the console. Windows calls this function in a new thread, and the return value 1
/// prevents further handlers from being called.
extern "system" fn handle(event: u32) -> BOOL {
    let is_second = STOP.get_or_init(Arc::default).swap(true, Ordering::Relaxed);
    if !matches!(event, CTRL_C_EVENT | CTRL_BREAK_EVENT) {
        // The process ends when this function returns.
        thread::sleep(CLOSING);
    } else if is_second {
        process::exit(Exit::Interrupted as i32);
    }
    1
}

/// Does nothing, because Windows has no file size limit of a process.
pub(crate) fn refuse_large_files() {}

/// Returns stdout as a file.
///
/// # Errors
/// The error of the operating system.
pub(crate) fn stdout() -> io::Result<File> {
    io::stdout().as_handle().try_clone_to_owned().map(File::from)
}
