//! Pages of Parquet files with their checksums, which the parquet crate (60) checks but does not write.

use parquet::basic::PageType;
use parquet::column::page::{CompressedPage, Page, PageWriteSpec, PageWriter};
use parquet::errors::{ParquetError, Result};

/// Kinds of fields in Thrift's compact protocol.
const TRUE: u8 = 1;
const FALSE: u8 = 2;
const I32: u8 = 5;
const STRUCT: u8 = 12;

/// Collects the pages of a column chunk.
pub(super) struct Pages<'a>(pub(super) &'a mut Vec<u8>);

impl PageWriter for Pages<'_> {
    fn write_page(&mut self, page: CompressedPage) -> Result<PageWriteSpec> {
        let header = header(&page)?;
        let offset = self.0.len();
        self.0.extend_from_slice(&header);
        self.0.extend_from_slice(page.data());
        let mut spec = PageWriteSpec::new();
        spec.page_type = page.page_type();
        spec.uncompressed_size = page.uncompressed_size() + header.len();
        spec.compressed_size = page.compressed_size() + header.len();
        spec.num_values = page.num_values();
        spec.offset = offset as u64;
        spec.bytes_written = (self.0.len() - offset) as u64;
        Ok(spec)
    }

    fn close(&mut self) -> Result<()> {
        Ok(())
    }
}

/// The header of a page, with the checksum of the page as it is stored: `PageHeader` of Parquet's Thrift definition.
pub(super) fn header(page: &CompressedPage) -> Result<Vec<u8>> {
    let size = |size: usize| i32::try_from(size).map_err(|error| ParquetError::General(error.to_string()));
    let values = size(page.num_values() as usize)?;
    let mut header = Struct::default();
    header.number(1, page.page_type() as i32);
    header.number(2, size(page.uncompressed_size())?);
    header.number(3, size(page.compressed_size())?);
    header.number(4, crc32fast::hash(page.data()).cast_signed());
    match page.compressed_page() {
        Page::DataPage { encoding, def_level_encoding, rep_level_encoding, .. } => {
            header.begin(5, STRUCT);
            let mut data = Struct::default();
            data.number(1, values);
            data.number(2, *encoding as i32);
            data.number(3, *def_level_encoding as i32);
            data.number(4, *rep_level_encoding as i32);
            header.bytes.extend(data.end());
        }
        Page::DictionaryPage { encoding, is_sorted, .. } => {
            header.begin(7, STRUCT);
            let mut dictionary = Struct::default();
            dictionary.number(1, values);
            dictionary.number(2, *encoding as i32);
            dictionary.begin(3, if *is_sorted { TRUE } else { FALSE });
            header.bytes.extend(dictionary.end());
        }
        Page::DataPageV2 { .. } => {
            return Err(ParquetError::NYI(format!("pages of the kind {:?}", PageType::DATA_PAGE_V2)));
        }
    }
    Ok(header.end())
}

/// A structure in Thrift's compact protocol.
#[derive(Default)]
struct Struct {
    bytes: Vec<u8>,
    last: u8,
}

impl Struct {
    /// Begins a field, whose number is at most 15 above that of the one before.
    fn begin(&mut self, field: u8, kind: u8) {
        self.bytes.push((field - self.last) << 4 | kind);
        self.last = field;
    }

    /// A whole number: seven bits a byte, its sign in the lowest one.
    fn number(&mut self, field: u8, number: i32) {
        self.begin(field, I32);
        let mut rest = ((number << 1) ^ (number >> 31)).cast_unsigned();
        loop {
            let [low, ..] = rest.to_le_bytes();
            rest >>= 7;
            if rest == 0 {
                return self.bytes.push(low);
            }
            self.bytes.push(low | 0x80);
        }
    }

    fn end(mut self) -> Vec<u8> {
        self.bytes.push(0);
        self.bytes
    }
}
