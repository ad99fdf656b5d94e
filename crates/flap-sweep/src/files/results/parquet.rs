//! Rows as typed columns in Parquet files.

use std::fs::File;
use std::io;
use std::sync::Arc;

use bytes::Bytes;
use csv::StringRecord;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::column::writer::{ColumnCloseResult, ColumnWriter, get_column_writer};
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use parquet::file::metadata::{ColumnChunkMetaData, KeyValue, ParquetMetaData, RowGroupMetaData};
use parquet::file::properties::{WriterProperties, WriterPropertiesPtr};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::record::Field;
use parquet::record::reader::RowIter;
use parquet::schema::types::{ColumnDescPtr, ColumnPath, Type};

use super::checksum::TextDigest;
use super::guard::guarded;
use super::hashed::Hashed;
use super::limited::Limited;
use super::pages::Pages;
use super::{Checksums, Provenance};
use crate::notation::text;
use crate::table::layout::{Column, Kind};
use crate::table::lines;

/// Rows in one row group: a few megabytes in memory, and long enough to be read fast.
const GROUP_ROWS: usize = 1 << 15;

/// Writes rows in row groups; an empty cell is null.
pub(super) struct ParquetRows {
    writer: SerializedFileWriter<Hashed>,
    columns: Vec<Cells>,
    rows: usize,
    text: TextDigest,
    /// The row as text; kept for its memory.
    line: String,
}

/// The cells of one column in the row group that is being filled.
struct Cells {
    name: String,
    values: Values,
    /// One per row: 1 for a value, 0 for null.
    levels: Vec<i16>,
}

enum Values {
    Whole(Vec<i64>),
    Number(Vec<f64>),
    Flag(Vec<bool>),
    Text(Vec<ByteArray>),
}

impl ParquetRows {
    pub(super) fn new(file: File, provenance: &Provenance) -> io::Result<ParquetRows> {
        let columns = &provenance.columns;
        let fields = columns.iter().map(|column| field(column).map(Arc::new)).collect::<Result<_, _>>();
        let schema = Type::group_type_builder("flap").with_fields(fields.map_err(io_error)?).build();
        let entries = provenance.entries.iter();
        let metadata = entries.map(|(key, text)| KeyValue::new(key.clone(), text.clone())).collect();
        // Digits seldom repeat, words always do.
        let mut properties = WriterProperties::builder()
            .set_compression(Compression::ZSTD(parquet::basic::ZstdLevel::default()))
            .set_dictionary_enabled(false)
            .set_key_value_metadata(Some(metadata));
        for column in columns.iter().filter(|column| column.kind == Kind::Text) {
            let path = ColumnPath::from(column.name.as_str());
            properties = properties.set_column_dictionary_enabled(path, true);
        }
        let schema = Arc::new(schema.map_err(io_error)?);
        let writer = SerializedFileWriter::new(Hashed::new(file), schema, Arc::new(properties.build()));
        let (mut text, mut line) = (TextDigest::new(), String::new());
        lines::set_line(&mut line, columns.iter().map(|column| &column.name));
        text.update(line.as_bytes());
        let columns = columns.iter().map(Cells::new).collect();
        Ok(ParquetRows { writer: writer.map_err(io_error)?, columns, rows: 0, text, line })
    }

    pub(super) fn row(&mut self, cells: &StringRecord) -> io::Result<()> {
        if cells.len() != self.columns.len() {
            let message = format!("a row has {} cells, not {}", cells.len(), self.columns.len());
            return Err(io::Error::new(io::ErrorKind::InvalidData, message));
        }
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            column.push(cell)?;
        }
        lines::set_line(&mut self.line, cells);
        self.text.update(self.line.as_bytes());
        self.rows += 1;
        if self.rows == GROUP_ROWS { self.write_group() } else { Ok(()) }
    }

    /// Completes the file and makes it durable.
    pub(super) fn finish(mut self) -> io::Result<Checksums> {
        if self.rows > 0 {
            self.write_group()?;
        }
        let written = self.writer.into_inner().map_err(io_error)?;
        written.file.sync_all()?;
        Ok(self.text.checksums(Some(written.sum())))
    }

    fn write_group(&mut self) -> io::Result<()> {
        let properties = Arc::clone(self.writer.properties());
        let schema = self.writer.schema_descr().clone();
        let mut group = self.writer.next_row_group().map_err(io_error)?;
        for (column, descriptor) in self.columns.iter_mut().zip(schema.columns()) {
            let (pages, closed) = column.chunk(descriptor, &properties).map_err(io_error)?;
            group.append_column(&pages, closed).map_err(io_error)?;
            column.clear();
        }
        group.close().map_err(io_error)?;
        self.rows = 0;
        Ok(())
    }
}

