//! Checksums of rows. With checksums of the rows, flap detects damage in result files and finds the damaged
//! rows.
//!
//! flap computes the checksums from the rows as CSV text. The CSV text is the same for every file format, so
//! the checksums stay the same when a file is converted to a different format. Each block of rows begins at a
//! fixed line of the file. The checksums therefore do not depend on the number of threads or on interruptions
//! of the run.

use std::fmt::Write as _;
use std::io::{self, Read, Write};

use memchr::memchr;
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::Xxh3Default;

use crate::notation::text::digits;

/// Number of rows in a block. Each block of rows has a checksum. In compressed files, each block of rows is
/// one compressed frame.
///
/// Blocks begin at the same rows for any number of threads and in resumed runs. The bytes of files therefore
/// do not depend on the number of threads or on interruptions of the run. Rows in an incomplete frame are
/// lost if the process is killed. Larger blocks of rows would hardly make compressed files smaller.
pub const BLOCK_ROWS: u32 = 256;

/// Number of checksums in one line of a sidecar. The checksums of ten million rows take 3,300 lines. The
/// checksums of rows are about ten thousand times smaller than the rows.
const PER_LINE: usize = 12;

/// Checksums of a result file. Some checksums are for the rows as CSV text, and one checksum is for the bytes
/// of the file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Checksums {
    /// XXH3 hash of the header and all rows as lines of CSV, in hexadecimal digits.
    pub text: String,
    /// Lower 32 bits of the XXH3 hash of the header line, in hexadecimal digits.
    pub header: String,
    /// Number of rows in each block except the last block.
    pub block_rows: u32,
    /// Lower 32 bits of the XXH3 hash of every block of rows. For a block, 32 bits are sufficient, because
    /// the checksum `text` detects any damage, and the checksums of blocks only locate the damage.
    pub blocks: String,
    /// Checksum of the bytes of the file; `None` if the file is a converted copy of a damaged file.
    pub file: Option<FileSum>,
}

/// Checksum of a file's bytes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileSum {
    /// Number of bytes.
    pub bytes: u64,
    /// XXH3 hash of the bytes, in hexadecimal digits.
    pub xxh3: String,
}

impl FileSum {
    /// Returns the checksum of all bytes of `source`.
    ///
    /// # Errors
    /// Returns the error of the operating system if `source` cannot be read.
    pub(crate) fn of(mut source: impl Read) -> io::Result<FileSum> {
        let mut hash = Xxh3Default::new();
        let bytes = io::copy(&mut source, &mut hash)?;
        Ok(FileSum { bytes, xxh3: digits(hash.digest()) })
    }
}

impl Checksums {
    /// Returns the checksum of the header, then the checksums of the blocks of rows. Returns `None` if a
    /// checksum is not a hexadecimal number.
    pub(crate) fn parts(&self) -> Option<Vec<u32>> {
        let words = std::iter::once(self.header.as_str()).chain(self.blocks.split_whitespace());
        words.map(|word| u32::from_str_radix(word, 16).ok()).collect()
    }
}

/// Computes the checksums of a text. The text can arrive in pieces of any size.
#[derive(Clone)]
pub(crate) struct TextDigest {
    whole: Xxh3Default,
    block: Xxh3Default,
    /// True if the hash `block` was computed from at least one byte of the current block.
    is_begun: bool,
    lines: u64,
    /// Checksum of the header, then the checksums of the complete blocks of rows.
    parts: Vec<u32>,
}

impl TextDigest {
    pub(crate) fn new() -> TextDigest {
        TextDigest {
            whole: Xxh3Default::new(),
            block: Xxh3Default::new(),
            is_begun: false,
            lines: 0,
            parts: Vec::new(),
        }
    }

