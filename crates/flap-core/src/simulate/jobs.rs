//! Design points as input of the lanes, and rows as output.

use super::row::Row;
use crate::ode::ensemble::Occupancy;

/// One design point: an index, and one value per parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Index that [`Jobs::done`] reports with the row of this point.
    ///
    /// The caller chooses it: the index in the plan for a sweep, the position in the list for
    /// [`run_list`](super::run_list). It does not affect results.
    pub index: u64,
    /// One value per parameter of the model.
    pub values: Vec<f64>,
    /// State at the beginning of a drive period from which the motion is followed, such as [`Row::state`] of a
    /// neighbouring point; `None` for rest.
    pub begin: Option<Vec<f64>>,
}

impl Point {
    /// Returns a point whose motion begins at rest.
    pub fn at_rest(index: u64, values: Vec<f64>) -> Point {
        Point { index, values, begin: None }
    }
}

/// Source of points and receiver of their rows.
pub trait Jobs {
    /// Returns the next point, or `None` if there is none at present.
    ///
    /// If `idle` is true, nothing else is running: the call may wait, and `None` ends the run.
    fn next(&mut self, idle: bool) -> Option<Point>;

    /// Receives the row of the point with this [`Point::index`].
    fn done(&mut self, index: u64, row: Row);

    /// Returns true to end the run at once. Points without a row then get none, and `next` must return `None`. See
    /// [`Interrupt`](super::Interrupt).
    fn interrupted(&self) -> bool {
        false
    }

    /// Receives a report on the use of the lanes at the end of the run.
    fn occupied(&mut self, lanes: &LaneUse) {
        let _ = lanes;
    }
}

/// Use of the lanes of all ensembles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LaneUse {
    /// Periods of the states alone: marching and chord steps.
    pub marching: Occupancy,
    /// Periods with responses to changes of the state.
    pub varying: Occupancy,
    /// Measured periods.
    pub measuring: Occupancy,
}
