//! Text in aligned columns.

use std::fmt::Write as _;

use anstyle::Style;
use flap_core::parameter::Parameter;
use flap_sweep::notation::text;

/// The number with six digits, for people to read.
pub(crate) fn six_digits(number: f64) -> String {
    format!("{number:.5e}").parse().map_or_else(|_| String::new(), text::float)
}

/// A parameter with its value and unit, such as `drive_frequency = 120.0 Hz`.
pub(crate) fn assignment(parameter: &Parameter, value: f64) -> String {
    format!("{} = {} {}", parameter.name, text::value(parameter, value), parameter.unit).trim_end().to_owned()
}

/// Rows of cells, aligned on the left. A row may have fewer cells than others.
#[derive(Default)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
    /// Titles of groups, each with the number of rows above it.
    titles: Vec<(usize, String)>,
}

/// The least width of a column whose cells are wrapped.
const LEAST: usize = 20;

impl Table {
    /// A table with a first row of headings.
    pub(crate) fn with_headings(headings: &[&str]) -> Table {
        Table::with_names(headings.iter().map(|heading| heading.to_uppercase()).collect())
    }

    /// A table with a first row of names of columns, as they are written.
    pub(crate) fn with_names(names: Vec<String>) -> Table {
        Table { rows: vec![names], titles: Vec::new() }
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: impl Into<Vec<String>>) {
        self.rows.push(cells.into());
    }

    /// Adds a title above the rows that follow.
    pub(crate) fn title(&mut self, title: &str) {
        self.titles.push((self.rows.len(), title.to_owned()));
    }

    /// The text: one line per row, two blanks between columns.
    pub(crate) fn text(&self) -> String {
        self.text_within(None)
    }

    /// The text in lines of `width` characters: the cells of the last column are wrapped.
    pub(crate) fn text_within(&self, width: Option<usize>) -> String {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width_of =
            |row: &Vec<String>, column: usize| row.get(column).map_or(0, |cell| cell.chars().count());
        let widths: Vec<usize> = (0..columns)
            .map(|column| self.rows.iter().map(|row| width_of(row, column)).max().unwrap_or(0))
            .collect();
        let indent: usize = widths.iter().take(columns.saturating_sub(1)).map(|width| width + 2).sum();
        let room = width.map_or(usize::MAX, |width| width.saturating_sub(indent).max(LEAST));
        let mut text = String::new();
        for (place, row) in self.rows.iter().enumerate() {
            for (_, title) in self.titles.iter().filter(|(above, _)| *above == place) {
                let bold = Style::new().bold();
                let _ = writeln!(text, "\n{bold}{title}{bold:#}");
            }
            let padded = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}"));
            let line = padded.collect::<Vec<_>>().join("  ");
            let line = line.trim_end();
            let (begin, last) =
                line.split_at(line.char_indices().nth(indent).map_or(line.len(), |(at, _)| at));
            let wrapped = textwrap::wrap(last, room).join(&format!("\n{:indent$}", ""));
            let _ = writeln!(text, "{begin}{wrapped}");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned_by_characters() {
        let mut table = Table::with_headings(&["name", "unit", "meaning"]);
        table.row(["capacitance".into(), "µF".into(), "of a plate".into()]);
        table.row(["span".into(), String::new(), String::new()]);
        assert_eq!(table.text(), "NAME         UNIT  MEANING\ncapacitance  µF    of a plate\nspan\n");
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
        assert_eq!(table.text().lines().count(), 4, "without a width, lines have any length");
    }
}
