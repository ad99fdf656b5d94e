//! One point on scalars, from its first period to its row.

use core::cell::Cell;

use super::accuracy::{Verdict, judge};
use super::begin::begin;
use super::cycle::{cycle, end_of_period};
use super::estimate::Compared;
use super::orbit_row;
use super::row::Row;
use super::search::{Next, Search};
use super::settings::SolverSettings;
use super::single::{PointRun, Question};
use crate::measure::cycle::Signals;
use crate::model::Model;
use crate::num::Scalar;
use crate::ode::solve::solve_until;
use crate::ode::variation::Variation;
use crate::ode::{Interrupt, Start};

/// The row of a point from this state, or from rest. Interrupted, the row means nothing.
pub(super) struct RowFrom<'a>(pub(super) Option<&'a [f64]>);

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Question<M, N, K, S> for RowFrom<'_> {
    type Answer = Row;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Row {
        let PointRun { solver, values, interrupted, .. } = *run;
        match begin(model, values, self.0) {
            Ok(start) => settle::<M, R, N, K, S>(model, solver, &start, self.0.is_some(), interrupted).row,
            Err(error) => Row::invalid(error),
        }
    }
}

/// A point that has been followed until it settled, or until it was given up.
pub(super) struct Settled<const N: usize> {
    pub(super) search: Search<N>,
    pub(super) row: Row,
}

/// Follows a point from `start`, which is perhaps near its orbit if it is `nearby`. Interrupted, its row means nothing.
pub(super) fn settle<M, R, const N: usize, const K: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    nearby: bool,
    interrupted: Interrupt<'_>,
) -> Settled<N>
where
    M: Model<N, S>,
    R: Scalar,
{
    let mut point =
        Settling { model, solver, start, interrupted, search: Search::new(start, solver, nearby) };
    let mut next = Next::March(start.y);
    let mut last = None;
    loop {
        point.seek::<R, K>(next);
        let orbit = point.search.orbit().map(|orbit| orbit.y).filter(|_| !interrupted());
        let Some(orbit) = orbit else {
            let row = orbit_row::unsettled(&point.search, last);
            return Settled { search: point.search, row };
        };
        let periods = point.compare::<R>(&orbit);
        match judge(&mut point.search, model, start, &periods, last, solver.accuracy) {
            Verdict::Done(row) => return Settled { search: point.search, row },
            Verdict::Again(row, y) => {
                last = Some(row);
                next = Next::Vary(y);
            }
        }
    }
}

/// A point on its way.
struct Settling<'a, M: Model<N, S>, const N: usize, const S: usize> {
    model: &'a M,
    solver: &'a SolverSettings,
    start: &'a Start<M::Constants<f64>, N>,
    interrupted: Interrupt<'a>,
    search: Search<N>,
}

impl<M: Model<N, S>, const N: usize, const S: usize> Settling<'_, M, N, S> {
    /// Goes on with the search for an orbit, to its end.
    fn seek<R: Scalar, const K: usize>(&mut self, mut next: Next<N>) {
        while !(self.interrupted)() {
            next = match next {
                Next::March(y) => self.march::<R>(&y),
                Next::Vary(y) => self.vary::<R, K>(&y),
                Next::Done => return,
            }
        }
    }

    /// Marches from `y` until the search pauses the march.
    fn march<R: Scalar>(&mut self, y: &[f64; N]) -> Next<N> {
        let from = self.search.precision().start(self.start, y);
        let largest = Cell::new([R::splat((), 0.0); N]);
        let outcome = solve_until::<M, R, N>(
            self.model,
            &self.solver.tolerances(),
            &from,
            self.interrupted,
            |_, attempt| {
                let ([.., end], mut size) = (&attempt.step.y, largest.get());
                for i in 0..N {
                    size[i] = end[i].abs().max(size[i]);
                }
                largest.set(size);
            },
            |y| self.search.period_end(y, &largest.get().map(|size| size.lane(0))),
        );
        self.search.marched(outcome)
    }

    /// Integrates a period from `y` with its responses to changes of `y`.
    fn vary<R: Scalar, const K: usize>(&mut self, y: &[f64; N]) -> Next<N> {
        let from = self.search.responding(self.start, y);
        let (end, outcome) =
            end_of_period::<_, R, K>(&Variation(self.model), self.solver, &from, self.interrupted);
        self.search.varied(end.as_ref(), outcome)
    }

    /// Integrates a period of the orbit that begins at `orbit`, and one of the orbit that coarser tolerances have.
    fn compare<R: Scalar>(&mut self, orbit: &[f64; N]) -> Compared<S> {
        let Settling { model, solver, start, interrupted, .. } = *self;
        let coarse = self.search.precision().coarse(start, orbit);
        let (end, outcome) = end_of_period::<_, R, N>(model, solver, &coarse, interrupted);
        self.search.charge(outcome);

        let mut periods = Compared::new();
        let fine = self.search.precision().start(start, orbit);
        let (totals, outcome) = cycle::<M, R, N, S>(model, solver, &fine, &Signals::all(model), interrupted);
        self.search.charge(outcome);
        periods.take_fine(totals, outcome);
        if let Some(y) = end.and_then(|end| self.search.coarse_orbit(&end)) {
            let coarse = self.search.precision().coarse(start, &y);
            let (totals, outcome) =
                cycle::<M, R, N, S>(model, solver, &coarse, &Signals::means(model), interrupted);
            self.search.charge(outcome);
            periods.coarse = totals;
        }
        periods
    }
}
