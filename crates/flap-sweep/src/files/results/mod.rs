//! Result files: their formats, and rows as text into them and out of them.
//!
//! Rows are the same text in every format: a cell is the text that [`Layout::cells`](crate::table::layout::Layout::cells)
//! gives, whether it comes from a model or from a file. A file that is converted or merged from parts
//! therefore has the same bytes as a file that was written at once.

mod bounded;
mod checked;
mod checksum;
mod convert;
mod hashed;
#[cfg(feature = "parquet")]
mod parquet;
mod provenance;
mod read;
mod row_check;
mod sum_up;
mod text;
mod write;

pub use crate::table::format::{Format, FormatError};
pub use bounded::Bounded;
pub(crate) use checked::Checked;
pub use checked::RowsError;
pub(crate) use checksum::TextDigest;
pub use checksum::{BLOCK_ROWS, Checksums, FileSum};
pub use convert::{ConvertError, Converted, convert};
pub(crate) use provenance::parameters;
pub use provenance::{Provenance, Recorded};
pub use read::{Missed, Reader};
pub use row_check::{RowCheck, RowError};
pub(crate) use sum_up::sum_up;
pub use text::TextRows;
pub(crate) use text::text_sum;
pub use write::Writer;
