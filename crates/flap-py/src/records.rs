//! Reads records over time that a Python user gives: waveforms, strokes, motions and points in images.

use std::path::PathBuf;

use flap_core::drive::{Repeat, Samples};
use flap_sweep::files::record::{self, Quantity, Record, RecordError};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error;

/// A waveform of the drive, or a stroke, as samples.
pub(crate) struct Wave {
    pub(crate) samples: Samples,
    /// True for a stroke (rad), false for a waveform of unit amplitude.
    pub(crate) is_stroke: bool,
}

impl Wave {
    /// Returns the samples of the waveform or of the stroke, or `None` if the call gives neither a waveform
    /// nor a stroke.
    pub(crate) fn of(
        waveform: Option<&Bound<'_, PyAny>>,
        stroke: Option<&Bound<'_, PyAny>>,
        once: bool,
    ) -> PyResult<Option<Wave>> {
        let (source, name, quantity) = match (waveform, stroke) {
            (Some(_), Some(_)) => {
                return Err(PyValueError::new_err(
                    "waveform and stroke cannot be used together\nkeep one of them",
                ));
            }
            (Some(source), None) => (source, "waveform", record::WAVE),
            (None, Some(source)) => (source, "stroke", record::STROKE),
            (None, None) if once => {
                return Err(PyValueError::new_err("once requires a waveform or a stroke\ngive one of them"));
            }
            (None, None) => return Ok(None),
        };
        let repeat = if once { Repeat::Once } else { Repeat::Periodic };
        let record = read(name, source)?;
        let samples = samples(&record, &quantity, repeat)?;
        let is_stroke = stroke.is_some();
        if let Some(warning) = record.overshoot(&samples, if is_stroke { " rad" } else { "" }) {
            error::warn(source.py(), warning)?;
        }
        Ok(Some(Wave { samples, is_stroke }))
    }
}

/// Reads a record (values over time) from a file or from a dictionary of float64 arrays. Error messages use
/// `name` as the name of the record.
pub(crate) fn read(name: &str, source: &Bound<'_, PyAny>) -> PyResult<Record> {
    let Ok(columns) = source.cast::<PyDict>() else {
        let path: PathBuf = source.extract()?;
        return Record::read(&path).map_err(|error| refused(&error));
    };
    let columns = columns.iter().map(|(heading, numbers)| {
        Ok((heading.extract::<String>()?, numbers.cast::<PyArray1<f64>>()?.to_vec()?))
    });
    Record::of(name, columns.collect::<PyResult<_>>()?).map_err(|error| refused(&error))
}

/// Returns the samples over time of one quantity of a record.
pub(crate) fn samples(record: &Record, quantity: &Quantity<'_>, repeat: Repeat) -> PyResult<Samples> {
    record.samples(quantity, repeat).map_err(|error| refused(&error))
}

/// Returns the exception for a record of values over time that cannot be used.
pub(crate) fn refused(error: &RecordError) -> PyErr {
    match error {
        RecordError::Read { name, source } => error::unreadable(name, source),
        other => PyValueError::new_err(other.to_string()),
    }
}
