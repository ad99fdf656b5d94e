//! Whether results are as they were written.
//!
//! A sidecar has checksums of complete results: of the file's bytes, which take no time to check, and of the rows in blocks, which
//! tell where damage is. Of unfinished results, the journal tells up to where they are safe: no more than that is read.

mod damage;
mod open;
mod rows;
mod unfinished;
mod verify;

pub use damage::Damage;
pub use open::{Note, OnDamage, OpenError, Opened, Unverified, open};
pub use rows::RowCheck;
pub(crate) use unfinished::{Intact, last_intact};
pub use verify::{Verdict, check, verify};
