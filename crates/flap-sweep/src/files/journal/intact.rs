//! The part of unfinished results that is unchanged since its checkpoint.

use std::fs::File;
use std::io::{self, Read};

use xxhash_rust::xxh3::Xxh3Default;

use super::{Checkpoint, Past};
use crate::notation::text;

/// The last checkpoint whose rows are in the file.
pub(crate) struct Intact {
    pub(crate) checkpoint: Checkpoint,
    /// Bytes of the journal up to the checkpoint.
    pub(crate) journal_bytes: u64,
    /// Hash of the rows up to the checkpoint.
    pub(crate) hash: Xxh3Default,
    /// Number of rows behind it that later checkpoints count.
    pub(crate) lost: u64,
}

/// Finds the last checkpoint up to which `file` holds the bytes that were written. `None` if it holds other bytes.
pub(crate) fn last_intact(mut file: &File, past: &Past) -> io::Result<Option<Intact>> {
    let mut hash = Xxh3Default::new();
    let mut intact = Intact {
        checkpoint: Checkpoint::default(),
        journal_bytes: past.header_bytes,
        hash: hash.clone(),
        lost: past.checkpoints.last().map_or(0, |(checkpoint, _)| checkpoint.rows),
    };
    for (checkpoint, journal_bytes) in &past.checkpoints {
        let Some(missing) = checkpoint.bytes.checked_sub(intact.checkpoint.bytes) else {
            return Ok(None);
        };
        if io::copy(&mut file.by_ref().take(missing), &mut hash)? < missing {
            return Ok(Some(intact));
        }
        if text::digits(hash.digest()) != checkpoint.xxh3 {
            return Ok(None);
        }
        let lost = (intact.lost + intact.checkpoint.rows).saturating_sub(checkpoint.rows);
        let checkpoint = checkpoint.clone();
        intact = Intact { checkpoint, journal_bytes: *journal_bytes, hash: hash.clone(), lost };
    }
    Ok(Some(intact))
}
