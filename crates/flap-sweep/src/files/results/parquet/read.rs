//! Reads rows from a Parquet file, which may be damaged or come from another program.

use std::cell::Cell;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

use bytes::Bytes;
use csv::StringRecord;
use parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as PhysicalType};
use parquet::errors::ParquetError;
use parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData, RowGroupMetaData};
use parquet::file::reader::{ChunkReader, FileReader, Length, SerializedFileReader};
use parquet::record::Field;
use parquet::record::reader::RowIter;
use parquet::schema::types::Type;

use super::io_error;
use crate::files::results::checksum::TextDigest;
use crate::notation::text;
use crate::table::lines::Lines;

/// Reads the rows of a Parquet file as CSV text. For a file that flap wrote, the text equals the text from
/// which the file was written. Files of other programs are accepted if their cells are numbers, booleans or
/// text.
pub(crate) struct ParquetReader {
    /// Column names.
    pub(crate) names: Vec<String>,
    /// Metadata of the file, as pairs of a key and a text.
    pub(crate) entries: Vec<(String, String)>,
    rows: RowIter<'static>,
}

impl ParquetReader {
    pub(crate) fn new(file: File) -> io::Result<ParquetReader> {
        let reader = guarded(|| SerializedFileReader::new(Limited(file)).map_err(io_error))?;
        refuse_compression(reader.metadata())?;
        let about = reader.metadata().file_metadata();
        refuse_other_kinds(about.schema())?;
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
                _ => return Err(other_kind(name)),
            }
        }
        Ok(true)
    }
}

/// Returns an error if the file has a column whose type flap cannot read.
fn refuse_other_kinds(schema: &Type) -> io::Result<()> {
    let other = schema.get_fields().iter().find(|column| !is_read(column));
    other.map_or(Ok(()), |column| Err(other_kind(column.name())))
}

/// Returns true if [`ParquetReader::next`] can read the cells of this column.
fn is_read(column: &Type) -> bool {
    use ConvertedType::{ENUM, INT_32, INT_64, JSON, NONE, UINT_32, UINT_64, UTF8};
    let about = column.get_basic_info();
    // The library reads times in nanoseconds as whole numbers.
    let is_time = matches!(about.logical_type_ref(), Some(LogicalType::Time(_) | LogicalType::Timestamp(_)));
    let is_repeated = about.has_repetition() && about.repetition() == Repetition::REPEATED;
    if !column.is_primitive() || is_time || is_repeated {
        return false;
    }
    match column.get_physical_type() {
        PhysicalType::BOOLEAN | PhysicalType::FLOAT | PhysicalType::DOUBLE => true,
        PhysicalType::INT32 => matches!(about.converted_type(), NONE | INT_32 | UINT_32),
        PhysicalType::INT64 => matches!(about.converted_type(), NONE | INT_64 | UINT_64),
        PhysicalType::BYTE_ARRAY => matches!(about.converted_type(), UTF8 | ENUM | JSON),
        PhysicalType::INT96 | PhysicalType::FIXED_LEN_BYTE_ARRAY => false,
    }
}

/// Returns the error for a column whose type flap cannot read.
fn other_kind(column: &str) -> io::Error {
    let message = format!(
        "column {column} cannot be read: cells are whole numbers and floating-point ones of 32 or 64 bits, flags, and text"
    );
    io::Error::new(io::ErrorKind::InvalidData, message)
}

/// Returns an error if the file has a compression that flap does not support.
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

/// Returns the checksums of the rows in a file as CSV text. If the file cannot be decoded to its end, the
/// function also returns an error. After this error, the checksums cover only the rows that were decoded.
pub(crate) fn sum_up(file: File) -> (TextDigest, io::Result<()>) {
    let mut lines = Lines::new(TextDigest::new());
    let summed = ParquetReader::new(file).and_then(|mut reader| {
        lines.texts(&reader.names)?;
        let mut row = StringRecord::new();
        while reader.next(&mut row)? {
            lines.texts(&row)?;
        }
        Ok(())
    });
    // The digest contains the rows before damage.
    let flushed = lines.flush();
    (lines.target().clone(), summed.and(flushed))
}

thread_local! {
    static IS_GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Calls `decode`, which reads a file that may be damaged. A panic in `decode` becomes an error and is not
/// printed.
///
/// After a panic, the reader that `decode` used must not be used again.
fn guarded<T>(decode: impl FnOnce() -> io::Result<T>) -> io::Result<T> {
    static QUIET: Once = Once::new();
    QUIET.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |panicked| {
            if !IS_GUARDED.get() {
                print(panicked);
            }
        }));
    });
    IS_GUARDED.set(true);
    let decoded = panic::catch_unwind(AssertUnwindSafe(decode));
    IS_GUARDED.set(false);
    decoded.unwrap_or_else(|_| {
        Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "it cannot be decoded: it is damaged, or not a file of this format",
        ))
    })
}

