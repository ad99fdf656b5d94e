//! Reads and writes the rows of result files as text, in all formats.
//!
//! A row is the same text in all file formats. The text of a cell is always the text of
//! [`Layout::cells`](crate::table::layout::Layout::cells), both for computed rows and for rows from a file. A
//! converted file or a file of merged shards therefore has the same bytes as a file that one sweep writes
//! directly.

mod checksum;
#[cfg(feature = "parquet")]
mod parquet;
mod provenance;
mod read;
mod row_check;
mod text;
mod write;

pub use crate::table::format::{Format, FormatError};
pub(crate) use checksum::TextDigest;
pub use checksum::{BLOCK_ROWS, Checksums, FileSum};
pub(crate) use provenance::parameters;
pub use provenance::{Provenance, Recorded};
pub(crate) use read::sum_up;
pub use read::{Bounded, Missed, Reader};
pub(crate) use row_check::Checked;
pub use row_check::{RowCheck, RowError, RowsError};
pub use text::TextRows;
pub(crate) use text::text_sum;
pub use write::{ConvertError, Writer, convert};
