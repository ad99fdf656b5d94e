//! The columns of a results file, as numbers and words.

use flap_sweep::notation::text;

use crate::console;
use crate::failure::Failure;

/// Columns of a results file. Only the columns that the command needs have cells.
pub(crate) struct Table {
    pub(crate) columns: Vec<Column>,
    /// Number of rows in this table. The number of rows is smaller than `of` if flap keeps only some rows of
    /// a large file.
    pub(crate) rows: usize,
    /// Number of rows in the file that satisfy the conditions.
    pub(crate) of: usize,
    /// Names of the sampled parameters, which the sidecar lists. `None` means that flap does not know whether
    /// the points are a sample.
    pub(crate) sample: Option<Vec<String>>,
    /// Names of the derived parameters that the sidecar lists. Empty without a sidecar.
    pub(crate) derived: Vec<String>,
    /// Axes along which the sweep added points between the values of the grid file. Empty without a sidecar.
    pub(crate) refined: Vec<RefinedAxis>,
}

/// An axis along which the sweep added points between the values of the grid file.
#[derive(Clone)]
pub(crate) struct RefinedAxis {
    pub(crate) name: String,
    /// True if the ratio of neighbouring values of the axis is constant.
    pub(crate) log: bool,
    /// Number of intervals between the values of the axis in the grid file.
    pub(crate) cells: u64,
}

/// A column of a file.
pub(crate) struct Column {
    pub(crate) name: String,
    /// The unit as text; empty for a column without a unit.
    pub(crate) unit: String,
    pub(crate) cells: Cells,
}

/// The cells of a column.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cells {
    /// One number per row; NaN for an empty cell.
    Numbers(Vec<f64>),
    /// `codes` contains one number per row: the index of the row's word in `words`, or [`NO_WORD`] for an
    /// empty cell.
    Words { codes: Vec<u32>, words: Vec<String> },
    /// The cells of the column were not read.
    Unread,
}

/// The code of an empty cell in a column of words.
pub(crate) const NO_WORD: u32 = u32::MAX;

impl Table {
    /// Returns the position of the column `name`, or an error that suggests a similar name or lists all
    /// names.
    pub(crate) fn find(&self, name: &str) -> Result<usize, Failure> {
        find(self.columns.iter().map(|column| column.name.as_str()), name)
    }

    /// Returns the numbers of a column.
    pub(crate) fn numbers(&self, index: usize) -> Result<&[f64], Failure> {
        let column = &self.columns[index];
        match &column.cells {
            Cells::Numbers(values) => Ok(values),
            Cells::Words { .. } => Err(no_numbers(&column.name)),
            Cells::Unread => Err(Failure::Bug(format!("column `{}` was not read", column.name))),
        }
    }
}

/// Returns the failure for a column of text where flap requires numbers.
pub(crate) fn no_numbers(name: &str) -> Failure {
    let failure = Failure::usage(format!("column `{name}` contains text, not numbers"));
    failure.help("choose a column of numbers; only --where, and --by and --color of `flap plot`, accept text")
}

/// Returns the position of the column `name`, or an error that suggests a similar name or lists all names.
pub(crate) fn find<'n>(names: impl Iterator<Item = &'n str> + Clone, name: &str) -> Result<usize, Failure> {
    names.clone().position(|known| known == name).ok_or_else(|| {
        let failure = Failure::usage(format!("there is no column `{name}`"));
        failure.nearest(name, names.clone(), &listed(names))
    })
}

/// Returns a help text that lists the names of the columns.
pub(crate) fn listed<'n>(names: impl Iterator<Item = &'n str>) -> String {
    console::help_lines(&format!("the columns are {}", text::listed(names, "column")))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Returns a table with a first column that counts the rows, followed by the columns `columns`.
    pub(crate) fn table(columns: &[(&str, &[f64])]) -> Table {
        let rows = columns[0].1.len();
        let column = |name: &str, values: Vec<f64>| Column {
            name: name.to_owned(),
            unit: if name == "f" { "Hz".to_owned() } else { String::new() },
            cells: Cells::Numbers(values),
        };
        let first = column("point", (0..rows).map(|row| row as f64).collect());
        let rest = columns.iter().map(|(name, values)| column(name, values.to_vec()));
        Table {
            columns: std::iter::once(first).chain(rest).collect(),
            rows,
            of: rows,
            sample: None,
            derived: Vec::new(),
            refined: Vec::new(),
        }
    }

    /// Returns a table with the axes `v` and `f`, a column that `v` determines, and a constant column. `f`
    /// changes from row to row.
    pub(crate) fn grid() -> Table {
        table(&[
            ("v", &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]),
            ("f", &[10.0, 20.0, 30.0, 10.0, 20.0, 30.0]),
            ("twice", &[2.0, 2.0, 2.0, 4.0, 4.0, 4.0]),
            ("same", &[7.0; 6]),
        ])
    }
}
