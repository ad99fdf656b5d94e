//! Functions whose code differs between operating systems. For each kind of operating system, one source file
//! contains these functions.

#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(unix)]
pub(crate) use unix::{is_pipe_of_shell, is_stream};
#[cfg(windows)]
pub(crate) use windows::{is_pipe_of_shell, is_stream};
