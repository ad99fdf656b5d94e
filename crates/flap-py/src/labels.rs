//! Labels of columns for pictures.

use std::borrow::Cow;

use flap_core::simulate;
use flap_sweep::table::labels::{self, Direction, Label, Scale};
use pyo3::prelude::*;

/// Return the name of a column in words, without the unit: `lift_mean_mn` gives "Lift, mean".
#[pyfunction]
#[pyo3(signature = (name, unit, /))]
pub(crate) fn words(name: &str, unit: &str) -> String {
    let Label { words, .. } = labels::with_unit(name, unit);
    words
}

/// Return a unit for printing: `uN*m/rad` gives "µN·m/rad", `mm^2` gives "mm²", `deg` gives "°".
#[pyfunction]
#[pyo3(signature = (unit, /))]
pub(crate) fn printed(unit: &str) -> String {
    labels::printed(unit)
}

/// Return the factor that converts `unit` to a unit with readable numbers, and the printed name of the
/// readable unit. `largest` is the largest value that is printed, in `unit`.
#[pyfunction]
#[pyo3(signature = (unit, largest, /))]
pub(crate) fn scale(unit: &str, largest: f64) -> (f64, String) {
    let Scale { factor, unit } = labels::scale(unit, largest);
    (factor, unit)
}

/// Return the unit of a column, or empty text if the unit is unknown.
///
/// If `name` is a parameter, a measure or a derivative of a model, the unit of the quantity is returned. For all other
/// names, the unit at the end of the name is returned.
#[pyfunction]
#[pyo3(signature = (name, /))]
pub(crate) fn unit_of(name: &str) -> Cow<'static, str> {
    labels::unit_of(name, simulate::all())
}

/// Return the name of a column without the unit at the end, and the unit, which may be empty.
#[pyfunction]
#[pyo3(signature = (name, /))]
pub(crate) fn split_unit(name: &str) -> (&str, &'static str) {
    labels::split_unit(name)
}

/// Return 1 if larger values of a column are better (such as lift), -1 if smaller values are better (such as
/// power), and 0 otherwise.
#[pyfunction]
#[pyo3(signature = (name, /))]
pub(crate) fn better(name: &str) -> i8 {
    match labels::better(name) {
        Some(Direction::Larger) => 1,
        Some(Direction::Smaller) => -1,
        None => 0,
    }
}
