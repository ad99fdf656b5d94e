//! Reads result files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use csv::StringRecord;
use flap_core::simulate;
use flap_sweep::files::integrity::{self, Note, OnDamage, Opened};
use flap_sweep::files::results::{Reader, Recorded, RowCheck};
use flap_sweep::files::sidecar::Sidecar;
use flap_sweep::plan::Plan;
use flap_sweep::run::identity::Identity;
use flap_sweep::run::{InvalidPoint, RunOptions};
use flap_sweep::table::layout::{CellKind, Column, Layout};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::{self, Columns};
use crate::{error, grid, sweep};

/// Read a result file; see `flapwing.read`.
#[pyfunction]
#[pyo3(signature = (path, /, *, ignore_damage=false))]
#[expect(clippy::needless_pass_by_value, reason = "a path out of Python is an owned one")]
pub(crate) fn read(py: Python<'_>, path: PathBuf, ignore_damage: bool) -> PyResult<Bound<'_, PyDict>> {
    let on_damage = if ignore_damage { OnDamage::Tolerate } else { OnDamage::Refuse };
    let Contents { columns, origin, units, warnings, is_verified } =
        py.detach(|| read_columns(&path, on_damage))?;
    let dict = PyDict::new(py);
    dict.set_item("columns", columns.into_python(py)?)?;
    dict.set_item("units", units)?;
    dict.set_item("warnings", warnings)?;
    dict.set_item("verified", is_verified)?;
    if let Some(Origin { plan, flap, build, arithmetic, invalid }) = origin {
        let meta = sweep::meta(py, &plan, &RunOptions::default())?;
        // Another version on another machine may have written the rows.
        meta.set_item("flap", flap)?;
        meta.set_item("build", build)?;
        meta.set_item("arithmetic", arithmetic)?;
        if let Some(invalid) = invalid {
            meta.set_item("invalid", columns::reasons(&invalid))?;
        }
        dict.set_item("meta", meta)?;
        // The rows of curves form no grid.
        if plan.followed().is_none() {
            dict.set_item("axes", grid::axes(py, &plan)?)?;
        }
    }
    Ok(dict)
}

/// The contents of a result file, with warnings for the user.
struct Contents {
    columns: Columns,
    /// The plan of the rows, and the program that wrote the rows, if the file or its sidecar records the plan
    /// and the program.
    origin: Option<Origin>,
    /// Units of the columns, if the file records the units.
    units: BTreeMap<String, String>,
    warnings: Vec<String>,
    /// True if checksums agree with the rows.
    is_verified: bool,
}

/// The origin of rows: the plan, and the program that wrote the rows.
struct Origin {
    plan: Plan,
    flap: String,
    build: String,
    arithmetic: String,
    /// The first few invalid points, if the file has a sidecar and the sweep has ended.
    invalid: Option<Vec<InvalidPoint>>,
}

fn read_columns(path: &Path, on_damage: OnDamage) -> PyResult<Contents> {
    let place = path.display();
    let unreadable = |error| error::unreadable(&place, &error);
    let open = || integrity::open(path, on_damage).map_err(|error| error::open(&error));
    let Opened { mut reader, sidecar, notes } = open()?;
    let origin = origin(sidecar, &reader);
    let described = match &origin {
        Some(origin) => Layout::of(&origin.plan).columns(),
        None => guess(&mut open()?.reader).map_err(unreadable)?,
    };
    let mut columns = Columns::new(described);
    let mut row = StringRecord::new();
    let mut line = 1_u64;
    let mut check = origin.as_ref().map(|origin| RowCheck::new(&origin.plan, None));
    if let Some(check) = &mut check {
        check.allow_gaps();
    }
    while reader.next(&mut row).map_err(unreadable)? {
        line += 1;
        let is_none = reader.is_tolerant() && check.as_mut().is_some_and(|check| check.row(&row).is_err());
        if is_none && reader.leave_out() {
            continue;
        }
        if let Err(column) = columns.push_record(row.iter()) {
            let message = format!("{place}, line {line}: a cell of column {column} has the wrong type");
            return Err(PyValueError::new_err(message));
        }
    }
    let units = Recorded::of(reader.entries()).map(|recorded| recorded.units()).unwrap_or_default();
    let is_told = |note: &&Note| !matches!(note, Note::Unverified { .. });
    let mut warnings: Vec<String> = notes.iter().filter(is_told).map(Note::to_string).collect();
    warnings.extend(reader.missed().map(|missed| format!("{place}: {missed}")));
    Ok(Contents { columns, origin, units, warnings, is_verified: notes.is_empty() })
}

/// Returns the plan of the rows and the program that wrote the rows. The plan is in the sidecar or, without a
/// sidecar, in the results file. Returns `None` if the columns of the plan differ from the columns of the
/// file.
fn origin(sidecar: Option<Sidecar>, reader: &Reader) -> Option<Origin> {
    let fits = |origin: &Origin| Layout::of(&origin.plan).names().iter().eq(reader.names());
    sidecar.and_then(beside).filter(fits).or_else(|| inside(reader).filter(fits))
}

fn beside(sidecar: Sidecar) -> Option<Origin> {
    let plan = sidecar.plan(simulate::all()).ok()?;
    let Identity { flap, build, arithmetic, .. } = sidecar.identity;
    let invalid = sidecar.summary.map(|summary| summary.invalid);
    Some(Origin { plan, flap, build, arithmetic, invalid })
}

fn inside(reader: &Reader) -> Option<Origin> {
    let recorded = Recorded::of(reader.entries())?;
    let plan = recorded.plan(simulate::all())?;
    let [flap, build, arithmetic] =
        ["flap", "flap.build", "flap.arithmetic"].map(|key| recorded.text(key).to_owned());
    Some(Origin { plan, flap, build, arithmetic, invalid: None })
}

/// Returns the columns of a file that contains no plan of its rows. The cells of each column determine the
/// kind of the column.
fn guess(reader: &mut Reader) -> std::io::Result<Vec<Column>> {
    let mut kinds: Vec<Option<CellKind>> = vec![None; reader.names().len()];
    let mut row = StringRecord::new();
    while reader.next(&mut row)? {
        for (kind, cell) in kinds.iter_mut().zip(&row) {
            if !cell.is_empty() {
                let found = kind_of(cell);
                *kind = Some(kind.map_or(found, |before| either(before, found)));
            }
        }
    }
    let columns = reader.names().iter().zip(kinds);
    Ok(columns.map(|(name, kind)| columns::named(name, kind.unwrap_or(CellKind::Number))).collect())
}

fn kind_of(cell: &str) -> CellKind {
    if cell.parse::<u64>().is_ok() {
        CellKind::Whole
    } else if cell.parse::<f64>().is_ok() {
        CellKind::Number
    } else if cell.parse::<bool>().is_ok() {
        CellKind::Flag
    } else {
        CellKind::Text
    }
}

fn either(a: CellKind, b: CellKind) -> CellKind {
    match (a, b) {
        _ if a == b => a,
        (CellKind::Whole, CellKind::Number) | (CellKind::Number, CellKind::Whole) => CellKind::Number,
        _ => CellKind::Text,
    }
}