    pub(crate) fn update(&mut self, text: &[u8]) {
        self.whole.update(text);
        let mut rest = text;
        while let Some(end) = memchr(b'\n', rest) {
            let (line, after) = rest.split_at(end + 1);
            self.block.update(line);
            self.is_begun = true;
            self.lines += 1;
            // Line 1 ends the header, and line 257 ends the first block.
            if self.lines % u64::from(BLOCK_ROWS) == 1 {
                self.parts.push(lower_half(self.block.digest()));
                self.block.reset();
                self.is_begun = false;
            }
            rest = after;
        }
        if !rest.is_empty() {
            self.block.update(rest);
            self.is_begun = true;
        }
    }

    /// Returns the number of complete lines after the header.
    pub(crate) fn rows(&self) -> u64 {
        self.lines.saturating_sub(1)
    }

    /// Returns the checksum of the whole text.
    pub(crate) fn text(&self) -> String {
        digits(self.whole.digest())
    }

    /// Returns the checksum of the header, then the checksums of the blocks of rows. The last block may have
    /// fewer rows than the other blocks.
    pub(crate) fn parts(&self) -> Vec<u32> {
        let mut parts = self.parts.clone();
        if self.is_begun {
            parts.push(lower_half(self.block.digest()));
        }
        parts
    }

    /// Returns the checksums in the form in which a sidecar contains them. `file` is the checksum of the file
    /// that contains the text.
    pub(crate) fn checksums(&self, file: Option<FileSum>) -> Checksums {
        let parts = self.parts();
        let header = parts.first().map_or_else(String::new, |part| format!("{part:08x}"));
        let mut blocks = String::new();
        for (number, part) in parts.iter().skip(1).enumerate() {
            let between = match number {
                0 => "",
                _ if number % PER_LINE == 0 => "\n",
                _ => " ",
            };
            let _ = write!(blocks, "{between}{part:08x}");
        }
        Checksums { text: self.text(), header, block_rows: BLOCK_ROWS, blocks, file }
    }
}

impl Write for TextDigest {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        self.update(text);
        Ok(text.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn lower_half(hash: u64) -> u32 {
    let [a, b, c, d, ..] = hash.to_le_bytes();
    u32::from_le_bytes([a, b, c, d])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn digest(text: &str, piece: usize) -> TextDigest {
        let mut digest = TextDigest::new();
        text.as_bytes().chunks(piece).for_each(|piece| digest.update(piece));
        digest
    }

    #[test]
    fn pieces_do_not_matter() {
        let rows: Vec<String> = (0..1000).map(|row| format!("{row},periodic\n")).collect();
        let text = format!("point,status\n{}", rows.concat());
        let whole = digest(&text, text.len()).checksums(None);
        for piece in [1, 7, 4096] {
            assert_eq!(digest(&text, piece).checksums(None), whole);
        }
        assert_eq!(whole.parts().map(|parts| parts.len()), Some(1 + 4));
        assert_eq!(digest(&text, 99).rows(), 1000);
    }

    #[test]
    fn a_change_is_in_its_block_alone() {
        let text = |changed: usize| -> String {
            (0..1025)
                .map(|line| if line == changed { "x\n".to_owned() } else { format!("{line}\n") })
                .collect()
        };
        let sound = digest(&text(9999), 100).parts();
        for (line, part) in [(0, 0), (1, 1), (256, 1), (257, 2), (512, 2), (513, 3), (1024, 4)] {
            let parts = digest(&text(line), 100).parts();
            let changed: Vec<usize> = (0..5).filter(|&part| parts[part] != sound[part]).collect();
            assert_eq!(changed, [part], "line {line}");
        }
        assert_eq!(sound.len(), 5);
    }

    #[test]
    fn a_last_line_that_does_not_end_counts() {
        assert_ne!(digest("a\n1\n2", 10).text(), digest("a\n1\n", 10).text());
        assert_ne!(digest("a\n1\n2", 10).parts(), digest("a\n1\n2\n", 10).parts());
        assert!(digest("", 1).parts().is_empty());
    }
}
