//! Result files: formats, and reading and writing rows as text.
//!
//! Rows are the same text in every format. A cell is the text of
//! [`Layout::cells`](crate::table::layout::Layout::cells), whether the row comes from a model or from a file. A file
//! that is converted or merged from parts therefore has the same bytes as a file that was written at once.

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
