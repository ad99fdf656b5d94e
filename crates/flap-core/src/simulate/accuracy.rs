//! The decision to integrate a point again: a row that is not accurate enough is integrated again from its orbit, with
//! tighter tolerances.

use super::estimate::Compared;
use super::orbit_row;
use super::row::Row;
use super::search::Search;
use super::settings::SolverSettings;
use super::status::Status;
use crate::model::Model;
use crate::ode::Start;

/// The next step for a point whose orbit has been measured.
pub(super) enum Verdict<const N: usize> {
    /// The point has its row.
    Done(Row),
    /// The orbit is to be found again, more exactly, from this state; the row is kept in case it cannot be.
    Again(Row, [f64; N]),
}

/// Judges the row of an orbit, given the last one of the point if this is not its first.
pub(super) fn judge<M: Model<N, S>, const N: usize, const S: usize>(
    search: &mut Search<N>,
    model: &M,
    start: &Start<M::Constants<f64>, N>,
    periods: &Compared<S>,
    last: Option<Row>,
    solver: &SolverSettings,
) -> Verdict<N> {
    let (row, audit) = orbit_row::measured(search, model, solver, start, periods);
    if row.status != Status::Periodic {
        return Verdict::Done(last.map_or(row, |last| orbit_row::charged(last, search)));
    }
    // An audit that is not a number compares nothing: the power is zero or not known. `f64::max` leaves it out.
    let again = if periods.slides {
        None
    } else {
        search.refine(row.error_estimate.max(audit.abs()), solver.accuracy)
    };
    match again {
        Some(y) => Verdict::Again(row, y),
        None => Verdict::Done(row),
    }
}
