//! Checksums of rows, by which damage is noticed and found.
//!
//! They are computed from the rows as text, which is the same in every format: a converted file keeps them. Lines are
//! counted from the first one of the file, so neither threads nor interruptions change a checksum.

use std::fmt::Write as _;
use std::io::{self, Read, Write};

use memchr::memchr;
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::Xxh3Default;

use crate::notation::text::digits;

/// Rows in one block, which has a checksum, and is a frame in compressed files. Blocks begin at the same rows for any number
/// of threads, and in a resumed run, so that the bytes do not depend on them.
///
/// Rows in a frame that is not complete are lost if the process is killed. More of them would hardly make files smaller.
pub const BLOCK_ROWS: u32 = 256;

/// Number of checksums in one line of text: a sidecar of ten million rows has 3,300 such lines, a ten-thousandth of the rows.
const PER_LINE: usize = 12;

/// Checksums of a result file: of its rows as text, and of its bytes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Checksums {
    /// XXH3 of the header and all rows as lines of CSV, in hexadecimal digits.
    pub text: String,
    /// The lower half of the XXH3 of the header.
    pub header: String,
    /// Number of rows in each block but the last.
    pub block_rows: u32,
    /// The lower half of the XXH3 of every block of rows: enough to find damage that `text` reveals.
    pub blocks: String,
    /// Checksum of the file's own bytes; `None` if the file was not made by writing sound rows.
    pub file: Option<FileSum>,
}

/// A checksum of a file's bytes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileSum {
    /// Number of bytes.
    pub bytes: u64,
    /// Their XXH3, in hexadecimal digits.
    pub xxh3: String,
}

impl FileSum {
    /// The checksum of all that can be read from `source`.
    ///
    /// # Errors
    /// The error of `source`.
    pub(crate) fn of(mut source: impl Read) -> io::Result<FileSum> {
        let mut hash = Xxh3Default::new();
        let bytes = io::copy(&mut source, &mut hash)?;
        Ok(FileSum { bytes, xxh3: digits(hash.digest()) })
    }
}

impl Checksums {
    /// The checksums of the blocks, the first one that of the header; `None` if they are not as flap writes them.
    pub(crate) fn parts(&self) -> Option<Vec<u32>> {
        let words = std::iter::once(self.header.as_str()).chain(self.blocks.split_whitespace());
        words.map(|word| u32::from_str_radix(word, 16).ok()).collect()
    }
}

/// Takes the text of a file in pieces of any size, and computes its checksums.
#[derive(Clone)]
pub(crate) struct TextDigest {
    whole: Xxh3Default,
    block: Xxh3Default,
    /// True if `block` has taken bytes.
    is_begun: bool,
    lines: u64,
    /// The checksum of the header, then those of blocks.
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
            // The header ends with line 1, the first block with line 257.
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

    /// Number of lines after the header that end.
    pub(crate) fn rows(&self) -> u64 {
        self.lines.saturating_sub(1)
    }

    /// The checksum of all the text.
    pub(crate) fn text(&self) -> String {
        digits(self.whole.digest())
    }

    /// The checksums of the header and of blocks. The last block may have fewer rows than others.
    pub(crate) fn parts(&self) -> Vec<u32> {
        let mut parts = self.parts.clone();
        if self.is_begun {
            parts.push(lower_half(self.block.digest()));
        }
        parts
    }

    /// The checksums that a sidecar records, with that of the `file` which holds the text.
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
