//! Points on their way into lanes, and rows on their way out.

use super::row::Row;
use crate::ode::ensemble::Occupancy;

/// One design point: the number of its row and one value per parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The number by which [`Jobs::done`] names the row of this point. Its giver chooses it: the index in the plan for a
    /// sweep, the place in the list for [`run_list`](super::run_list), a probe's own number for a study. Nothing is computed
    /// from it.
    pub index: u64,
    /// One value per parameter of the model.
    pub values: Vec<f64>,
    /// The state at the beginning of a drive period from which the motion is followed, such as [`Row::state`] of
    /// a neighbour; at rest if `None`.
    pub begin: Option<Vec<f64>>,
}

impl Point {
    /// A point whose motion begins at rest.
    pub fn at_rest(index: u64, values: Vec<f64>) -> Point {
        Point { index, values, begin: None }
    }
}

/// A source of points that takes their rows.
pub trait Jobs {
    /// The next point, or `None` if there is none for now.
    ///
    /// With `idle`, nothing else is running: the call may wait, and `None` ends the run.
    fn next(&mut self, idle: bool) -> Option<Point>;

    /// Takes the row of the point with this [`Point::index`].
    fn done(&mut self, index: u64, row: Row);

    /// True if the run is to end at once. Points that have no row yet get none, and `next` is to give no more. See
    /// [`Interrupt`](super::Interrupt).
    fn interrupted(&self) -> bool {
        false
    }

    /// Takes a report on the lanes at the end of the run.
    fn occupied(&mut self, lanes: &LaneUse) {
        let _ = lanes;
    }
}

/// Use of the lanes of the ensembles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LaneUse {
    /// Periods of the states alone: of marches and of chord steps.
    pub marching: Occupancy,
    /// Periods with responses to changes of the state.
    pub varying: Occupancy,
    /// Periods that are measured.
    pub measuring: Occupancy,
}
