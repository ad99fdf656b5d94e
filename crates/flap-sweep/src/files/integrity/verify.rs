//! Checking complete results against their sidecar.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use xxhash_rust::xxh3::Xxh3Default;

use super::damage::Damage;
use super::open::{Note, OnDamage, OpenError, Unverified, open};
use crate::files::results::{FileSum, Format, text};
use crate::files::sidecar::{self, ReadError, Sidecar, State};

/// The result of a check.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// They are as they were written.
    Sound {
        /// Rows.
        rows: u64,
    },
    /// They are not complete; so far they are as they were written.
    Unfinished {
        /// Points that are done, if that is known.
        done: Option<u64>,
    },
    /// They cannot be checked.
    Unverified(Unverified),
    /// They are not as they were written.
    Damaged(Damage),
}

/// Checks all there is to check of the results at `path`: every byte of the file, and every row as it is read.
///
/// # Errors
/// If a file cannot be read, or the sidecar is damaged.
pub fn verify(path: &Path) -> Result<Verdict, OpenError> {
    match Sidecar::read(&sidecar::path_of(path)) {
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
    let unreadable = |source| OpenError::Read { path: path.to_owned(), source };
    // The file's bytes are those that were written. This asks whether they are read as the rows that were computed.
    let damage = locate(path, Format::of(path)?, &sidecar).map_err(unreadable)?;
    if damage.is_none() {
        return Ok(Verdict::Sound { rows: sidecar.rows.unwrap_or_default() });
    }
    Ok(Verdict::Damaged(damage))
}

/// Damage of the complete results at `path`, as far as their sidecar can tell; `None` if nothing is. Reads them once,
/// and a second time if something is wrong.
///
/// # Errors
/// What the operating system says.
pub fn check(path: &Path, format: Format, sidecar: &Sidecar) -> io::Result<Option<Damage>> {
    let Some(checksums) = sidecar.checksums.as_ref() else { return Ok(None) };
    let bytes = match &checksums.file {
        Some(sum) if sum_of(File::open(path)?)? == *sum => return Ok(None),
        sum => sum.is_some(),
    };
    let damage = Damage { bytes, ..locate(path, format, sidecar)? };
    Ok(Some(damage).filter(|damage| !damage.is_none()))
}

/// Where the rows are not as they were written.
fn locate(path: &Path, format: Format, sidecar: &Sidecar) -> io::Result<Damage> {
    let Some(checksums) = sidecar.checksums.as_ref() else { return Ok(Damage::default()) };
    let file = File::open(path)?;
    let (found, read) = match format {
        #[cfg(feature = "parquet")]
        Format::Parquet => crate::files::results::parquet::sum_up(file),
        _ => text::sum_up(file, format),
    };
    let rows = sidecar.rows.filter(|_| sidecar.state == State::Complete);
    let mut damage = Damage::of_text(&found, checksums, rows);
    if let Err(error) = read {
        if error.raw_os_error().is_some() {
            return Err(error);
        }
        // Those that cannot be read are not counted.
        damage.count = None;
        damage.unreadable = Some(error.to_string());
    }
    Ok(damage)
}

/// The checksum of all that can be read from `file`.
fn sum_of(mut file: impl Read) -> io::Result<FileSum> {
    let mut hash = Xxh3Default::new();
    let mut buffer = vec![0; 1 << 16];
    let mut bytes = 0;
    loop {
        match file.read(&mut buffer) {
            Ok(0) => return Ok(FileSum { bytes, xxh3: format!("{:016x}", hash.digest()) }),
            Ok(count) => {
                hash.update(&buffer[..count]);
                bytes += count as u64;
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}
