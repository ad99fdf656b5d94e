//! Collects rows into columns, which become NumPy arrays without a copy.

use std::io;

use flap_sweep::run::{InvalidPoint, Sink, Summary, Unsatisfied};
use flap_sweep::table::labels::split_unit;
use flap_sweep::table::layout::{Cell, CellKind, Column};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

/// A table in memory.
pub(crate) struct Columns {
    columns: Vec<(Column, Data)>,
}

/// The cells of a column.
enum Data {
    Whole(Vec<u64>),
    Number(Vec<f64>),
    /// Flags: 1 for true, 0 for false, -1 for unknown.
    Flag(Vec<i8>),
    /// Text: the first list contains one index for each row. An index denotes a word in the second list.
    Text(Vec<u32>, Vec<String>),
}

impl Data {
    fn new(kind: CellKind) -> Data {
        match kind {
            CellKind::Whole => Data::Whole(Vec::new()),
            CellKind::Number => Data::Number(Vec::new()),
            CellKind::Flag => Data::Flag(Vec::new()),
            CellKind::Text => Data::Text(Vec::new(), Vec::new()),
        }
    }

    /// Adds a cell. The kind of the cell (number, whole number, flag or text) must be the kind of the column.
    fn push(&mut self, cell: Cell) {
        match (self, cell) {
            (Data::Whole(cells), Cell::Whole(cell)) => cells.push(cell),
            (Data::Number(cells), Cell::Number(cell)) => cells.push(cell),
            (Data::Flag(cells), Cell::Flag(cell)) => cells.push(cell.map_or(-1, i8::from)),
            (Data::Text(places, words), Cell::Text(word)) => {
                // A linear search suffices, because columns of text have few different words.
                let place = words.iter().position(|known| known == word).unwrap_or_else(|| {
                    words.push(word.to_owned());
                    words.len() - 1
                });
                places.push(u32::try_from(place).unwrap_or(u32::MAX));
            }
            _ => debug_assert!(false, "a cell of another kind than its column"),
        }
    }
}

/// Returns a column with an empty description. The unit of the column is the unit at the end of its name.
pub(crate) fn named(name: &str, kind: CellKind) -> Column {
    Column { name: name.to_owned(), unit: split_unit(name).1.into(), kind, doc: String::new() }
}

impl Columns {
    /// Returns an empty table.
    pub(crate) fn new(columns: Vec<Column>) -> Columns {
        let columns = columns.into_iter().map(|column| {
            let data = Data::new(column.kind);
            (column, data)
        });
        Columns { columns: columns.collect() }
    }

    /// Adds a row, which has one cell per column.
    pub(crate) fn push(&mut self, cells: &[Cell]) {
        for ((_, data), cell) in self.columns.iter_mut().zip(cells) {
            data.push(*cell);
        }
    }

    /// Adds a row whose cells are texts from a file. If a text cannot be converted to the kind of its column,
    /// returns the name of the column as an error.
    pub(crate) fn push_record<'a>(&mut self, cells: impl Iterator<Item = &'a str>) -> Result<(), &str> {
        for ((column, data), text) in self.columns.iter_mut().zip(cells) {
            data.push(Cell::parse(column.kind, text).ok_or(column.name.as_str())?);
        }
        Ok(())
    }

    /// Returns a dictionary of columns by name. Each column is a tuple of unit, description, cells (an array)
    /// and words.
    ///
    /// The cells of a text column are indices into the list of words. Columns of numbers and flags have None
    /// instead of a list of words. Arrays of flags contain 1 for true, 0 for false and -1 for unknown.
    pub(crate) fn into_python(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let dict = PyDict::new(py);
        for (Column { name, unit, doc, .. }, data) in self.columns {
            let (cells, words) = match data {
                Data::Whole(cells) => (PyArray1::from_vec(py, cells).into_any(), None),
                Data::Number(cells) => (PyArray1::from_vec(py, cells).into_any(), None),
                Data::Flag(cells) => (PyArray1::from_vec(py, cells).into_any(), None),
                Data::Text(places, words) => (PyArray1::from_vec(py, places).into_any(), Some(words)),
            };
            dict.set_item(name, (unit, doc, cells, words))?;
        }
        Ok(dict)
    }
}

impl Sink for Columns {
    fn write(&mut self, cells: &[Cell]) -> io::Result<()> {
        self.push(cells);
        Ok(())
    }
}

/// Returns the summary of a finished sweep as a dictionary.
pub(crate) fn summary<'py>(py: Python<'py>, summary: &Summary) -> PyResult<Bound<'py, PyDict>> {
    let counts = summary.statuses.iter().filter(|(_, count)| *count > 0);
    let counts = counts.map(|(status, count)| (status.name(), count));
    let dict = PyDict::new(py);
    dict.set_item("rows", summary.rows)?;
    dict.set_item("counts", counts.into_py_dict(py)?)?;
    dict.set_item("excluded", summary.excluded)?;
    dict.set_item("unsatisfied", unsatisfied(py, &summary.unsatisfied)?)?;
    dict.set_item("cycles", summary.cycles)?;
    dict.set_item("rhs_evals", summary.rhs_evals)?;
    dict.set_item("invalid", reasons(&summary.invalid))?;
    Ok(dict)
}

/// Returns the indices of invalid points, each with the reason why the point is invalid.
pub(crate) fn reasons(invalid: &[InvalidPoint]) -> Vec<(u64, &str)> {
    invalid.iter().map(|invalid| (invalid.point, invalid.reason.as_str())).collect()
}

/// Returns a dictionary of the conditions of a plan, each with the number of points that do not satisfy the condition.
pub(crate) fn unsatisfied<'py>(py: Python<'py>, unsatisfied: &[Unsatisfied]) -> PyResult<Bound<'py, PyDict>> {
    unsatisfied.iter().map(|known| (&known.condition, known.points)).into_py_dict(py)
}
