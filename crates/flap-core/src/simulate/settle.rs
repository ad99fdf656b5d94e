//! One point on scalars, from its first period to its row.

use core::cell::Cell;

use super::accuracy::{Verdict, judge};
use super::begin::begin;
use super::cycle::{Measured, cycle, end_of_period};
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
    while !interrupted() {
        next = match next {
            Next::March(y) => point.march::<R>(&y),
            Next::Vary(y) => point.vary::<R, K>(&y),
            Next::Measure => match point.measure::<R>() {
                Err(next) => next,
                Ok(periods) => match judge(&mut point.search, model, start, &periods, last.take(), solver) {
                    Verdict::Done(row) => return Settled { search: point.search, row },
                    Verdict::Again(row, y) => {
                        last = Some(row);
                        Next::Vary(y)
                    }
                },
            },
            Next::Done => break,
        };
    }
    let row = orbit_row::unsettled(&point.search, last);
    Settled { search: point.search, row }
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
    /// Integrates periods from `y` until the search has enough of them.
    fn march<R: Scalar>(&mut self, y: &[f64; N]) -> Next<N> {
        let from = self.search.marching(self.start, y);
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

    /// Integrates a period of the orbit, and one of the orbit that coarser tolerances have. An error is the search's next
    /// step, if the orbit turns out not to be one.
    fn measure<R: Scalar>(&mut self) -> Result<Compared<S>, Next<N>> {
        let mut periods = Compared::new();
        let fine = self
            .search
            .orbit(self.start)
            .map(|fine| self.cycle::<R>(&fine, &Signals::all(self.model).with_loads(self.solver.loads)));
        if let Some((end, outcome)) = fine {
            if let Some(next) = self.search.confirm(end.as_ref().map(|(y, _)| y)) {
                return Err(next);
            }
            periods.take_fine(end.map(|(_, totals)| totals), outcome);
        }
        let coarse = self.search.coarse_orbit(self.start);
        let coarse = coarse.map(|coarse| self.cycle::<R>(&coarse, &Signals::means(self.model)));
        periods.coarse = coarse.and_then(|(end, _)| end).map(|(_, totals)| totals);
        Ok(periods)
    }

    /// Integrates a period from `start`, of what `signals` asks for.
    fn cycle<R: Scalar>(
        &mut self,
        start: &Start<M::Constants<f64>, N>,
        signals: &Signals<'_, M, S>,
    ) -> Measured<N, S> {
        let measured = cycle::<M, R, N, S>(self.model, self.solver, start, signals, self.interrupted);
        self.search.charge(measured.1);
        measured
    }
}
