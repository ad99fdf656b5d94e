//! Notes on results for the user.

use std::path::PathBuf;

use super::Damage;
use crate::notation::text::count;

/// A note on results for the user.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Note {
    /// They have changed since they were written.
    #[error("{} is damaged: {damage}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The damage.
        damage: Damage,
    },
    /// Their sidecar is damaged, or of an unknown format.
    #[error("{0}")]
    Sidecar(String),
    /// They are not complete.
    #[error("{} is unfinished: {}", path.display(), so_far(*done))]
    Unfinished {
        /// The file.
        path: PathBuf,
        /// Number of points that have rows or are excluded, if it is known.
        done: Option<u64>,
    },
    /// They cannot be checked.
    #[error("{} could not be verified: {why}", path.display())]
    Unverified {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: Unverified,
    },
}

/// Reason why results cannot be checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unverified {
    /// They have no sidecar.
    #[error("there is no sidecar beside it")]
    NoSidecar,
    /// Their sidecar has no checksums.
    #[error("its sidecar has no checksums")]
    NoChecksums,
}

fn so_far(done: Option<u64>) -> String {
    match done {
        Some(done) => format!("{} done so far, `flap results resume` continues it", count(done, "point")),
        None => "there are fewer rows than points to be run".to_owned(),
    }
}
