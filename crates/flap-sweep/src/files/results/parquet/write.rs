//! Rows into a Parquet file.

use std::fs::File;
use std::io;
use std::sync::Arc;

use csv::StringRecord;
use parquet::basic::{Compression, ZstdLevel};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};

use super::cells::{Cells, field};
use super::error::io_error;
use crate::files::results::checksum::{Checksums, TextDigest};
use crate::files::results::hashed::Hashed;
use crate::files::results::provenance::Provenance;
use crate::table::layout::Kind;
use crate::table::lines;

/// Rows in one row group: a few megabytes in memory, and long enough to be read fast.
const GROUP_ROWS: usize = 1 << 15;

/// Writes rows in row groups; an empty cell is null.
pub(crate) struct ParquetRows {
    writer: SerializedFileWriter<Hashed>,
    columns: Vec<Cells>,
    rows: usize,
    text: TextDigest,
    /// The row as text; kept for its memory.
    line: String,
}

impl ParquetRows {
    /// Begins an empty file.
    pub(crate) fn new(file: File, provenance: &Provenance) -> io::Result<ParquetRows> {
        let columns = &provenance.columns;
        let fields = columns.iter().map(|column| field(column).map(Arc::new)).collect::<Result<_, _>>();
        let schema = Type::group_type_builder("flap").with_fields(fields.map_err(io_error)?).build();
        let entries = provenance.entries.iter();
        let metadata = entries.map(|(key, text)| KeyValue::new(key.clone(), text.clone())).collect();
        // Digits seldom repeat, words always do.
        let mut properties = WriterProperties::builder()
            .set_compression(Compression::ZSTD(ZstdLevel::default()))
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

    /// Writes a row.
    pub(crate) fn row(&mut self, cells: &StringRecord) -> io::Result<()> {
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

    /// Completes the file, makes it durable, and gives its checksums.
    pub(crate) fn finish(mut self) -> io::Result<Checksums> {
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
            let (pages, closed) = column.take(descriptor, &properties).map_err(io_error)?;
            group.append_column(&pages, closed).map_err(io_error)?;
        }
        group.close().map_err(io_error)?;
        self.rows = 0;
        Ok(())
    }
}
