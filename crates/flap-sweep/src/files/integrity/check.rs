//! Complete results compared with the checksums in their sidecar.

use std::fs::File;
use std::io;
use std::path::Path;

use super::{Damage, OnDamage, OpenError};
use crate::files::results::{Checksums, FileSum, Format, sum_up};
use crate::files::sidecar::Sidecar;

/// The damage of the complete results at `path`; `None` if there is none, or their sidecar has no checksums. Reads the file
/// once, and a second time if its bytes have changed.
///
/// # Errors
/// - [`OpenError::Read`] if the file cannot be read
/// - [`OpenError::Damaged`] if it is damaged and that is not tolerated
pub fn check(
    path: &Path,
    format: Format,
    sidecar: &Sidecar,
    on_damage: OnDamage,
) -> Result<Option<Damage>, OpenError> {
    match find(path, format, sidecar) {
        Ok(Some(damage)) if on_damage == OnDamage::Refuse => {
            Err(OpenError::Damaged { path: path.to_owned(), damage: Box::new(damage) })
        }
        Ok(damage) => Ok(damage),
        Err(source) => Err(OpenError::Read { path: path.to_owned(), source }),
    }
}

fn find(path: &Path, format: Format, sidecar: &Sidecar) -> io::Result<Option<Damage>> {
    let Some(checksums) = sidecar.checksums.as_ref() else { return Ok(None) };
    let bytes = match &checksums.file {
        Some(sum) if FileSum::of(File::open(path)?)? == *sum => return Ok(None),
        sum => sum.is_some(),
    };
    let damage = Damage { bytes, ..locate(path, format, sidecar, checksums)? };
    Ok(Some(damage).filter(|damage| !damage.is_none()))
}

/// The damage of the rows as they are read from the file, with its place.
pub(super) fn locate(
    path: &Path,
    format: Format,
    sidecar: &Sidecar,
    checksums: &Checksums,
) -> io::Result<Damage> {
    let (found, read) = sum_up(File::open(path)?, format);
    let rows = sidecar.rows();
    let mut damage = Damage::of_text(&found, checksums, rows);
    if let Err(error) = read {
        if error.raw_os_error().is_some() {
            return Err(error);
        }
        // Rows that cannot be read are not counted.
        damage.count = None;
        damage.unreadable = Some(error.to_string());
    }
    Ok(damage)
}
