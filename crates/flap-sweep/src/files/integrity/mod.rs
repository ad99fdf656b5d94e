//! Checks that results are unchanged since they were written.
//!
//! A sidecar has checksums of complete results: of the file's bytes, which are fast to compare, and of the rows in blocks,
//! which locate damage. For unfinished results, the journal records how many rows are safe; only these are read.

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
