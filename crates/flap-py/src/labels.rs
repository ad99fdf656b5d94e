//! Labels of columns, for pictures.

use std::borrow::Cow;

use flap_core::simulate;
use flap_sweep::table::labels::{self, Direction, Label, Scale};
use flap_sweep::table::layout;
use pyo3::prelude::*;

/// A column's name in words, without its unit: `lift_mean_mn` is "Lift, mean".
#[pyfunction]
#[pyo3(signature = (name, unit, /))]
pub(crate) fn words(name: &str, unit: &str) -> String {
    let Label { words, .. } = labels::with_unit(name, unit);
    words
}

/// A unit as it is printed: `uN*m/rad` is "µN·m/rad", `mm^2` is "mm²", `deg` is "°".
#[pyfunction]
#[pyo3(signature = (unit, /))]
pub(crate) fn printed(unit: &str) -> String {
    labels::printed(unit)
}

/// The factor to a readable unit, and that unit as it is printed, for values in `unit` of which `largest` is the largest.
#[pyfunction]
#[pyo3(signature = (unit, largest, /))]
pub(crate) fn scale(unit: &str, largest: f64) -> (f64, String) {
    let Scale { factor, unit } = labels::scale(unit, largest);
    (factor, unit)
}

/// The unit of a column: that of the parameter or measure with this name in any model, or of the derivative of one by another,
/// else the ending of the name; empty for none.
#[pyfunction]
#[pyo3(signature = (name, /))]
pub(crate) fn unit_of(name: &str) -> Cow<'static, str> {
    labels::unit_of(name, simulate::all())
}

/// A column's name without the unit that it ends in, and that unit; empty if there is none.
#[pyfunction]
#[pyo3(signature = (name, /))]
pub(crate) fn split_unit(name: &str) -> (&str, &'static str) {
    layout::split_unit(name)
}

/// The better direction of a column: 1 for a benefit such as lift, -1 for a cost such as power, 0 for neither.
#[pyfunction]
#[pyo3(signature = (name, /))]
pub(crate) fn better(name: &str) -> i8 {
    match labels::better(name) {
        Some(Direction::Larger) => 1,
        Some(Direction::Smaller) => -1,
        None => 0,
    }
}
