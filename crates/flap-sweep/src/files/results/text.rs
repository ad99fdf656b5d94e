//! Rows as lines of comma-separated values, plain or compressed, into a file.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};

use xxhash_rust::xxh3::Xxh3Default;

use super::checksum::TextDigest;
use super::hashed::Hashed;
use super::{Checksums, FileSum, Format};
use crate::table::layout::Cell;
use crate::table::lines::Lines;

/// Rows in one compressed frame. Frames begin at these rows whatever the threads do and wherever a run was resumed, so
/// that the bytes do not depend on it.
///
/// Rows in a frame that is not complete are lost if the process is killed. More of them would hardly make files smaller.
pub const BLOCK_ROWS: u32 = 256;

/// Zstandard's default: higher levels take longer and save little on digits.
const LEVEL: i32 = 3;

/// The most memory that a compressed file may ask for to be read: 2^27 bytes, which is what the command `zstd` allows.
const WINDOW_LOG_MAX: u32 = 27;

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
        TextRows::on(Hashed::new(file), format, TextDigest::new())
    }

    /// Goes on after the `bytes` in `file` whose hash is `hash`, and whose rows are `text`. They end where a row ends, and a
    /// frame.
    pub(crate) fn after(
        file: File,
        format: Format,
        (hash, bytes): (Xxh3Default, u64),
        text: TextDigest,
    ) -> io::Result<TextRows> {
        TextRows::on(Hashed::after(file, hash, bytes), format, text)
    }

    fn on(file: Hashed, format: Format, text: TextDigest) -> io::Result<TextRows> {
        let compressor = match format {
            Format::Csv => None,
            Format::CsvZstd | Format::Parquet => Some(compressor()?),
        };
        let frames = Frames { file, compressor, frame: Vec::new(), text };
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
        Extent { bytes: frames.file.bytes(), digest: frames.file.digest() }
    }

    /// The checksums of what has been written; complete after [`TextRows::finish`]. They are of the rows and of the file they
    /// were written to, or of `file`, which they have been turned into.
    pub(crate) fn checksums(&self, file: Option<FileSum>) -> Checksums {
        let frames = self.lines.target();
        frames.text.checksums(file.or_else(|| Some(frames.file.sum())))
    }

    /// The file.
    pub fn file(&self) -> &File {
        &self.lines.target().file.file
    }

    fn is_compressed(&self) -> bool {
        self.lines.target().compressor.is_some()
    }
}

/// A file that text goes into, as it is or as one compressed frame from each flush to the next.
struct Frames {
    file: Hashed,
    compressor: Option<zstd::bulk::Compressor<'static>>,
    frame: Vec<u8>,
    /// Of what has been written, before it is compressed.
    text: TextDigest,
}

/// Makes frames that end in a checksum, so that any reader notices damage.
fn compressor() -> io::Result<zstd::bulk::Compressor<'static>> {
    let mut compressor = zstd::bulk::Compressor::new(LEVEL)?;
    compressor.include_checksum(true)?;
    Ok(compressor)
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

/// Sums up the text of rows in `source`, which is not Parquet. What cannot be decompressed ends it: then with an error too.
pub(crate) fn sum_up(source: impl Read, format: Format) -> (TextDigest, io::Result<()>) {
    let mut digest = TextDigest::new();
    let summed = decoded(source, format).and_then(|text| feed(text, &mut digest));
    (digest, summed)
}

/// The text of rows in `source`, which is not Parquet.
pub(super) fn decoded<'a>(source: impl Read + 'a, format: Format) -> io::Result<Box<dyn Read + 'a>> {
    let mut source = BufReader::with_capacity(1 << 16, source);
    match format {
        Format::CsvZstd | Format::Parquet if !source.fill_buf()?.is_empty() => {
            let mut decoder = zstd::Decoder::with_buffer(source)?;
            decoder.window_log_max(WINDOW_LOG_MAX)?;
            Ok(Box::new(decoder))
        }
        // No frame at all is no text at all.
        _ => Ok(Box::new(source)),
    }
}

fn feed(mut source: impl Read, digest: &mut TextDigest) -> io::Result<()> {
    let mut buffer = vec![0; 1 << 16];
    loop {
        match source.read(&mut buffer) {
            Ok(0) => return Ok(()),
            Ok(count) => digest.update(&buffer[..count]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}
