//! Tables of text in aligned columns.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::ops::Range;

use anstyle::Style;
use flap_core::parameter::Parameter;
use flap_sweep::notation::text::{self, shortened};

use crate::console;

/// Returns the number with six digits.
pub(crate) fn six_digits(number: f64) -> String {
    format!("{number:.5e}").parse().map_or_else(|_| String::new(), text::float)
}

/// Returns the number with four digits.
pub(crate) fn four_digits(number: f64) -> String {
    format!("{number:.3e}").parse().map_or_else(|_| String::new(), text::float)
}

/// Returns a parameter with its value and unit to six digits, such as `hinge_stiffness = 1.52 uN*m/rad`.
pub(crate) fn assignment(parameter: &Parameter, value: f64) -> String {
    format!("{} = {}", parameter.name, text::shown(parameter, value))
}

/// A table of text whose columns are aligned on the left. Rows may have different numbers of cells.
///
/// Words of more than 300 characters are shortened, because names in files may have any length.
#[derive(Default)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
    /// Titles of groups of rows, each with the number of rows above the title.
    titles: Vec<(usize, String)>,
    /// If the table is too wide, flap splits the table into parts, and each part repeats this number of
    /// columns at the left. The number 0 has the same effect as 1.
    keys: usize,
}

/// Smallest width, in characters, to which the cells of a column are wrapped.
const LEAST: usize = 20;

impl Table {
    /// Returns a table whose first row contains the headings in capital letters.
    pub(crate) fn with_headings(headings: &[&str]) -> Table {
        Table::with_names(headings.iter().map(|heading| heading.to_uppercase()).collect())
    }

