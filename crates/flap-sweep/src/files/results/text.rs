//! Writes rows as CSV text into a plain or compressed file, and computes the checksum of the file.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};

use xxhash_rust::xxh3::Xxh3Default;

use super::checksum::{BLOCK_ROWS, TextDigest};
use super::{Checksums, FileSum, Format};
use crate::notation::text::digits;
use crate::table::layout::Cell;
use crate::table::lines::Lines;

/// Compression level: Zstandard's default. Higher levels take longer, and the files are hardly smaller.
const LEVEL: i32 = 3;

/// Binary logarithm of the largest memory, in bytes, for decompressing a file. The command `zstd` also
/// limits the memory to 128 MiB by default.
const WINDOW_LOG_MAX: u32 = 27;

/// Writer of CSV text: one header line, then one line per row.
///
/// [`Format::Csv`] is plain text. In all formats except [`Format::Csv`], the text is compressed in frames of
/// [`BLOCK_ROWS`] rows.
pub struct TextRows {
    lines: Lines<Frames>,
    rows_in_block: u32,
}

impl TextRows {
    /// Returns a writer to `file`, which must be empty.
    ///
    /// # Errors
    /// [`io::ErrorKind::Other`] if there is not enough memory for the compressor.
    pub fn new(file: File, format: Format) -> io::Result<TextRows> {
        TextRows::after(file, format, (Xxh3Default::new(), 0), TextDigest::new())
    }

    /// Returns a writer that continues `file` after its first `bytes` bytes. `hash` is the hash of these
    /// bytes, and `text` contains the checksums of the rows in these bytes.
    ///
    /// The first `bytes` bytes must end with a complete row, and in compressed files with a complete frame.
    pub(crate) fn after(
        file: File,
        format: Format,
        (hash, bytes): (Xxh3Default, u64),
        text: TextDigest,
    ) -> io::Result<TextRows> {
        let mut compressor = match format {
            Format::Csv => None,
            Format::CsvZstd | Format::Parquet => Some(zstd::bulk::Compressor::new(LEVEL)?),
        };
        // Frames end in a checksum, so that any reader detects damage.
        compressor.as_mut().map_or(Ok(()), |compressor| compressor.include_checksum(true))?;
        let file = Hashed { file, hash, bytes };
        let frames = Frames { file, compressor, frame: Vec::new(), text };
        Ok(TextRows { lines: Lines::new(frames), rows_in_block: 0 })
    }

    /// Writes the header line. In compressed files, the header is a separate frame.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be written.
    pub fn header<T: AsRef<str>>(&mut self, names: impl IntoIterator<Item = T>) -> io::Result<()> {
        self.lines.texts(names)?;
        self.lines.flush()
    }

    /// Writes a row.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be written.
    pub fn row<T: AsRef<str>>(&mut self, cells: impl IntoIterator<Item = T>) -> io::Result<()> {
        self.lines.texts(cells)?;
        self.end_row()
    }

    /// Writes a row of typed cells, such as numbers, as text.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be written.
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

    /// Passes the buffered rows to the operating system. For compressed files, the function does nothing,
    /// because an additional frame would change the bytes of the file.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be written.
    pub fn flush(&mut self) -> io::Result<()> {
        if self.is_compressed() { Ok(()) } else { self.lines.flush() }
    }

    /// Writes the remaining rows. In compressed files, the last frame may have fewer rows than the other
    /// frames.
    ///
    /// # Errors
    /// Returns the error of the operating system if the file cannot be written.
    pub fn finish(&mut self) -> io::Result<()> {
        self.lines.flush()
    }

    /// Returns true if the file can be truncated after the last written row. If a run continues from the
    /// truncated file, the run writes the same bytes as an uninterrupted run.
    pub(crate) fn may_be_cut(&self) -> bool {
        !self.is_compressed() || self.rows_in_block == 0
    }

    /// Returns the number and the checksum of the written bytes. For a checkpoint, call [`TextRows::flush`]
    /// first, so that the written bytes contain all rows.
    pub(crate) fn extent(&self) -> FileSum {
        self.lines.target().file.sum()
    }

    /// Returns the checksums of all rows. Call [`TextRows::finish`] first.
    ///
    /// If the rows were converted into a different file, `file` is the checksum of that file. If `file` is
    /// `None`, the result contains the checksum of the file that this writer wrote.
    pub(crate) fn checksums(&self, file: Option<FileSum>) -> Checksums {
        let frames = self.lines.target();
        frames.text.checksums(file.or_else(|| Some(frames.file.sum())))
    }

    /// Returns the file.
    pub fn file(&self) -> &File {
        &self.lines.target().file.file
    }

    /// Returns true if the text is compressed in frames.
    pub(crate) fn is_compressed(&self) -> bool {
        self.lines.target().compressor.is_some()
    }
}

/// A plain or compressed file of text. In a compressed file, all text between two flushes is one frame.
struct Frames {
    file: Hashed,
    compressor: Option<zstd::bulk::Compressor<'static>>,
    frame: Vec<u8>,
    /// Checksums of the uncompressed text.
    text: TextDigest,
}

impl Write for Frames {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        if self.compressor.is_some() {
            self.frame.extend_from_slice(text);
        } else {
            self.file.write_all(text)?;
        }
        self.text.update(text);
        Ok(text.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if let Some(compressor) = &mut self.compressor
            && !self.frame.is_empty()
        {
            let frame = compressor.compress(&self.frame)?;
            self.frame.clear();
            self.file.write_all(&frame)?;
        }
        Ok(())
    }
}

/// Returns the checksums of the plain or compressed text in `source`. For [`Format::Parquet`], `source` is
/// the compressed text of the file `<results>.part`, not the Parquet file.
///
/// If the text cannot be decompressed to its end, the function also returns an error. After this error,
/// the checksums cover only the text that was decompressed.
pub(crate) fn text_sum(source: impl Read, format: Format) -> (TextDigest, io::Result<()>) {
    let mut digest = TextDigest::new();
    let summed = decoded(source, format).and_then(|mut text| io::copy(&mut text, &mut digest));
    (digest, summed.map(|_| ()))
}

/// Returns a reader of the decompressed text in `source`. For [`Format::Parquet`], `source` is the compressed
/// text of the file `<results>.part`, not the Parquet file.
pub(super) fn decoded<'a>(source: impl Read + 'a, format: Format) -> io::Result<Box<dyn Read + 'a>> {
    let mut source = BufReader::with_capacity(1 << 16, source);
    match format {
        Format::CsvZstd | Format::Parquet if !source.fill_buf()?.is_empty() => {
            let mut decoder = zstd::Decoder::with_buffer(source)?;
            decoder.window_log_max(WINDOW_LOG_MAX)?;
            Ok(Box::new(decoder))
        }
        // A file without frames contains no text.
        _ => Ok(Box::new(source)),
    }
}

/// A file that is open for writing, with the number and the hash of the bytes that it contains.
pub(super) struct Hashed {
    pub(super) file: File,
    hash: Xxh3Default,
    bytes: u64,
}

impl Hashed {
    /// Returns a [`Hashed`] for an empty file.
    pub(super) fn new(file: File) -> Hashed {
        Hashed { file, hash: Xxh3Default::new(), bytes: 0 }
    }

    /// Returns the number and the checksum of the bytes in the file.
    pub(super) fn sum(&self) -> FileSum {
        FileSum { bytes: self.bytes, xxh3: digits(self.hash.digest()) }
    }
}

impl Write for Hashed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.hash.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
