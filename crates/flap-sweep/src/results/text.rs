//! Rows as lines of comma-separated values, plain or compressed, into a file.

use std::fs::File;
use std::io::{self, Write};

use xxhash_rust::xxh3::Xxh3Default;

use super::Format;
use crate::layout::Cell;
use crate::lines::Lines;

/// Rows in one compressed frame. Frames begin at these rows whatever the threads do and wherever a run was resumed, so
/// that the bytes do not depend on it.
///
/// Rows in a frame that is not complete are lost if the process is killed. More of them would hardly make files smaller.
pub const BLOCK_ROWS: u32 = 256;

/// Zstandard's default: higher levels take longer and save little on digits.
const LEVEL: i32 = 3;

/// Writes one header line, then one line per row: [`Format::Csv`] as it is, otherwise in frames of [`BLOCK_ROWS`] rows.
pub struct TextRows {
    lines: Lines<Frames>,
    rows_in_block: u32,
}

/// How much of a file is written, and what that is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Extent {
    /// Bytes from the beginning of the file.
    pub(crate) bytes: u64,
    /// Their XXH3.
    pub(crate) digest: u64,
}

impl TextRows {
    /// Writes to `file`, which is empty.
    ///
    /// # Errors
    /// If there is no memory for the compressor.
    pub fn new(file: File, format: Format) -> io::Result<TextRows> {
        TextRows::after(file, format, Xxh3Default::new(), 0)
    }

    /// Goes on after the `bytes` in `file` whose hash is `hash`. They end where a row ends, and a frame.
    pub(crate) fn after(file: File, format: Format, hash: Xxh3Default, bytes: u64) -> io::Result<TextRows> {
        let compressor = match format {
            Format::Csv => None,
            Format::CsvZstd | Format::Parquet => Some(zstd::bulk::Compressor::new(LEVEL)?),
        };
        let frames = Frames { file, compressor, frame: Vec::new(), hash, bytes };
        Ok(TextRows { lines: Lines::new(frames), rows_in_block: 0 })
    }

    /// Writes the header, which is a frame of its own.
    ///
    /// # Errors
    /// What writing says.
    pub fn header<T: AsRef<str>>(&mut self, names: impl IntoIterator<Item = T>) -> io::Result<()> {
        self.lines.texts(names)?;
        self.lines.flush()
    }

    /// Writes a row.
    ///
    /// # Errors
    /// What writing says.
    pub fn row<T: AsRef<str>>(&mut self, cells: impl IntoIterator<Item = T>) -> io::Result<()> {
        self.lines.texts(cells)?;
        self.end_row()
    }

    /// Writes a row whose cells are not text yet.
    ///
    /// # Errors
    /// What writing says.
    pub(crate) fn cells(&mut self, cells: &[Cell]) -> io::Result<()> {
        self.lines.cells(cells)?;
        self.end_row()
    }

    fn end_row(&mut self) -> io::Result<()> {
        self.rows_in_block += 1;
        if self.rows_in_block == BLOCK_ROWS {
            self.rows_in_block = 0;
            self.lines.flush()?;
        }
        Ok(())
    }

    /// Hands rows to the operating system as far as that does not change the bytes: all of them, unless compressed.
    ///
    /// # Errors
    /// What writing says.
    pub fn flush(&mut self) -> io::Result<()> {
        if self.is_compressed() { Ok(()) } else { self.lines.flush() }
    }

    /// Ends the file here, be it within a frame.
    ///
    /// # Errors
    /// What writing says.
    pub fn finish(&mut self) -> io::Result<()> {
        self.lines.flush()
    }

    /// Whether a run that is resumed here yields the bytes of one that was not interrupted.
    pub(crate) fn may_be_cut(&self) -> bool {
        !self.is_compressed() || self.rows_in_block == 0
    }

    /// What has been written; complete after [`TextRows::flush`] where the file may be cut.
    pub(crate) fn extent(&self) -> Extent {
        let frames = self.lines.target();
        Extent { bytes: frames.bytes, digest: frames.hash.digest() }
    }

    /// The file.
    pub fn file(&self) -> &File {
        &self.lines.target().file
    }

    fn is_compressed(&self) -> bool {
        self.lines.target().compressor.is_some()
    }
}

/// A file that text goes into, as it is or as one compressed frame from each flush to the next.
struct Frames {
    file: File,
    compressor: Option<zstd::bulk::Compressor<'static>>,
    frame: Vec<u8>,
    hash: Xxh3Default,
    bytes: u64,
}

impl Frames {
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        self.hash.update(bytes);
        self.bytes += bytes.len() as u64;
        Ok(())
    }
}

impl Write for Frames {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        if self.compressor.is_some() {
            self.frame.extend_from_slice(text);
        } else {
            self.put(text)?;
        }
        Ok(text.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if let Some(compressor) = &mut self.compressor
            && !self.frame.is_empty()
        {
            let frame = compressor.compress(&self.frame)?;
            self.frame.clear();
            self.put(&frame)?;
        }
        Ok(())
    }
}
