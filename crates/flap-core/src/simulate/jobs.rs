//! Design points as input of simulations, and rows as output.

use super::row::Row;
use crate::ode::ensemble::Occupancy;

/// One design point: an index, and one value per parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Index that [`Jobs::done`] receives together with the row of this point.
    ///
    /// The source of the points chooses the index. A sweep uses the index of the point in the plan, and
    /// [`run_list`](super::run_list) uses the position of the point in the list. The index does not affect
    /// results.
    pub index: u64,
    /// One value per parameter of the model.
    pub values: Vec<f64>,
    /// State in which the motion begins, at the beginning of a drive period, for example [`Row::state`] of a
    /// neighbouring point. `None` means that the motion begins at rest.
    pub begin: Option<Vec<f64>>,
}

impl Point {
    /// Returns a point whose motion begins at rest.
    pub fn at_rest(index: u64, values: Vec<f64>) -> Point {
        Point { index, values, begin: None }
    }
}

/// Source of design points, and receiver of the rows that are computed for these points.
pub trait Jobs {
    /// Returns the next point to compute, or `None` if no point is available at present.
    ///
    /// If `idle` is true, no point is being computed. The call may then wait for the next point, and `None`
    /// ends the run.
    fn next(&mut self, idle: bool) -> Option<Point>;

    /// Receives the row of the point with this [`Point::index`].
    fn done(&mut self, index: u64, row: Row);

    /// Returns true if the run must end at once. Unfinished points then receive no row, and [`Jobs::next`]
    /// must return `None`. See [`Interrupt`](super::Interrupt).
    fn interrupted(&self) -> bool {
        false
    }

    /// Receives a report on the use of the lanes at the end of the run.
    fn occupied(&mut self, lanes: &LaneUse) {
        let _ = lanes;
    }
}

/// Use of the SIMD lanes for each kind of drive period: the number of attempted steps in lanes with a run, and
/// in all lanes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LaneUse {
    /// Periods in which only the states are integrated: the march, and the steps of Broyden's method.
    pub marching: Occupancy,
    /// Periods in which the states and their derivatives with respect to the initial state are integrated.
    pub varying: Occupancy,
    /// Measured periods.
    pub measuring: Occupancy,
}
