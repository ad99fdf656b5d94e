//! Rows out of a Parquet file.

use std::fs::File;
use std::io;

use csv::StringRecord;
use parquet::basic::Compression;
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData, RowGroupMetaData};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use parquet::record::reader::RowIter;

use super::error::io_error;
use super::guard::guarded;
use super::limited::Limited;
use crate::files::results::checksum::TextDigest;
use crate::notation::text;
use crate::table::lines;

/// Reads rows back as the text they were written from. Files of other programs are read if their cells are numbers, flags
/// and text.
pub(crate) struct ParquetReader {
    /// The column names.
    pub(crate) names: Vec<String>,
    /// The metadata, as keys with their texts.
    pub(crate) entries: Vec<(String, String)>,
    rows: RowIter<'static>,
}

impl ParquetReader {
    pub(crate) fn new(file: File) -> io::Result<ParquetReader> {
        let reader = guarded(|| SerializedFileReader::new(Limited(file)).map_err(io_error))?;
        refuse_compression(reader.metadata())?;
        let about = reader.metadata().file_metadata();
        let names = about.schema().get_fields().iter().map(|column| column.name().to_owned()).collect();
        let entries = about.key_value_metadata().into_iter().flatten();
        let entries = entries.filter_map(|entry| Some((entry.key.clone(), entry.value.clone()?))).collect();
        Ok(ParquetReader { names, entries, rows: RowIter::from_file_into(Box::new(reader)) })
    }

    pub(crate) fn next(&mut self, row: &mut StringRecord) -> io::Result<bool> {
        row.clear();
        let Some(fields) = guarded(|| self.rows.next().transpose().map_err(io_error))? else {
            return Ok(false);
        };
        for (name, field) in fields.get_column_iter() {
            match field {
                Field::Null => row.push_field(""),
                Field::ULong(value) => row.push_field(&value.to_string()),
                Field::UInt(value) => row.push_field(&value.to_string()),
                Field::Long(value) => row.push_field(&value.to_string()),
                Field::Int(value) => row.push_field(&value.to_string()),
                Field::Double(value) => row.push_field(&text::float(*value)),
                Field::Float(value) => row.push_field(&text::float(f64::from(*value))),
                Field::Bool(value) => row.push_field(&value.to_string()),
                Field::Str(value) => row.push_field(value),
                _ => {
                    let message = format!(
                        "column {name} cannot be read: cells are whole numbers and floating-point ones of 32 or 64 bits, \
                         flags, and text"
                    );
                    return Err(io::Error::new(io::ErrorKind::InvalidData, message));
                }
            }
        }
        Ok(true)
    }
}

/// Refuses files that need a decompression library which flap does without.
fn refuse_compression(metadata: &ParquetMetaData) -> io::Result<()> {
    let columns = metadata.row_groups().iter().flat_map(RowGroupMetaData::columns);
    let other = columns.map(ColumnChunkMetaData::compression).find(|compression| {
        !matches!(compression, Compression::UNCOMPRESSED | Compression::SNAPPY | Compression::ZSTD(_))
    });
    let Some(other) = other else { return Ok(()) };
    let name = other.to_string();
    let name = name.split('(').next().unwrap_or_default();
    let message = format!(
        "its columns are compressed with {name}: flap reads Parquet files with Zstandard, Snappy or no compression, so write \
         it again with one of these"
    );
    Err(io::Error::new(io::ErrorKind::InvalidData, message))
}

/// The digest of the rows in a file as text; with an error if that ends where the file cannot be decoded.
pub(crate) fn sum_up(file: File) -> (TextDigest, io::Result<()>) {
    let mut digest = TextDigest::new();
    let summed = ParquetReader::new(file).and_then(|mut reader| {
        let mut line = String::new();
        lines::set_line(&mut line, &reader.names);
        digest.update(line.as_bytes());
        let mut row = StringRecord::new();
        while reader.next(&mut row)? {
            lines::set_line(&mut line, &row);
            digest.update(line.as_bytes());
        }
        Ok(())
    });
    (digest, summed)
}
