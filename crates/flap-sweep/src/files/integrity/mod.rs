//! Checks that results are unchanged since they were written.
//!
//! A sidecar has checksums of complete results: of the file's bytes, which are fast to compare, and of the rows in blocks,
//! which locate damage. For unfinished results, the journal records the safe rows and the identity of the sweep: only these
//! rows are read, and only with a sidecar of the same identity.

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
pub use open::{Opened, names, open};
pub use verify::{Verdict, verify};
