//! Tables of rows: their columns, rows as text, and the formats of their files.

pub mod format;
pub mod labels;
pub mod layout;
pub(crate) mod lines;
