//! Checks that results are unchanged since they were written.
//!
//! A sidecar has checksums of complete results: of the file's bytes, which are fast to compare, and of the rows in blocks,
//! which tell where damage is. For unfinished results, the journal tells up to where they are safe: no more than that is
//! read.

mod check;
mod damage;
mod error;
mod note;
mod open;
mod verify;

pub use check::check;
pub use damage::{Damage, OnDamage};
pub use error::OpenError;
pub use note::{Note, Unverified};
pub use open::{Opened, open};
pub use verify::{Verdict, verify};
