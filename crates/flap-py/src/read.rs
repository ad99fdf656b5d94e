//! Result files, read back.

use std::fs::File;
use std::path::{Path, PathBuf};

use csv::StringRecord;
use flap_core::simulate;
use flap_sweep::layout::{self, Column, Kind, Layout};
use flap_sweep::plan::Plan;
use flap_sweep::results::{Format, Reader};
use flap_sweep::run::RunOptions;
use flap_sweep::sidecar::{self, Sidecar};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::Columns;
use crate::{error, grid, sweep};

/// Reads a result file; see `flapwing.read`.
#[pyfunction]
#[pyo3(signature = (path, /))]
#[expect(clippy::needless_pass_by_value, reason = "a path out of Python is an owned one")]
pub(crate) fn read(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let format = Format::of(&path).map_err(|error| PyValueError::new_err(error.to_string()))?;
    let (columns, recorded) = py.detach(|| read_columns(&path, format))?;
    let dict = PyDict::new(py);
    dict.set_item("columns", columns.into_python(py)?)?;
    if let Some((sidecar, plan)) = recorded {
        let meta = sweep::meta(py, &plan, &RunOptions::default())?;
        // What wrote them may be another version, on another machine.
        meta.set_item("flap", sidecar.flap)?;
        meta.set_item("build", sidecar.build)?;
        meta.set_item("arithmetic", sidecar.arithmetic)?;
        dict.set_item("meta", meta)?;
        dict.set_item("axes", grid::axes(py, &plan)?)?;
    }
    Ok(dict)
}

/// The cells of a file, and where they come from if that is recorded.
fn read_columns(path: &Path, format: Format) -> PyResult<(Columns, Option<(Sidecar, Plan)>)> {
    let place = path.display();
    let unreadable = |error| error::io_error(&format!("cannot read {place}"), &error);
    let open = || File::open(path).and_then(|file| Reader::new(file, format)).map_err(unreadable);
    let mut reader = open()?;
    let recorded = recorded(path, reader.names());
    let described = match &recorded {
        Some((_, plan)) => Layout::of(plan).columns(),
        None => guess(&mut open()?).map_err(unreadable)?,
    };
    let mut columns = Columns::new(described);
    let mut row = StringRecord::new();
    let mut line = 1_u64;
    while reader.next(&mut row).map_err(unreadable)? {
        line += 1;
        if let Err(column) = columns.push_record(row.iter()) {
            let message = format!("{place}, line {line}: a cell of column {column} is not of its kind");
            return Err(PyValueError::new_err(message));
        }
    }
    Ok((columns, recorded))
}

/// The sidecar and its plan, if there is one that tells of these columns.
fn recorded(path: &Path, names: &[String]) -> Option<(Sidecar, Plan)> {
    let sidecar = Sidecar::read(&sidecar::path_of(path)).ok()?;
    let plan = sidecar.plan(simulate::all()).ok()?;
    Layout::of(&plan).names().iter().eq(names).then_some((sidecar, plan))
}

/// What columns hold as far as their cells tell.
fn guess(reader: &mut Reader) -> std::io::Result<Vec<Column>> {
    let mut kinds: Vec<Option<Kind>> = vec![None; reader.names().len()];
    let mut row = StringRecord::new();
    while reader.next(&mut row)? {
        for (kind, cell) in kinds.iter_mut().zip(&row) {
            if !cell.is_empty() {
                let found = kind_of(cell);
                *kind = Some(kind.map_or(found, |before| either(before, found)));
            }
        }
    }
    let column = |(name, kind): (&String, Option<Kind>)| Column {
        name: name.clone(),
        unit: layout::split_unit(name).1,
        kind: kind.unwrap_or(Kind::Number),
        doc: String::new(),
    };
    Ok(reader.names().iter().zip(kinds).map(column).collect())
}

fn kind_of(cell: &str) -> Kind {
    if cell.parse::<u64>().is_ok() {
        Kind::Whole
    } else if cell.parse::<f64>().is_ok() {
        Kind::Number
    } else if cell.parse::<bool>().is_ok() {
        Kind::Flag
    } else {
        Kind::Text
    }
}

fn either(a: Kind, b: Kind) -> Kind {
    match (a, b) {
        _ if a == b => a,
        (Kind::Whole, Kind::Number) | (Kind::Number, Kind::Whole) => Kind::Number,
        _ => Kind::Text,
    }
}