fn field(column: &Column) -> Result<Type, ParquetError> {
    let (physical, logical) = match column.kind {
        Kind::Whole => (Physical::INT64, Some(LogicalType::integer(64, false))),
        Kind::Number => (Physical::DOUBLE, None),
        Kind::Flag => (Physical::BOOLEAN, None),
        Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    Type::primitive_type_builder(&column.name, physical)
        .with_logical_type(logical)
        .with_repetition(Repetition::OPTIONAL)
        .build()
}

impl Cells {
    fn new(column: &Column) -> Cells {
        let values = match column.kind {
            Kind::Whole => Values::Whole(Vec::new()),
            Kind::Number => Values::Number(Vec::new()),
            Kind::Flag => Values::Flag(Vec::new()),
            Kind::Text => Values::Text(Vec::new()),
        };
        Cells { name: column.name.clone(), values, levels: Vec::new() }
    }

    fn push(&mut self, cell: &str) -> io::Result<()> {
        self.levels.push(i16::from(!cell.is_empty()));
        if cell.is_empty() {
            return Ok(());
        }
        let fits = match &mut self.values {
            // Parquet keeps the bits of an unsigned number in a signed one.
            Values::Whole(values) => {
                cell.parse::<u64>().map(|value| values.push(value.cast_signed())).is_ok()
            }
            Values::Number(values) => cell.parse().map(|value| values.push(value)).is_ok(),
            Values::Flag(values) => cell.parse().map(|value| values.push(value)).is_ok(),
            Values::Text(values) => {
                values.push(ByteArray::from(cell));
                true
            }
        };
        if fits {
            return Ok(());
        }
        let message = format!("`{cell}` does not belong into column {}", self.name);
        Err(io::Error::new(io::ErrorKind::InvalidData, message))
    }

    /// The cells as pages, and what the file is to say of them.
    fn chunk(
        &self,
        descriptor: &ColumnDescPtr,
        properties: &WriterPropertiesPtr,
    ) -> Result<(Bytes, ColumnCloseResult), ParquetError> {
        let mut pages = Vec::new();
        let writer =
            get_column_writer(Arc::clone(descriptor), Arc::clone(properties), Box::new(Pages(&mut pages)));
        let levels = Some(self.levels.as_slice());
        let closed = match (writer, &self.values) {
            (ColumnWriter::Int64ColumnWriter(mut writer), Values::Whole(values)) => {
                writer.write_batch(values, levels, None)?;
                writer.close()
            }
            (ColumnWriter::DoubleColumnWriter(mut writer), Values::Number(values)) => {
                writer.write_batch(values, levels, None)?;
                writer.close()
            }
            (ColumnWriter::BoolColumnWriter(mut writer), Values::Flag(values)) => {
                writer.write_batch(values, levels, None)?;
                writer.close()
            }
            (ColumnWriter::ByteArrayColumnWriter(mut writer), Values::Text(values)) => {
                writer.write_batch(values, levels, None)?;
                writer.close()
            }
            _ => Err(ParquetError::General(format!("column {} is of another type in the schema", self.name))),
        }?;
        Ok((Bytes::from(pages), closed))
    }

    fn clear(&mut self) {
        self.levels.clear();
        match &mut self.values {
            Values::Whole(values) => values.clear(),
            Values::Number(values) => values.clear(),
            Values::Flag(values) => values.clear(),
            Values::Text(values) => values.clear(),
        }
    }
}

/// Reads rows back as the text they were written from; those of other programs, if cells are numbers, flags and text.
pub(super) struct ParquetReader {
    names: Vec<String>,
    entries: Vec<(String, String)>,
    rows: RowIter<'static>,
}

impl ParquetReader {
    pub(super) fn new(file: File) -> io::Result<ParquetReader> {
        let reader = guarded(|| SerializedFileReader::new(Limited(file)).map_err(io_error))?;
        refuse_compression(reader.metadata())?;
        let about = reader.metadata().file_metadata();
        let names = about.schema().get_fields().iter().map(|column| column.name().to_owned()).collect();
        let entries = about.key_value_metadata().into_iter().flatten();
        let entries = entries.filter_map(|entry| Some((entry.key.clone(), entry.value.clone()?))).collect();
        Ok(ParquetReader { names, entries, rows: RowIter::from_file_into(Box::new(reader)) })
    }

    /// What the file says of itself: keys with their texts.
    pub(super) fn entries(&self) -> &[(String, String)] {
        &self.entries
    }

    pub(super) fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    pub(super) fn next(&mut self, row: &mut StringRecord) -> io::Result<bool> {
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

/// Refuses what can only be decompressed by libraries that flap does without.
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

/// Sums up the text of the rows in a file. What cannot be decoded ends it: then with an error too.
pub(crate) fn sum_up(file: File) -> (TextDigest, io::Result<()>) {
    let mut digest = TextDigest::new();
    let summed = ParquetReader::new(file).and_then(|mut reader| {
        let mut line = String::new();
        lines::set_line(&mut line, reader.names());
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

/// What the operating system said, or what is wrong with the file.
fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(cause) => match cause.downcast::<io::Error>() {
            Ok(cause) => *cause,
            Err(cause) => io::Error::other(cause),
        },
        other => io::Error::new(io::ErrorKind::InvalidData, other),
    }
}
