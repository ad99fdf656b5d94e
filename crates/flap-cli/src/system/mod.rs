//! Operations that differ between operating systems. Each system has a file with the same functions.

#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(unix)]
pub(crate) use unix::{refuse_large_files, stdout, stop};
#[cfg(windows)]
pub(crate) use windows::{refuse_large_files, stdout, stop};
