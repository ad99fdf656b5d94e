//! Parquet files with pages of limited size.

use std::fs::File;
use std::io::{BufRead, BufReader};

use bytes::Bytes;
use parquet::errors::{ParquetError, Result};
use parquet::file::reader::{ChunkReader, Length};

/// Largest size of a decompressed page: 256 MiB. Other programs write pages of about 1 MiB, and those of flap are smaller.
const LARGEST_PAGE: u64 = 256 << 20;

/// First byte of a field that is a whole number and follows the one before, in Thrift's compact protocol.
const NEXT_NUMBER: u8 = 0x15;

/// A file whose pages are refused if they declare too many bytes: a few compressed bytes can stand for any number of others.
pub(super) struct Limited(pub(super) File);

impl Length for Limited {
    fn len(&self) -> u64 {
        self.0.len()
    }
}

impl ChunkReader for Limited {
    type T = BufReader<File>;

    // The parquet crate calls this at the header of a page, or at the end of the file, which does not look like a header.
    fn get_read(&self, start: u64) -> Result<BufReader<File>> {
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

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes> {
        self.0.get_bytes(start, length)
    }
}

/// The size of a page when it is decompressed: the second field of its header. `None` if the bytes are no header; the parquet
/// crate then reports the mistake.
fn declared(header: &[u8]) -> Option<u64> {
    let (_, rest) = number(header)?;
    let (size, _) = number(rest)?;
    // The lowest bit is the sign.
    (size & 1 == 0).then_some(size >> 1)
}

/// A field that is a whole number, and the bytes behind it.
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

    use parquet::basic::Encoding;
    use parquet::column::page::{CompressedPage, Page};

    use super::super::pages;
    use super::*;

    fn header(size: usize) -> Vec<u8> {
        let page = Page::DictionaryPage {
            buf: Bytes::new(),
            num_values: 1,
            encoding: Encoding::PLAIN,
            is_sorted: false,
        };
        pages::header(&CompressedPage::new(page, size)).unwrap()
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
        let folder = tempfile::tempdir().unwrap();
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
