//! Result files: their formats, and rows as text into them and out of them.
//!
//! Rows are the same text in every format: a cell is what [`Layout::cells`](crate::table::layout::Layout::cells) writes, whether
//! it comes from a model or from a file. So a file converted, or merged from parts, has the bytes of one that was
//! written at once.

mod bounded;
pub(crate) mod checksum;
mod convert;
#[cfg(feature = "parquet")]
mod guard;
mod hashed;
#[cfg(feature = "parquet")]
mod limited;
#[cfg(feature = "parquet")]
mod pages;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
mod provenance;
mod read;
mod recorded;
pub(crate) mod text;
mod write;

pub use crate::table::format::{Format, FormatError};
pub use bounded::Bounded;
pub use checksum::{Checksums, FileSum};
pub use convert::{ConvertError, Converted, convert};
pub use provenance::Provenance;
pub use read::{Missed, Reader};
pub use recorded::Recorded;
pub use text::{BLOCK_ROWS, TextRows};
pub use write::Writer;
