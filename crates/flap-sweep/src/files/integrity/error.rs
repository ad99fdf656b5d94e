//! Reasons why results cannot be read.

use std::io;
use std::path::PathBuf;

use super::Damage;
use crate::files::results::FormatError;
use crate::files::sidecar::ReadError;

/// Results that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The name stands for no format.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The operating system refuses, or the file is not of its format.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// Their sidecar cannot be read, or is damaged.
    #[error(transparent)]
    Sidecar(#[from] ReadError),
    /// They have changed since they were written.
    #[error("{} is damaged: {damage}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The damage.
        damage: Box<Damage>,
    },
}