/// Largest accepted size of a decompressed page of a Parquet file: 256 MiB. Pages that other programs write
/// have about 1 MiB, and pages that flap writes are smaller.
const LARGEST_PAGE: u64 = 256 << 20;

/// First byte of a field in Thrift's compact protocol. The byte means that the field is an integer, and that
/// the field's number is the number of the previous field plus one.
const NEXT_NUMBER: u8 = 0x15;

/// A Parquet file from which only pages of a limited size are read. The limit is necessary, because a few
/// compressed bytes can expand to a page of any size.
struct Limited(File);

impl Length for Limited {
    fn len(&self) -> u64 {
        self.0.len()
    }
}

impl ChunkReader for Limited {
    type T = BufReader<File>;

    // The parquet crate calls this at the header of a page, or at the end of the file, which does not look like a
    // header.
    fn get_read(&self, start: u64) -> Result<BufReader<File>, ParquetError> {
        let mut source = self.0.get_read(start)?;
        match declared(source.fill_buf()?) {
            Some(size) if size > LARGEST_PAGE => Err(ParquetError::General(format!(
                "one of its pages would take {} MiB of memory: flap reads pages of up to {} MiB",
                size >> 20,
                LARGEST_PAGE >> 20
            ))),
            _ => Ok(source),
        }
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes, ParquetError> {
        self.0.get_bytes(start, length)
    }
}

/// Reads the size of the decompressed page from the header of a page. The size is the second field of the
/// header.
///
/// Returns `None` if the bytes are not the header of a page. If the header of a page is damaged, the parquet
/// crate reports the mistake.
fn declared(header: &[u8]) -> Option<u64> {
    let (_, rest) = number(header)?;
    let (size, _) = number(rest)?;
    // The lowest bit is the sign.
    (size & 1 == 0).then_some(size >> 1)
}

/// Returns the integer at the beginning of `bytes`, and the bytes after the integer.
fn number(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let (&kind, bytes) = bytes.split_first()?;
    let length = bytes.iter().take(5).position(|byte| byte & 0x80 == 0)? + 1;
    let (digits, rest) = bytes.split_at(length);
    let value = digits.iter().rev().fold(0, |value, digit| value << 7 | u64::from(digit & 0x7f));
    (kind == NEXT_NUMBER).then_some((value, rest))
}

#[cfg(test)]
mod tests {
    use std::fs;
    use temp_dir::TempDir;

    use super::*;

    #[test]
    fn a_panic_is_an_error() {
        assert_eq!(guarded(|| Ok(7)).unwrap(), 7);
        let none: [u8; 0] = [];
        let error = guarded(|| Ok(none[std::hint::black_box(3)])).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::InvalidData);
        assert!(panic::catch_unwind(|| panic!("printed again")).is_err());
    }

    /// Returns the header of a dictionary page with the given size, in Thrift's compact protocol.
    fn header(size: usize) -> Vec<u8> {
        let number = |mut rest: usize| {
            let mut bytes = vec![NEXT_NUMBER];
            loop {
                let low = u8::try_from(rest & 0x7f).unwrap();
                rest >>= 7;
                if rest == 0 {
                    bytes.push(low);
                    return bytes;
                }
                bytes.push(low | 0x80);
            }
        };
        // The lowest bit of a number is its sign.
        [number(2 << 1), number(size << 1)].concat()
    }

    #[test]
    fn the_size_of_a_page_is_found_in_its_header() {
        for size in [0, 1, 63, 64, 8191, 1 << 20, 2_147_483_647] {
            assert_eq!(declared(&header(size)), Some(size as u64));
        }
        assert_eq!(declared(b"\x15\x80"), None);
        assert_eq!(declared(b"\x12\x34\0\0PAR1"), None);
    }

    #[test]
    fn a_huge_page_is_refused() {
        let folder = TempDir::new().unwrap();
        let path = folder.path().join("pages");
        let largest = usize::try_from(LARGEST_PAGE).unwrap();
        for (size, is_read) in [(largest, true), (largest + 1, false)] {
            fs::write(&path, header(size)).unwrap();
            let read = Limited(File::open(&path).unwrap()).get_read(0);
            assert_eq!(read.is_ok(), is_read);
            if let Err(error) = read {
                assert!(error.to_string().contains("pages of up to 256 MiB"), "{error}");
            }
        }
    }
}
