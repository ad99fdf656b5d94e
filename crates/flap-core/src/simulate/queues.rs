//! Queues of the ensembles that integrate single periods of many points: with responses to changes, or measured.

use core::iter::Enumerate;
use core::ops::ControlFlow;
use std::vec::IntoIter;

use super::jobs::Jobs;
use super::row::Row;
use super::search::{Next, Search};
use crate::ode::ensemble::{Continuation, NewRun, Observer, Queue, Unobserved};
use crate::ode::variation::Variation;
use crate::ode::{Ode, Outcome, Start};

/// A run on its way to its orbit.
pub(super) struct Searched<C, const N: usize> {
    pub(super) index: u64,
    pub(super) start: Start<C, N>,
    pub(super) search: Search<N>,
    /// The row from an orbit that is being found again, more exactly.
    pub(super) last: Option<Row>,
}

/// A run that is in no lane, and the state from which it goes on.
pub(super) type Paused<C, const N: usize> = (Searched<C, N>, [f64; N]);

/// Periods with responses to changes, for Newton's iteration.
pub(super) struct Varying<'a, C, const N: usize, const K: usize> {
    pub(super) jobs: &'a dyn Jobs,
    pub(super) pending: Vec<Paused<C, N>>,
    pub(super) done: Vec<(Searched<C, N>, Next<N>)>,
}

impl<M: Ode<N>, const N: usize, const K: usize> Queue<Variation<'_, M, N>, Unobserved, K>
    for Varying<'_, M::Constants<f64>, N, K>
{
    /// The run, and the end of its period.
    type Run = (Searched<M::Constants<f64>, N>, Option<[f64; K]>);

    fn next(&mut self, _idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, K>> {
        let (run, y) = self.pending.pop()?;
        let start = run.search.responding(&run.start, &y);
        Some(((run, None), start))
    }

    fn span_end(&mut self, (_, end): &mut Self::Run, all: &[f64; K], (): &()) -> ControlFlow<()> {
        *end = Some(*all);
        ControlFlow::Break(())
    }

    fn ended(&mut self, (mut run, end): Self::Run, outcome: Outcome) -> Option<(Self::Run, Continuation<K>)> {
        let next = run.search.varied(end.as_ref(), outcome);
        if let Next::Vary(y) = next {
            let next = Continuation::from(&run.search.responding(&run.start, &y));
            return Some(((run, None), next));
        }
        self.done.push((run, next));
        None
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}

/// One period from each of many states.
pub(super) struct Periods<'a, C, T, const N: usize> {
    jobs: &'a dyn Jobs,
    /// The beginnings of the periods, by the position of their orbit.
    starts: Enumerate<IntoIter<Option<Start<C, N>>>>,
    pub(super) ended: Vec<PeriodEnd<T, N>>,
}

/// A period that has been integrated.
pub(super) struct PeriodEnd<T, const N: usize> {
    /// The position of its orbit.
    pub(super) position: usize,
    /// The state and the totals at its end, unless it failed.
    pub(super) end: Option<([f64; N], T)>,
    pub(super) outcome: Outcome,
}

impl<'a, C, T, const N: usize> Periods<'a, C, T, N> {
    /// Periods from `starts`, of which some may be missing. They are dropped when `jobs` is interrupted.
    pub(super) fn new(jobs: &'a dyn Jobs, starts: Vec<Option<Start<C, N>>>) -> Self {
        Periods { jobs, starts: starts.into_iter().enumerate(), ended: Vec::new() }
    }
}

impl<M: Ode<N>, V: Observer<M, N>, const N: usize> Queue<M, V, N>
    for Periods<'_, M::Constants<f64>, V::Totals<f64>, N>
{
    /// The period so far, which has no outcome yet: the position of its orbit, and its end.
    type Run = (usize, Option<([f64; N], V::Totals<f64>)>);

    fn next(&mut self, _idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, N>> {
        let found = self.starts.find_map(|(position, start)| Some((position, start?)));
        found.map(|(position, start)| ((position, None), start))
    }

    fn span_end(
        &mut self,
        (_, end): &mut Self::Run,
        y: &[f64; N],
        totals: &V::Totals<f64>,
    ) -> ControlFlow<()> {
        *end = Some((*y, *totals));
        ControlFlow::Break(())
    }

    fn ended(
        &mut self,
        (position, end): Self::Run,
        outcome: Outcome,
    ) -> Option<(Self::Run, Continuation<N>)> {
        self.ended.push(PeriodEnd { position, end, outcome });
        None
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}
