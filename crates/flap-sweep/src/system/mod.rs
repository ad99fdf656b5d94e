//! Functions whose code differs between operating systems. Each source file of this module is for one
//! kind of operating system.

#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

#[cfg(unix)]
pub(crate) use unix::{is_pipe_of_shell, is_stream};
#[cfg(windows)]
pub(crate) use windows::{is_pipe_of_shell, is_stream};