    /// Returns a table with the given headings and rows.
    pub(crate) fn of(headings: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> Table {
        let mut table = Table::with_headings(headings);
        for row in rows {
            table.row(row);
        }
        table
    }

    /// Returns a table whose first row contains the given column names, unchanged.
    pub(crate) fn with_names(names: Vec<String>) -> Table {
        let mut table = Table::default();
        table.row(names);
        table
    }

    /// Sets the number of columns at the left that each part of a split table repeats. flap splits a table
    /// that is too wide.
    pub(crate) fn with_keys(self, keys: usize) -> Table {
        Table { keys, ..self }
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: impl Into<Vec<String>>) {
        let shorten = |cell: String| match shortened(&cell) {
            Cow::Borrowed(_) => cell,
            Cow::Owned(short) => short,
        };
        self.rows.push(cells.into().into_iter().map(shorten).collect());
    }

    /// Adds a title above the rows that are added later.
    pub(crate) fn title(&mut self, title: &str) {
        self.titles.push((self.rows.len(), title.to_owned()));
    }

    /// Returns the table as text, with two blanks between columns. Without a `width`, each row is one line.
    /// With a `width`, lines have at most `width` characters.
    ///
    /// With a `width`, the cells of the last column are wrapped. If the columns still do not fit, flap
    /// splits the table into several tables, one below the other. Each part of a split table begins with the
    /// first column, or with the number of columns that [`Table::with_keys`] sets.
    pub(crate) fn text_within(&self, width: Option<usize>) -> String {
        let widths = self.widths();
        let parts = width.map_or_else(Vec::new, |width| parts(&widths, self.keys.max(1), width));
        match parts.as_slice() {
            [] | [_] => self.whole_within(&widths, width),
            parts => {
                let texts: Vec<String> = (parts.iter().cloned())
                    .map(|columns| {
                        let part = self.part(columns);
                        part.whole_within(&part.widths(), width)
                    })
                    .collect();
                texts.join("\n")
            }
        }
    }

    /// Returns the widths of the columns.
    fn widths(&self) -> Vec<usize> {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width_of =
            |row: &Vec<String>, column: usize| row.get(column).map_or(0, |cell| cell.chars().count());
        (0..columns)
            .map(|column| self.rows.iter().map(|row| width_of(row, column)).max().unwrap_or(0))
            .collect()
    }

    /// Returns a part of a split table: the columns at the left that all parts repeat, and the given columns.
    fn part(&self, columns: Range<usize>) -> Table {
        let cells = |row: &Vec<String>| {
            let rest = row.iter().skip(columns.start).take(columns.len());
            row.iter().take(self.keys.max(1)).chain(rest).cloned().collect()
        };
        Table { rows: self.rows.iter().map(cells).collect(), titles: self.titles.clone(), keys: self.keys }
    }

    /// Returns the table as text without splitting the table. The cells of the last column are wrapped.
    fn whole_within(&self, widths: &[usize], width: Option<usize>) -> String {
        let columns = widths.len();
        let indent: usize = widths.iter().take(columns.saturating_sub(1)).map(|width| width + 2).sum();
        let room = width.map_or(usize::MAX, |width| width.saturating_sub(indent).max(LEAST));
        let mut text = String::new();
        for (place, row) in self.rows.iter().enumerate() {
            for (_, title) in self.titles.iter().filter(|(above, _)| *above == place) {
                let bold = Style::new().bold();
                let _ = writeln!(text, "\n{bold}{title}{bold:#}");
            }
            // Widths in format strings have only 16 bits, so the padding is added here.
            let padded = row.iter().zip(widths).map(|(cell, &width)| {
                cell.to_owned() + &" ".repeat(width.saturating_sub(cell.chars().count()))
            });
            let line = padded.collect::<Vec<_>>().join("  ");
            let line = line.trim_end();
            let (begin, last) =
                line.split_at(line.char_indices().nth(indent).map_or(line.len(), |(at, _)| at));
            let wrapped = textwrap::wrap(last, room).join(&format!("\n{}", " ".repeat(indent)));
            let _ = writeln!(text, "{begin}{wrapped}");
        }
        text
    }
}

/// Divides the columns after the first `keys` columns into groups, so that the first columns and a group fit
/// into `width`. The last column may be wrapped to [`LEAST`] characters.
fn parts(widths: &[usize], keys: usize, width: usize) -> Vec<Range<usize>> {
    let mut parts: Vec<Range<usize>> = Vec::new();
    let first: usize = widths.iter().take(keys).map(|width| width + 2).sum();
    let (mut begin, mut used) = (keys, first);
    for (column, &own) in widths.iter().enumerate().skip(keys) {
        let is_last = column + 1 == widths.len();
        let least = if is_last { own.min(LEAST) } else { own };
        if column > begin && used + least > width {
            parts.push(begin..column);
            (begin, used) = (column, first);
        }
        used += own + 2;
    }
    parts.push(begin..widths.len());
    parts
}

/// Returns the text in lines that fit the terminal. All lines after the first line are indented by `indent`
/// blanks.
pub(crate) fn wrapped(text: &str, indent: usize) -> String {
    let blanks = " ".repeat(indent);
    console::width().map_or_else(
        || text.to_owned(),
        |width| {
            textwrap::fill(text, textwrap::Options::new(width.max(indent + 20)).subsequent_indent(&blanks))
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_with_four_digits() {
        assert_eq!([12.345_678, -0.001_234_56].map(four_digits), ["12.35", "-0.001235"]);
    }

    #[test]
    fn wide_tables_are_folded() {
        let mut table = Table::with_headings(&["axis", "from", "to", "meaning"]);
        table.row(["frequency", "a long beginning", "a long end", "of the drive"].map(str::to_owned));
        let wanted = "AXIS       FROM              TO\nfrequency  a long beginning  a long end\n\n\
                      AXIS       MEANING\nfrequency  of the drive\n";
        assert_eq!(table.text_within(Some(40)), wanted);
        assert!(table.text_within(Some(40)).lines().all(|line| line.len() <= 40));
        assert_eq!(
            table.text_within(None).lines().count(),
            2,
            "without a width, tables are as wide as they are"
        );
    }

    #[test]
    fn cells_of_any_length_are_printed() {
        let mut table = Table::with_names(vec!["n".repeat(70_000), "x".to_owned()]);
        table.row(["a b ".repeat(20_000), "1.0".to_owned()]);
        let text = table.text_within(None);
        assert!(text.starts_with(&format!("{}…(70000 characters)…", "n".repeat(60))), "{}", &text[..200]);
        assert!(text.ends_with("a b   1.0\n"));
    }

    #[test]
    fn columns_are_aligned_by_characters() {
        let mut table = Table::with_headings(&["name", "unit", "meaning"]);
        table.row(["capacitance".into(), "µF".into(), "of a plate".into()]);
        table.row(["span".into(), String::new(), String::new()]);
        assert_eq!(
            table.text_within(None),
            "NAME         UNIT  MEANING\ncapacitance  µF    of a plate\nspan\n"
        );
    }

    #[test]
    fn the_last_column_is_wrapped_and_groups_have_titles() {
        let mut table = Table::with_headings(&["name", "meaning"]);
        table.title("plates");
        table.row(["capacitance".into(), "capacitance of a plate in µF, both plates".into()]);
        let text = table.text_within(Some(33));
        assert_eq!(
            anstream::adapter::strip_str(&text).to_string(),
            "NAME         MEANING\n\nplates\n\
             capacitance  capacitance of a\n             plate in µF, both\n             plates\n"
        );
        assert_eq!(table.text_within(None).lines().count(), 4, "without a width, lines have any length");
    }
}
