//! Writes rows as lines of comma-separated values.
//!
//! Nearly all cells are numbers, which need no quotes. The csv crate checks every byte of a cell, so it takes
//! twice as many instructions as this module. The csv crate is used only for reading.

use std::io::{self, BufWriter, Write};

use crate::notation::text;
use crate::table::layout::Cell;

/// Writer of lines to a target of the type `W`.
pub(crate) struct Lines<W: Write> {
    target: BufWriter<W>,
    /// Current line. The string is kept between lines, so that flap does not allocate memory for every
    /// line.
    line: String,
}

impl<W: Write> Lines<W> {
    pub(crate) fn new(target: W) -> Lines<W> {
        // One system call writes some hundred rows.
        Lines { target: BufWriter::with_capacity(1 << 16, target), line: String::new() }
    }

    /// Writes a line of text cells.
    pub(crate) fn texts<T: AsRef<str>>(&mut self, cells: impl IntoIterator<Item = T>) -> io::Result<()> {
        for cell in cells {
            push_word(&mut self.line, cell.as_ref());
            self.line.push(',');
        }
        self.end()
    }

    /// Writes a line of typed cells. Numbers have the form of [`text::float`], and the cells of unknown
    /// values are empty.
    pub(crate) fn cells(&mut self, cells: &[Cell]) -> io::Result<()> {
        for cell in cells {
            match *cell {
                Cell::Whole(number) => self.line.push_str(itoa::Buffer::new().format(number)),
                Cell::Number(number) => text::push_float(&mut self.line, number),
                Cell::Flag(None) => {}
                Cell::Flag(Some(flag)) => self.line.push_str(if flag { "true" } else { "false" }),
                Cell::Text(word) => push_word(&mut self.line, word),
            }
            self.line.push(',');
        }
        self.end()
    }

    /// Writes the line. The line break replaces the last comma of the line.
    fn end(&mut self) -> io::Result<()> {
        self.line.pop();
        self.line.push('\n');
        let written = self.target.write_all(self.line.as_bytes());
        self.line.clear();
        written
    }

    /// Passes the written lines to the target, and flushes the target.
    pub(crate) fn flush(&mut self) -> io::Result<()> {
        self.target.flush()
    }

    /// Returns the target. After [`Lines::flush`], the target contains all lines.
    pub(crate) fn target(&self) -> &W {
        self.target.get_ref()
    }
}

/// Appends a cell to the line, in quotes if the cell contains a comma, a quote or a line break.
fn push_word(line: &mut String, word: &str) {
    if word.contains([',', '"', '\r', '\n']) {
        line.push('"');
        line.push_str(&word.replace('"', "\"\""));
        line.push('"');
    } else {
        line.push_str(word);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn written(write: impl FnOnce(&mut Lines<Vec<u8>>) -> io::Result<()>) -> String {
        let mut lines = Lines::new(Vec::new());
        write(&mut lines).and_then(|()| lines.flush()).unwrap();
        String::from_utf8(lines.target().clone()).unwrap()
    }

    #[test]
    fn what_is_not_known_is_empty() {
        let cells = [
            Cell::Whole(u64::MAX),
            Cell::Number(-0.5),
            Cell::Number(f64::NAN),
            Cell::Flag(Some(true)),
            Cell::Flag(Some(false)),
            Cell::Flag(None),
            Cell::Text("periodic"),
        ];
        assert_eq!(written(|lines| lines.cells(&cells)), "18446744073709551615,-0.5,,true,false,,periodic\n");
        assert_eq!(
            written(|lines| lines.cells(&[Cell::Text("no, never"), Cell::Whole(0)])),
            "\"no, never\",0\n"
        );
    }

    proptest! {
        #[test]
        fn any_text_is_written_as_the_csv_crate_does(cells in prop::collection::vec("[a-z,\"\r\n µ]{0,5}", 2..6)) {
            let mut writer = csv::Writer::from_writer(Vec::new());
            writer.write_record(&cells).unwrap();
            let expected = String::from_utf8(writer.into_inner().unwrap()).unwrap();
            prop_assert_eq!(written(|lines| lines.texts(&cells)), expected);
        }
    }
}
