//! Filmed wings: computes stroke and pitch from points in images.

use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::{convert, motion, records};

/// Compute stroke and pitch of a filmed wing; see `flapwing.track_wing`.
#[pyfunction]
#[pyo3(signature = (points, /, *, chord=None))]
pub(crate) fn track_wing<'py>(
    py: Python<'py>,
    points: &Bound<'py, PyAny>,
    chord: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let record = records::read("points", points)?;
    let chord = chord.map(|chord| convert::number("chord", "a number, in the unit of the points", chord));
    let (motion, centre) = record.tracked(chord.transpose()?).map_err(|error| records::refused(&error))?;
    let meta = PyDict::new(py);
    meta.set_item("centre", (centre[0], centre[1]))?;
    let meaning = |name: &str| {
        let doc = match name {
            "time_s" => "time of the image",
            "stroke_deg" => "angle from the x-axis to the leading edge",
            _ => "pitch, from the chord as it appears in the image",
        };
        doc.to_owned()
    };
    motion::into_python(py, motion, meaning, &meta)
}
