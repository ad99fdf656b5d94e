//! Points in SIMD lanes: march each until it is near its orbit, go there by Newton's iteration, measure one cycle.
//!
//! Four ensembles share the work. The first marches, and nothing else, which is cheapest per step; runs that have come
//! near an orbit wait in a buffer, and whenever that is full the second ensemble integrates their periods with responses
//! to changes, the third a period of each orbit with coarser tolerances, and the fourth measures both orbits. A run whose
//! iteration fails marches on; a run whose row is not accurate enough waits in the buffer again.

use core::ops::ControlFlow;

use super::accuracy::{Compared, Verdict, judge};
use super::row;
use super::search::{Next, Search, begin};
use super::simulator::{Jobs, LaneUse, Point, Row, SolverSettings};
use crate::measure::cycle::{Signals, Totals};
use crate::measure::size::Size;
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
                let occupancy = run(simd, model, &Size, &tolerances, &mut marching);
                marching.lane_use.marching += occupancy;
                marching.find_and_measure_all();
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
    /// The row from an orbit that is being found again, more exactly.
    last: Option<Row>,
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
                if idle {
                    self.find_and_measure_all();
                } else if self.near.len() >= Vector::<I>::LANES {
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

    /// Finds the orbits of all runs that are near them, and hands on their rows.
    fn find_and_measure_all(&mut self) {
        while !self.near.is_empty() && !self.jobs.interrupted() {
            self.find_and_measure();
        }
    }

    /// Finds the orbits of the runs that are near them, measures those, and hands on their rows. Runs whose rows are not
    /// accurate enough stay.
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
        if self.jobs.interrupted() {
            return;
        }
        let mut orbits = Vec::new();
        for (mut run, next) in done {
            match (next, run.search.orbit()) {
                (Next::March(y), _) => self.resumed.push((run, y)),
                (_, Some(_)) => orbits.push(run),
                (_, None) => self.jobs.done(run.index, row::unsettled(&run.search, run.last.take())),
            }
        }
        self.near = pending;

        let mut departing = Departing { jobs: &*self.jobs, orbits: &mut orbits, next: 0, ends: Vec::new() };
        self.lane_use.measuring += run(self.simd, self.model, &Unobserved, &tolerances, &mut departing);
        let ends = departing.ends;
        let mut periods = vec![Compared::new(); orbits.len()];
        for (signals, is_coarse) in [(Signals::ALL, false), (Signals::MEANS, true)] {
            let starts = orbits.iter().zip(&ends).enumerate().filter_map(|(position, (run, end))| {
                let orbit = run.search.orbit()?;
                let start = if is_coarse {
                    run.search.coarse(&run.start, &run.search.coarse_orbit(end.as_ref()?)?)
                } else {
                    run.search.start(&run.start, &orbit.y)
                };
                Some((position, start))
            });
            let mut measuring = Measuring {
                jobs: &*self.jobs,
                starts: starts.collect::<Vec<_>>().into_iter(),
                orbits: &mut orbits,
                periods: &mut periods,
                is_coarse,
            };
            self.lane_use.measuring += run(self.simd, self.model, &signals, &tolerances, &mut measuring);
        }
        if self.jobs.interrupted() {
            return;
        }
        for (mut run, periods) in orbits.into_iter().zip(periods) {
            let Searched { index, start, search, last } = &mut run;
            match judge(search, self.model, start, &periods, last.take(), self.solver.accuracy) {
                Verdict::Done(row) => self.jobs.done(*index, row),
                Verdict::Again(row, y) => {
                    *last = Some(row);
                    self.near.push((run, y));
                }
            }
        }
    }
}

