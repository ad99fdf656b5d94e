//! One point on scalars, from its first period to its row.

use core::cell::Cell;
use core::ops::ControlFlow;

use super::accuracy::{Compared, Verdict, judge};
use super::row;
use super::scalar::cycle;
use super::search::{Next, Search};
use super::simulator::{Row, SolverSettings};
use crate::measure::cycle::Signals;
use crate::model::Model;
use crate::num::Scalar;
use crate::ode::solve::solve_until;
use crate::ode::variation::Variation;
use crate::ode::{Interrupt, Start};

/// A point that has been followed until it settled, or until it was given up.
pub(super) struct Settled<const N: usize> {
    pub(super) search: Search<N>,
    pub(super) row: Row,
}

/// Follows a point from `start`, which is perhaps near its orbit if it is `nearby`. Interrupted, it comes to nothing.
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
        point.seek::<R, K, S>(next);
        let orbit = point.search.orbit().map(|orbit| orbit.y).filter(|_| !interrupted());
        let Some(orbit) = orbit else {
            let row = row::unsettled(&point.search, last);
            return Settled { search: point.search, row };
        };
        let periods = point.compare::<R, S>(&orbit);
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
struct Settling<'a, M, C, const N: usize> {
    model: &'a M,
    solver: &'a SolverSettings,
    start: &'a Start<C, N>,
    interrupted: Interrupt<'a>,
    search: Search<N>,
}

impl<M, C: Copy, const N: usize> Settling<'_, M, C, N> {
    /// Goes on with the search for an orbit, to its end.
    fn seek<R: Scalar, const K: usize, const S: usize>(&mut self, mut next: Next<N>)
    where
        M: Model<N, S, Constants<f64> = C>,
    {
        while !(self.interrupted)() {
            next = match next {
                Next::March(y) => self.march::<R, S>(&y),
                Next::Vary(y) => self.vary::<R, K, S>(&y),
                Next::Done => return,
            }
        }
    }

    fn march<R: Scalar, const S: usize>(&mut self, y: &[f64; N]) -> Next<N>
    where
        M: Model<N, S, Constants<f64> = C>,
    {
        let from = self.search.start(self.start, y);
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

    fn vary<R: Scalar, const K: usize, const S: usize>(&mut self, y: &[f64; N]) -> Next<N>
    where
        M: Model<N, S, Constants<f64> = C>,
    {
        let mut end: Option<[f64; K]> = None;
        let outcome = solve_until::<Variation<'_, M, N>, R, K>(
            &Variation(self.model),
            &self.solver.tolerances(),
            &self.search.responding(self.start, y),
            self.interrupted,
            |_, _| {},
            |all| {
                end = Some(*all);
                ControlFlow::Break(())
            },
        );
        self.search.varied(end.as_ref(), outcome)
    }

    /// Integrates a period of the orbit that begins at `orbit`, and one of the orbit that coarser tolerances have.
    fn compare<R: Scalar, const S: usize>(&mut self, orbit: &[f64; N]) -> Compared<S>
    where
        M: Model<N, S, Constants<f64> = C>,
    {
        let Settling { model, solver, start, interrupted, .. } = *self;
        let mut end = None;
        let outcome = solve_until::<M, R, N>(
            model,
            &solver.tolerances(),
            &self.search.coarse(start, orbit),
            interrupted,
            |_, _| {},
            |y| {
                end = Some(*y);
                ControlFlow::Break(())
            },
        );
        self.search.charge(outcome);

        let mut periods = Compared::new();
        let fine = self.search.start(start, orbit);
        let (totals, outcome) = cycle::<M, R, N, S>(model, solver, &fine, Signals::ALL, interrupted);
        self.search.charge(outcome);
        periods.take_fine(totals, outcome);
        if let Some(y) = end.and_then(|end| self.search.coarse_orbit(&end)) {
            let coarse = self.search.coarse(start, &y);
            let (totals, outcome) = cycle::<M, R, N, S>(model, solver, &coarse, Signals::MEANS, interrupted);
            self.search.charge(outcome);
            periods.coarse = totals;
        }
        periods
    }
}
