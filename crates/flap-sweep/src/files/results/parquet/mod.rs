//! Writes rows into the typed columns of Parquet files.

use std::fs::File;
use std::io;
use std::sync::Arc;

use csv::StringRecord;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{ColumnPath, Type};

use crate::files::results::checksum::{Checksums, TextDigest};
use crate::files::results::provenance::Provenance;
use crate::files::results::text::Hashed;
use crate::table::layout::{Cell, CellKind, Column};
use crate::table::lines::Lines;

mod read;

pub(super) use read::{ParquetReader, sum_up};

/// Number of rows in one row group. A row group takes a few megabytes of memory, and is large enough for fast
/// reading.
const GROUP_ROWS: usize = 1 << 15;

/// Writes rows into the row groups of a Parquet file. An empty cell becomes a null value.
pub(crate) struct ParquetRows {
    writer: SerializedFileWriter<Hashed>,
    columns: Vec<Cells>,
    rows: usize,
    /// Checksums of the rows as CSV text.
    text: Lines<TextDigest>,
}

impl ParquetRows {
    /// Creates an empty file.
    pub(crate) fn new(file: File, provenance: &Provenance) -> io::Result<ParquetRows> {
        let columns = &provenance.columns;
        let fields = columns.iter().map(|column| field(column).map(Arc::new)).collect::<Result<_, _>>();
        let schema = Type::group_type_builder("flap").with_fields(fields.map_err(io_error)?).build();
        let entries = provenance.entries.iter();
        let metadata = entries.map(|(key, text)| KeyValue::new(key.clone(), text.clone())).collect();
        // Dictionaries help with words, which repeat, but not with digits.
        let mut properties = WriterProperties::builder()
            .set_compression(Compression::ZSTD(ZstdLevel::default()))
            .set_dictionary_enabled(false)
            .set_key_value_metadata(Some(metadata));
        for column in columns.iter().filter(|column| column.kind == CellKind::Text) {
            let path = ColumnPath::from(column.name.as_str());
            properties = properties.set_column_dictionary_enabled(path, true);
        }
        let schema = Arc::new(schema.map_err(io_error)?);
        let writer = SerializedFileWriter::new(Hashed::new(file), schema, Arc::new(properties.build()));
        let mut text = Lines::new(TextDigest::new());
        text.texts(columns.iter().map(|column| &column.name))?;
        let columns = columns.iter().map(Cells::new).collect();
        Ok(ParquetRows { writer: writer.map_err(io_error)?, columns, rows: 0, text })
    }

    /// Writes a row.
    pub(crate) fn row(&mut self, cells: &StringRecord) -> io::Result<()> {
        if cells.len() != self.columns.len() {
            let message = format!("a row has {} cells, not {}", cells.len(), self.columns.len());
            return Err(io::Error::new(io::ErrorKind::InvalidData, message));
        }
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            column.push(cell)?;
        }
        self.text.texts(cells)?;
        self.rows += 1;
        if self.rows == GROUP_ROWS { self.write_group() } else { Ok(()) }
    }

    /// Completes the file, waits until the file is safe on disk, and returns the checksums of the file.
    pub(crate) fn finish(mut self) -> io::Result<Checksums> {
        if self.rows > 0 {
            self.write_group()?;
        }
        let written = self.writer.into_inner().map_err(io_error)?;
        written.file.sync_all()?;
        self.text.flush()?;
        Ok(self.text.target().checksums(Some(written.sum())))
    }

    fn write_group(&mut self) -> io::Result<()> {
        let mut group = self.writer.next_row_group().map_err(io_error)?;
        for column in &mut self.columns {
            let writer = group.next_column().map_err(io_error)?;
            column.write(writer.ok_or_else(|| io::Error::other("the schema has fewer columns"))?)?;
        }
        group.close().map_err(io_error)?;
        self.rows = 0;
        Ok(())
    }
}

/// Cells of one column in the current row group.
struct Cells {
    column: Column,
    values: Values,
    /// One entry per row: 1 if the cell has a value, 0 if the cell is empty.
    levels: Vec<i16>,
}

enum Values {
    Whole(Vec<i64>),
    Number(Vec<f64>),
    Flag(Vec<bool>),
    Text(Vec<ByteArray>),
}

/// Returns the entry of the column in the schema of a Parquet file.
fn field(column: &Column) -> Result<Type, ParquetError> {
    let (physical, logical) = match column.kind {
        CellKind::Whole => (Physical::INT64, Some(LogicalType::integer(64, false))),
        CellKind::Number => (Physical::DOUBLE, None),
        CellKind::Flag => (Physical::BOOLEAN, None),
        CellKind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    Type::primitive_type_builder(&column.name, physical)
        .with_logical_type(logical)
        .with_repetition(Repetition::OPTIONAL)
        .build()
}

impl Cells {
    /// Returns an empty column.
    fn new(column: &Column) -> Cells {
        let values = match column.kind {
            CellKind::Whole => Values::Whole(Vec::new()),
            CellKind::Number => Values::Number(Vec::new()),
            CellKind::Flag => Values::Flag(Vec::new()),
            CellKind::Text => Values::Text(Vec::new()),
        };
        Cells { column: column.clone(), values, levels: Vec::new() }
    }

    /// Adds a cell. An empty cell becomes a null value.
    fn push(&mut self, cell: &str) -> io::Result<()> {
        self.levels.push(i16::from(!cell.is_empty()));
        if cell.is_empty() {
            return Ok(());
        }
        match (Cell::parse(self.column.kind, cell), &mut self.values) {
            // Parquet stores the bits of an unsigned number in a signed one.
            (Some(Cell::Whole(value)), Values::Whole(values)) => values.push(value.cast_signed()),
            (Some(Cell::Number(value)), Values::Number(values)) => values.push(value),
            (Some(Cell::Flag(Some(value))), Values::Flag(values)) => values.push(value),
            (Some(Cell::Text(value)), Values::Text(values)) => values.push(ByteArray::from(value)),
            _ => {
                let message = format!("`{cell}` does not fit column {}", self.column.name);
                return Err(io::Error::new(io::ErrorKind::InvalidData, message));
            }
        }
        Ok(())
    }

    /// Writes the cells as the next column of the row group, then removes the cells from memory.
    fn write(&mut self, mut writer: SerializedColumnWriter<'_>) -> io::Result<()> {
        fn write<T: DataType>(
            writer: &mut SerializedColumnWriter<'_>,
            values: &mut Vec<T::T>,
            levels: &[i16],
        ) -> Result<(), ParquetError> {
            writer.typed::<T>().write_batch(values, Some(levels), None)?;
            values.clear();
            Ok(())
        }
        let levels = &self.levels;
        let written = match &mut self.values {
            Values::Whole(values) => write::<Int64Type>(&mut writer, values, levels),
            Values::Number(values) => write::<DoubleType>(&mut writer, values, levels),
            Values::Flag(values) => write::<BoolType>(&mut writer, values, levels),
            Values::Text(values) => write::<ByteArrayType>(&mut writer, values, levels),
        };
        self.levels.clear();
        written.and_then(|()| writer.close()).map_err(io_error)
    }
}

/// Converts an error of the parquet crate into an I/O error. The result is the error of the operating system,
/// or [`io::ErrorKind::InvalidData`] with the mistake in the file.
fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(cause) => match cause.downcast::<io::Error>() {
            Ok(cause) => *cause,
            Err(cause) => io::Error::other(cause),
        },
        other => io::Error::new(io::ErrorKind::InvalidData, other),
    }
}
