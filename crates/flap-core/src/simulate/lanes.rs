//! Points in SIMD lanes: march each until it is near its orbit, go there by Newton's iteration, measure one cycle.
//!
//! Three ensembles share the work. The first marches, and nothing else, which is cheapest per step; runs that have come
//! near an orbit wait in a buffer, and whenever that is full the second ensemble integrates their periods with responses
//! to changes, and the third measures the orbits found. A run whose iteration fails marches on.

use core::ops::ControlFlow;

use super::row;
use super::search::{Next, Search, begin, varied};
use super::simulator::{Jobs, LaneUse, Point, Row, SolverSettings};
use crate::measure::cycle::{Signals, Totals};
use crate::model::Model;
use crate::num::{Kernel, Lanes, Simd, Vector};
use crate::ode::ensemble::{NewRun, Queue, Unobserved, run};
use crate::ode::variation::Variation;
use crate::ode::{Ode, Outcome, Start};

/// Runs near their orbits that go on together: many times the lanes, some of which are empty while the last runs end.
const BATCH: usize = 256;

/// Points of other variants that are put aside before the ensemble is emptied for them: many more than there
/// are lanes, so that lanes are seldom empty.
const ASIDE: usize = 512;

/// The points of `jobs` on SIMD lanes.
pub(super) struct LanesKernel<'a, M> {
    pub(super) model: &'a M,
    pub(super) solver: &'a SolverSettings,
    pub(super) jobs: &'a mut dyn Jobs,
}

/// [`LanesKernel`] with the sizes of its model.
pub(super) struct Sized<W, const N: usize, const K: usize, const S: usize>(pub(super) W);

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Kernel
    for Sized<LanesKernel<'_, M>, N, K, S>
{
    type Output = ();

    #[inline(always)]
    fn run<I: Simd>(self, simd: I) {
        let LanesKernel { model, solver, jobs } = self.0;
        let tolerances = solver.tolerances();
        let mut waiting: Vec<(M, Point)> = Vec::new();
        let mut lane_use = LaneUse::default();
        // One ensemble per variant, until no points are left.
        loop {
            if waiting.is_empty() {
                let Some(point) = jobs.next(true) else { break };
                waiting.push((model.variant(&point.values), point));
            }
            let model = &model.variant(&waiting[0].1.values);
            let mut marching = Marching::<_, _, N, K, S> {
                simd,
                model,
                solver,
                jobs: &mut *jobs,
                waiting,
                near: Vec::with_capacity(BATCH),
                resumed: Vec::with_capacity(BATCH),
                lane_use,
            };
            // Runs whose iteration fails at the very end march on.
            loop {
                let occupancy = run(simd, model, &Unobserved, &tolerances, &mut marching);
                marching.lane_use.marching += occupancy;
                marching.find_and_measure();
                if marching.resumed.is_empty() || marching.jobs.interrupted() {
                    break;
                }
            }
            Marching { waiting, lane_use, .. } = marching;
            if jobs.interrupted() {
                break;
            }
        }
        jobs.occupied(&lane_use);
    }
}

/// The queue of the first ensemble.
struct Marching<'a, I, M: Model<N, S>, const N: usize, const K: usize, const S: usize> {
    simd: I,
    model: &'a M,
    solver: &'a SolverSettings,
    jobs: &'a mut dyn Jobs,
    /// Points that have been taken from `jobs` and not been run, each with its variant.
    waiting: Vec<(M, Point)>,
    /// Runs that have come near an orbit, and the state from which their period is to be varied.
    near: Vec<Paused<M::Constants<f64>, N>>,
    /// Runs whose iteration has failed, and the state from which they march on.
    resumed: Vec<Paused<M::Constants<f64>, N>>,
    lane_use: LaneUse,
}

/// A run that is in no lane, and the state from which it goes on.
type Paused<C, const N: usize> = (Searched<C, N>, [f64; N]);

/// A run on its way to its orbit.
struct Searched<C, const N: usize> {
    index: u64,
    start: Start<C, N>,
    search: Search<N>,
}

impl<I: Simd, M: Model<N, S>, const N: usize, const K: usize, const S: usize> Marching<'_, I, M, N, K, S> {
    /// The next point of this ensemble's variant. Those of others are put aside, up to a limit.
    fn next_point(&mut self, idle: bool) -> Option<Point> {
        if let Some(ours) = self.waiting.iter().position(|(variant, _)| variant == self.model) {
            return Some(self.waiting.remove(ours).1);
        }
        while self.waiting.len() < ASIDE {
            let point = if let Some(point) = self.jobs.next(false) {
                point
            } else {
                // Whoever hands out points may be waiting for rows that wait here. With few of them most lanes would be empty.
                if idle || self.near.len() >= Vector::<I>::LANES {
                    self.find_and_measure();
                }
                // Runs that march on and points put aside are to run before this one waits for more.
                if !idle || !self.waiting.is_empty() || !self.resumed.is_empty() {
                    return None;
                }
                self.jobs.next(true)?
            };
            let variant = self.model.variant(&point.values);
            if variant == *self.model {
                return Some(point);
            }
            self.waiting.push((variant, point));
        }
        None
    }

    /// Finds the orbits of the runs that are near them, measures those, and hands on their rows.
    fn find_and_measure(&mut self) {
        if self.near.is_empty() {
            return;
        }
        let tolerances = self.solver.tolerances();
        let pending = std::mem::take(&mut self.near);
        let mut varying = Varying::<_, N, K> { jobs: &*self.jobs, pending, done: Vec::new() };
        self.lane_use.varying +=
            run(self.simd, &Variation(self.model), &Unobserved, &tolerances, &mut varying);
        let Varying { pending, done, .. } = varying;
        let mut orbits = Vec::new();
        for (run, next) in done {
            match (next, row::unmeasured(&run.search)) {
                (Next::March(y), _) => self.resumed.push((run, y)),
                (_, Some(row)) => self.jobs.done(run.index, row),
                (_, None) => orbits.push(run),
            }
        }
        self.near = pending;
        let mut measuring =
            Measuring { model: self.model, jobs: &mut *self.jobs, orbits: orbits.into_iter() };
        self.lane_use.measuring += run(self.simd, self.model, &Signals::<S>, &tolerances, &mut measuring);
    }
}

