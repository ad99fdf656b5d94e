//! Rows as typed columns in Parquet files.

mod cells;
mod error;
mod guard;
mod limited;
mod pages;
mod read;
mod write;

pub(super) use read::{ParquetReader, sum_up};
pub(super) use write::ParquetRows;
