//! How much of unfinished results is as the journal says.

use std::fs::File;
use std::io::{self, Read};

use xxhash_rust::xxh3::Xxh3Default;

use crate::files::journal::{Checkpoint, Past};

/// The last checkpoint whose rows are there.
pub(crate) struct Intact {
    pub(crate) checkpoint: Checkpoint,
    /// Bytes of the journal up to it.
    pub(crate) journal_bytes: u64,
    /// Of the rows up to it.
    pub(crate) hash: Xxh3Default,
    /// Rows that later checkpoints tell of.
    pub(crate) lost: u64,
}

/// Finds the last checkpoint up to which `file` is what was written; `None` if it holds something else.
pub(crate) fn last_intact(mut file: &File, past: &Past) -> io::Result<Option<Intact>> {
    let mut hash = Xxh3Default::new();
    let mut intact = Intact {
        checkpoint: Checkpoint::default(),
        journal_bytes: past.header_bytes,
        hash: hash.clone(),
        lost: past.checkpoints.last().map_or(0, |(checkpoint, _)| checkpoint.rows),
    };
    let mut buffer = vec![0; 1 << 16];
    for (checkpoint, journal_bytes) in &past.checkpoints {
        let Some(mut missing) = checkpoint.bytes.checked_sub(intact.checkpoint.bytes) else {
            return Ok(None);
        };
        while missing > 0 {
            let most = usize::try_from(missing).unwrap_or(usize::MAX).min(buffer.len());
            let count = file.read(&mut buffer[..most])?;
            if count == 0 {
                return Ok(Some(intact));
            }
            hash.update(&buffer[..count]);
            missing -= count as u64;
        }
        if format!("{:016x}", hash.digest()) != checkpoint.xxh3 {
            return Ok(None);
        }
        let lost = (intact.lost + intact.checkpoint.rows).saturating_sub(checkpoint.rows);
        let checkpoint = checkpoint.clone();
        intact = Intact { checkpoint, journal_bytes: *journal_bytes, hash: hash.clone(), lost };
    }
    Ok(Some(intact))
}
