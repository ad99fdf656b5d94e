//! The verdict on the results at a path.

use std::io;
use std::path::Path;

use super::check::locate;
use super::open::open;
use super::{Damage, Note, OnDamage, OpenError, Unverified};
use crate::files::beside::sidecar_of;
use crate::files::results::Format;
use crate::files::sidecar::{ReadError, Sidecar};

/// The result of a check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The results are unchanged since they were written.
    Sound {
        /// Number of rows.
        rows: u64,
    },
    /// They are not complete; their rows are unchanged since they were written.
    Unfinished {
        /// Number of points that are done, if it is known.
        done: Option<u64>,
    },
    /// They cannot be checked.
    Unverified(Unverified),
    /// They have changed since they were written.
    Damaged(Damage),
}

/// Checks the results at `path` completely: every byte of the file, and every row as it is read.
///
/// # Errors
/// - [`OpenError::Format`] if the name stands for no format
/// - [`OpenError::Read`] if the results cannot be read
/// - [`OpenError::Sidecar`] if the sidecar cannot be read, or is damaged
pub fn verify(path: &Path) -> Result<Verdict, OpenError> {
    match Sidecar::read(&sidecar_of(path)) {
        Err(ReadError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => {}
        read => drop(read?),
    }
    let opened = match open(path, OnDamage::Refuse) {
        Err(OpenError::Damaged { damage, .. }) => return Ok(Verdict::Damaged(*damage)),
        opened => opened?,
    };
    for note in &opened.notes {
        match note {
            Note::Unfinished { done, .. } => return Ok(Verdict::Unfinished { done: *done }),
            Note::Unverified { why, .. } => return Ok(Verdict::Unverified(*why)),
            Note::Damaged { .. } | Note::Sidecar(_) => {}
        }
    }
    let Some(sidecar) = opened.sidecar else { return Ok(Verdict::Unverified(Unverified::NoSidecar)) };
    let Some(checksums) = &sidecar.checksums else { return Ok(Verdict::Unverified(Unverified::NoChecksums)) };
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    // The file's bytes are those that were written. This checks that they are read as the rows that were computed.
    let damage = locate(path, Format::of(path)?, &sidecar, checksums).map_err(unreadable)?;
    if damage.is_none() {
        return Ok(Verdict::Sound { rows: sidecar.rows().unwrap_or_default() });
    }
    Ok(Verdict::Damaged(damage))
}
