//! Files of lines, each of limited length.

use std::io::{self, Read};

/// Longest line, or lines without a row in them: 16 MiB. A line of results has some hundred bytes, and one of ten thousand
/// columns has less than 1 MiB.
const LONGEST_LINE: usize = 16 << 20;

/// A reader that fails within a line that is too long: a few bytes of a compressed file can stand for a line of any length.
pub struct Bounded<R> {
    source: R,
    since_line: usize,
}

impl<R: Read> Bounded<R> {
    /// Reads from `source`.
    pub fn new(source: R) -> Bounded<R> {
        Bounded { source, since_line: 0 }
    }

    /// Begins a new line: the one before was read to its end.
    pub fn begin_line(&mut self) {
        self.since_line = 0;
    }
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.since_line > LONGEST_LINE {
            let message =
                format!("a line is longer than {} MiB: this is not a table of numbers", LONGEST_LINE >> 20);
            // The kind of this error is one that readers of damaged lines do not skip: nothing behind it can be read.
            return Err(io::Error::other(message));
        }
        let count = self.source.read(buffer)?;
        self.since_line += count;
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_endless_line_is_refused_and_many_lines_are_not() {
        let mut endless = csv::Reader::from_reader(Bounded::new(io::repeat(b'1')));
        let error = endless.headers().unwrap_err().to_string();
        assert!(error.contains("a line is longer than 16 MiB"), "{error}");

        let lines = "1,2\n".repeat(100_000);
        let parts = (0..100)
            .fold(Box::new(io::empty()) as Box<dyn Read>, |all, _| Box::new(all.chain(lines.as_bytes())));
        let mut reader = csv::Reader::from_reader(Bounded::new(parts));
        let mut row = csv::StringRecord::new();
        let mut rows = 0;
        while reader.read_record(&mut row).unwrap() {
            reader.get_mut().begin_line();
            rows += 1;
        }
        assert_eq!(rows, 100 * 100_000 - 1);
    }
}
