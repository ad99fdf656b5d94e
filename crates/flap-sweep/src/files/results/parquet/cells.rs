//! The cells of a column as pages of a Parquet file.

use std::io;
use std::sync::Arc;

use bytes::Bytes;
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::column::writer::{ColumnCloseResult, ColumnWriter, ColumnWriterImpl, get_column_writer};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterPropertiesPtr;
use parquet::schema::types::{ColumnDescPtr, Type};

use super::pages::Pages;
use crate::table::layout::{Cell, Column, Kind};

/// The cells of one column in the row group that is being filled.
pub(super) struct Cells {
    column: Column,
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

/// The column in the schema of a file.
pub(super) fn field(column: &Column) -> Result<Type, ParquetError> {
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
    /// No cells of `column`.
    pub(super) fn new(column: &Column) -> Cells {
        let values = match column.kind {
            Kind::Whole => Values::Whole(Vec::new()),
            Kind::Number => Values::Number(Vec::new()),
            Kind::Flag => Values::Flag(Vec::new()),
            Kind::Text => Values::Text(Vec::new()),
        };
        Cells { column: column.clone(), values, levels: Vec::new() }
    }

    /// Adds a cell; an empty one is null.
    pub(super) fn push(&mut self, cell: &str) -> io::Result<()> {
        self.levels.push(i16::from(!cell.is_empty()));
        if cell.is_empty() {
            return Ok(());
        }
        match (Cell::parse(self.column.kind, cell), &mut self.values) {
            // Parquet keeps the bits of an unsigned number in a signed one.
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

    /// Takes the cells out as pages, with their entry in the index of the file.
    pub(super) fn take(
        &mut self,
        descriptor: &ColumnDescPtr,
        properties: &WriterPropertiesPtr,
    ) -> Result<(Bytes, ColumnCloseResult), ParquetError> {
        let mut pages = Vec::new();
        let writer =
            get_column_writer(Arc::clone(descriptor), Arc::clone(properties), Box::new(Pages(&mut pages)));
        let none = Cells::new(&self.column);
        let Cells { column, values, levels } = std::mem::replace(self, none);
        let closed = match (writer, values) {
            (ColumnWriter::Int64ColumnWriter(writer), Values::Whole(values)) => {
                write(writer, &values, &levels)
            }
            (ColumnWriter::DoubleColumnWriter(writer), Values::Number(values)) => {
                write(writer, &values, &levels)
            }
            (ColumnWriter::BoolColumnWriter(writer), Values::Flag(values)) => write(writer, &values, &levels),
            (ColumnWriter::ByteArrayColumnWriter(writer), Values::Text(values)) => {
                write(writer, &values, &levels)
            }
            _ => {
                Err(ParquetError::General(format!("column {} is of another type in the schema", column.name)))
            }
        }?;
        Ok((Bytes::from(pages), closed))
    }
}

fn write<T: DataType>(
    mut writer: ColumnWriterImpl<'_, T>,
    values: &[T::T],
    levels: &[i16],
) -> Result<ColumnCloseResult, ParquetError> {
    writer.write_batch(values, Some(levels), None)?;
    writer.close()
}
