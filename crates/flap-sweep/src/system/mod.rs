//! Operations that differ between operating systems. Each operating system has its own file with the same functions.

#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(unix)]
pub(crate) use unix::{is_pipe_of_shell, is_stream};
#[cfg(windows)]
pub(crate) use windows::{is_pipe_of_shell, is_stream};