impl<I: Simd, M: Model<N, S>, const N: usize, const K: usize, const S: usize> Queue<M, Unobserved, N>
    for Marching<'_, I, M, N, K, S>
{
    type Run = Searched<M::Constants<f64>, N>;

    fn next(&mut self, idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, N>> {
        if let Some((run, y)) = self.resumed.pop() {
            let start = Start { y, ..run.start };
            return Some((run, start));
        }
        loop {
            let point = self.next_point(idle)?;
            match begin(self.model, &point.values, point.begin.as_deref()) {
                Ok(start) => {
                    let search = Search::new(&start, self.solver, point.begin.is_some());
                    return Some((Searched { index: point.index, start, search }, start));
                }
                Err(error) => self.jobs.done(point.index, Row::invalid(error)),
            }
        }
    }

    fn span_end(&mut self, run: &mut Self::Run, y: &[f64; N], (): &()) -> ControlFlow<()> {
        run.search.period_end(y)
    }

    fn ended(&mut self, mut run: Self::Run, outcome: Outcome) {
        match run.search.marched(outcome) {
            Next::Vary(y) => self.near.push((run, y)),
            Next::March(y) => self.resumed.push((run, y)),
            Next::Done => {
                if let Some(row) = row::unmeasured(&run.search) {
                    self.jobs.done(run.index, row);
                }
            }
        }
        if self.near.len() == BATCH {
            self.find_and_measure();
        }
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}

/// The queue of the second ensemble.
struct Varying<'a, C, const N: usize, const K: usize> {
    jobs: &'a dyn Jobs,
    pending: Vec<Paused<C, N>>,
    done: Vec<(Searched<C, N>, Next<N>)>,
}

impl<M: Ode<N>, const N: usize, const K: usize> Queue<Variation<'_, M, N>, Unobserved, K>
    for Varying<'_, M::Constants<f64>, N, K>
{
    /// The run, and the end of its period.
    type Run = (Searched<M::Constants<f64>, N>, Option<[f64; K]>);

    fn next(&mut self, _idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, K>> {
        let (run, y) = self.pending.pop()?;
        let start = varied(&run.start, &y);
        Some(((run, None), start))
    }

    fn span_end(&mut self, (_, end): &mut Self::Run, all: &[f64; K], (): &()) -> ControlFlow<()> {
        *end = Some(*all);
        ControlFlow::Break(())
    }

    fn ended(&mut self, (mut run, end): Self::Run, outcome: Outcome) {
        match run.search.varied(end.as_ref(), outcome) {
            Next::Vary(y) => self.pending.push((run, y)),
            next => self.done.push((run, next)),
        }
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}

/// The queue of the third ensemble.
struct Measuring<'a, Q, M> {
    model: &'a M,
    jobs: &'a mut dyn Jobs,
    orbits: Q,
}

/// A run whose cycle is being measured.
struct Measured<C, const N: usize, const S: usize> {
    run: Searched<C, N>,
    totals: Option<[Totals<f64>; S]>,
}

impl<M, Q, const N: usize, const S: usize> Queue<M, Signals<S>, N> for Measuring<'_, Q, M>
where
    M: Model<N, S>,
    Q: Iterator<Item = Searched<M::Constants<f64>, N>>,
{
    type Run = Measured<M::Constants<f64>, N, S>;

    fn next(&mut self, _idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, N>> {
        let run = self.orbits.next()?;
        let y = run.search.orbit().map_or(run.start.y, |orbit| orbit.y);
        let start = Start { y, ..run.start };
        Some((Measured { run, totals: None }, start))
    }

    fn span_end(&mut self, run: &mut Self::Run, _y: &[f64; N], totals: &[Totals<f64>; S]) -> ControlFlow<()> {
        run.totals = Some(*totals);
        ControlFlow::Break(())
    }

    fn ended(&mut self, measured: Self::Run, outcome: Outcome) {
        let Measured { run: Searched { index, start, search }, totals } = measured;
        let row = row::measured(&search, self.model, &start.constants, start.span, totals.as_ref(), outcome);
        self.jobs.done(index, row);
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}