impl<I: Simd, M: Model<N, S>, const N: usize, const K: usize, const S: usize> Queue<M, Size, N>
    for Marching<'_, I, M, N, K, S>
{
    type Run = Searched<M::Constants<f64>, N>;

    fn next(&mut self, idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, N>> {
        if let Some((run, y)) = self.resumed.pop() {
            let start = run.search.start(&run.start, &y);
            return Some((run, start));
        }
        loop {
            let point = self.next_point(idle)?;
            match begin(self.model, &point.values, point.begin.as_deref()) {
                Ok(start) => {
                    let search = Search::new(&start, self.solver, point.begin.is_some());
                    return Some((Searched { index: point.index, start, search, last: None }, start));
                }
                Err(error) => self.jobs.done(point.index, Row::invalid(error)),
            }
        }
    }

    fn span_end(&mut self, run: &mut Self::Run, y: &[f64; N], largest: &[f64; N]) -> ControlFlow<()> {
        run.search.period_end(y, largest)
    }

    fn ended(&mut self, mut run: Self::Run, outcome: Outcome) {
        match run.search.marched(outcome) {
            Next::Vary(y) => self.near.push((run, y)),
            Next::March(y) => self.resumed.push((run, y)),
            Next::Done => self.jobs.done(run.index, row::unsettled(&run.search, None)),
        }
        if self.near.len() >= BATCH {
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
        let start = run.search.responding(&run.start, &y);
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

/// The queue of the third ensemble: a period of each orbit with coarser tolerances, which leads away from it.
struct Departing<'a, C, const N: usize> {
    jobs: &'a dyn Jobs,
    orbits: &'a mut [Searched<C, N>],
    next: usize,
    /// Ends of the periods, by the position of their orbit.
    ends: Vec<Option<[f64; N]>>,
}

impl<M: Ode<N>, const N: usize> Queue<M, Unobserved, N> for Departing<'_, M::Constants<f64>, N> {
    /// The orbit's position.
    type Run = usize;

    fn next(&mut self, _idle: bool) -> Option<NewRun<usize, M::Constants<f64>, N>> {
        let run = self.orbits.get(self.next)?;
        let y = run.search.orbit().map_or(run.start.y, |orbit| orbit.y);
        self.ends.push(None);
        self.next += 1;
        Some((self.next - 1, run.search.coarse(&run.start, &y)))
    }

    fn span_end(&mut self, position: &mut usize, y: &[f64; N], (): &()) -> ControlFlow<()> {
        self.ends[*position] = Some(*y);
        ControlFlow::Break(())
    }

    fn ended(&mut self, position: usize, outcome: Outcome) {
        self.orbits[position].search.charge(outcome);
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}

/// The queue of the fourth ensemble: a period of each orbit, or one of the orbit that coarser tolerances have.
struct Measuring<'a, Q, C, const N: usize, const S: usize> {
    jobs: &'a dyn Jobs,
    /// The beginnings of the periods, each with the position of its orbit.
    starts: Q,
    orbits: &'a mut [Searched<C, N>],
    /// The totals of the periods, by the position of their orbit.
    periods: &'a mut [Compared<S>],
    is_coarse: bool,
}

/// A period that is being measured.
struct Measured<const S: usize> {
    position: usize,
    totals: Option<[Totals<f64>; S]>,
}

impl<M, Q, const N: usize, const S: usize> Queue<M, Signals<S>, N>
    for Measuring<'_, Q, M::Constants<f64>, N, S>
where
    M: Model<N, S>,
    Q: Iterator<Item = (usize, Start<M::Constants<f64>, N>)>,
{
    type Run = Measured<S>;

    fn next(&mut self, _idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, N>> {
        let (position, start) = self.starts.next()?;
        Some((Measured { position, totals: None }, start))
    }

    fn span_end(&mut self, run: &mut Self::Run, _y: &[f64; N], totals: &[Totals<f64>; S]) -> ControlFlow<()> {
        run.totals = Some(*totals);
        ControlFlow::Break(())
    }

    fn ended(&mut self, Measured { position, totals }: Self::Run, outcome: Outcome) {
        self.orbits[position].search.charge(outcome);
        let periods = &mut self.periods[position];
        if self.is_coarse {
            periods.coarse = totals;
        } else {
            periods.take_fine(totals, outcome);
        }
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}
