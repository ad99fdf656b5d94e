//! Operations that differ between operating systems. Unix and Windows each have a source file, and both files
//! have the same functions.

#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(unix)]
pub(crate) use unix::{refuse_large_files, stdout, stop};
#[cfg(windows)]
pub(crate) use windows::{refuse_large_files, stdout, stop};
