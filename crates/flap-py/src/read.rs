//! Result files, read back.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use csv::StringRecord;
use flap_core::simulate;
use flap_sweep::layout::{self, Column, Kind, Layout};
use flap_sweep::plan::Plan;
use flap_sweep::results::{Format, Reader, Recorded};
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
    let Read { columns, origin, units } = py.detach(|| read_columns(&path, format))?;
    let dict = PyDict::new(py);
    dict.set_item("columns", columns.into_python(py)?)?;
    dict.set_item("units", units)?;
    if let Some(Origin { plan, flap, arithmetic }) = origin {
        let meta = sweep::meta(py, &plan, &RunOptions::default())?;
        // What wrote them may be another version, on another machine.
        meta.set_item("flap", flap)?;
        meta.set_item("arithmetic", arithmetic)?;
        dict.set_item("meta", meta)?;
        dict.set_item("axes", grid::axes(py, &plan)?)?;
    }
    Ok(dict)
}

/// What is read.
struct Read {
    columns: Columns,
    /// Where the rows come from, if that is recorded.
    origin: Option<Origin>,
    /// Units that the file itself tells of.
    units: BTreeMap<String, String>,
}

/// Where rows come from.
struct Origin {
    plan: Plan,
    flap: String,
    arithmetic: String,
}

fn read_columns(path: &Path, format: Format) -> PyResult<Read> {
    let place = path.display();
    let unreadable = |error| error::io_error(&format!("cannot read {place}"), &error);
    let open = || File::open(path).and_then(|file| Reader::new(file, format)).map_err(unreadable);
    let mut reader = open()?;
    let origin = origin(path, &reader);
    let described = match &origin {
        Some(origin) => Layout::of(&origin.plan).columns(),
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
    let units = Recorded::of(reader.entries()).map(|recorded| recorded.units()).unwrap_or_default();
    Ok(Read { columns, origin, units })
}

/// What the sidecar says, or else the file itself, if it tells of these columns.
fn origin(path: &Path, reader: &Reader) -> Option<Origin> {
    let fits = |origin: &Origin| Layout::of(&origin.plan).names().iter().eq(reader.names());
    beside(path).filter(fits).or_else(|| inside(reader).filter(fits))
}

fn beside(path: &Path) -> Option<Origin> {
    let sidecar = Sidecar::read(&sidecar::path_of(path)).ok()?;
    let plan = sidecar.plan(simulate::all()).ok()?;
    Some(Origin { plan, flap: sidecar.flap, arithmetic: sidecar.arithmetic })
}

fn inside(reader: &Reader) -> Option<Origin> {
    let recorded = Recorded::of(reader.entries())?;
    let plan = recorded.plan(simulate::all())?;
    Some(Origin { plan, flap: recorded.flap().to_owned(), arithmetic: recorded.arithmetic().to_owned() })
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
