//! Functions whose code differs between operating systems. One file for each kind of operating system
//! contains the same functions.

#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(unix)]
pub(crate) use unix::{is_pipe_of_shell, is_stream};
#[cfg(windows)]
pub(crate) use windows::{is_pipe_of_shell, is_stream};
