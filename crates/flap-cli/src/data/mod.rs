//! Results as columns of numbers and words, for pictures and summaries.

pub(crate) mod axes;
pub(crate) mod columns;
pub(crate) mod filter;
pub(crate) mod levels;
pub(crate) mod source;
