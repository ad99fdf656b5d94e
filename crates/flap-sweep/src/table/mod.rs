//! Describes tables of rows: columns, labels of columns, rows as text, and formats of files.

pub mod format;
pub mod labels;
pub mod layout;
pub(crate) mod lines;
