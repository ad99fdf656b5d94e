//! Text in aligned columns.

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
}

impl Table {
    /// A table with a first row of headings.
    pub(crate) fn with_headings(headings: &[&str]) -> Table {
        Table { rows: vec![headings.iter().map(|heading| heading.to_uppercase()).collect()] }
    }

    /// A table with a first row of names of columns, as they are written.
    pub(crate) fn with_names(names: Vec<String>) -> Table {
        Table { rows: vec![names] }
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: impl Into<Vec<String>>) {
        self.rows.push(cells.into());
    }

    /// The text: one line per row, two blanks between columns.
    pub(crate) fn text(&self) -> String {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width_of =
            |row: &Vec<String>, column: usize| row.get(column).map_or(0, |cell| cell.chars().count());
        let widths: Vec<usize> = (0..columns)
            .map(|column| self.rows.iter().map(|row| width_of(row, column)).max().unwrap_or(0))
            .collect();
        let mut text = String::new();
        for row in &self.rows {
            let padded = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}"));
            let line = padded.collect::<Vec<_>>().join("  ");
            text.push_str(line.trim_end());
            text.push('\n');
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
}
