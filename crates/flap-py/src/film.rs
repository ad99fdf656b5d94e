//! Filmed wings: computes stroke and pitch from points in images.

use flap_core::simulate::Trajectory;
use flap_experiments::tracking::{LeadingEdge, pitch_from_projection, rotation_centre, strokes};
use flap_sweep::files::record;
use pyo3::exceptions::PyValueError;
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
    let times = record.column(&record::TIME).map_err(|error| records::refused(&error))?;
    let marked = |name: &str| record.points(name).map_err(|error| records::refused(&error));
    let (roots, tips) = (marked("root")?, marked("tip")?);
    let edges: Vec<LeadingEdge> =
        roots.into_iter().zip(tips).map(|(root, tip)| LeadingEdge { root, tip }).collect();
    let centre = rotation_centre(&edges).map_err(|invalid| PyValueError::new_err(invalid.to_string()))?;

    let mut columns = vec!["time_s".to_owned(), "stroke_deg".to_owned()];
    let mut rows: Vec<Vec<f64>> =
        times.iter().zip(strokes(&edges)).map(|(time, stroke)| vec![*time, stroke.to_degrees()]).collect();
    if let Some(chord) = chord {
        let chord = convert::number("chord", "a number, in the unit of the points", chord)?;
        columns.push("pitch_deg".to_owned());
        let lower = marked("edge")?;
        for (i, (row, (edge, point))) in rows.iter_mut().zip(edges.iter().zip(lower)).enumerate() {
            let pitch = pitch_from_projection(edge.distance(point), chord);
            let pitch =
                pitch.map_err(|invalid| PyValueError::new_err(format!("image {}: {invalid}", i + 1)))?;
            row.push(pitch.to_degrees());
        }
    }
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
    motion::into_python(py, Trajectory { columns, rows }, meaning, &meta)
}
