//! Points in SIMD lanes: march each until it is near its orbit, go there by Newton's iteration, measure one cycle.
//!
//! Three ensembles share the work. The first integrates the states alone, which is cheapest per step: it marches, makes
//! chord steps, and integrates the period at coarser tolerances that leads from an orbit to the coarse orbit. Runs that have
//! come near an orbit wait in a buffer. Whenever that is full, the second ensemble integrates their periods with responses
//! to changes. Runs whose orbit is known wait in another buffer, from which the third ensemble measures the orbits, and then
//! the coarse orbits. A run whose iteration fails marches on. A run whose row is not accurate enough waits in the first buffer
//! again.

use core::ops::ControlFlow;

use super::accuracy::{Verdict, judge};
use super::begin::begin;
use super::estimate::Compared;
use super::jobs::{Jobs, LaneUse, Point};
use super::orbit_row;
use super::queues::{Paused, PeriodEnd, Periods, Searched, Varying};
use super::row::Row;
use super::search::{Next, Search};
use super::settings::SolverSettings;
use crate::measure::cycle::Signals;
use crate::measure::size::Size;
use crate::model::Model;
use crate::num::{Kernel, Lanes, Simd, Vector};
use crate::ode::ensemble::{Continuation, NewRun, Observer, Queue, Unobserved, run};
use crate::ode::variation::Variation;
use crate::ode::{Outcome, Start};

/// Runs near their orbits that go on together: many times the lanes, some of which are empty while the last runs end.
const BATCH: usize = 256;

/// Points of other variants that are put aside before the ensemble is emptied for them: many more than there
/// are lanes, so that lanes are seldom empty.
const ASIDE: usize = 512;

/// The points of `jobs` on SIMD lanes, for a model with N states, K = N (N + 1) states and responses, and S signals.
pub(super) struct LanesKernel<'a, M, const N: usize, const K: usize, const S: usize> {
    pub(super) model: &'a M,
    pub(super) solver: &'a SolverSettings,
    pub(super) jobs: &'a mut dyn Jobs,
}

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Kernel for LanesKernel<'_, M, N, K, S> {
    type Output = ();

    #[inline(always)]
    fn run<I: Simd>(self, simd: I) {
        let LanesKernel { model, solver, jobs } = self;
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
                found: Vec::with_capacity(BATCH),
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

/// The queue of the first ensemble: points that march.
struct Marching<'a, I, M: Model<N, S>, const N: usize, const K: usize, const S: usize> {
    simd: I,
    model: &'a M,
    solver: &'a SolverSettings,
    jobs: &'a mut dyn Jobs,
    /// Points that have been taken from `jobs` and not been run, each with its variant.
    waiting: Vec<(M, Point)>,
    /// Runs that have come near an orbit, and the state from which their period is to be varied.
    near: Vec<Paused<M::Constants<f64>, N>>,
    /// Runs whose orbit is to be measured.
    found: Vec<Searched<M::Constants<f64>, N>>,
    /// Runs that go on marching, and the state from which they do.
    resumed: Vec<Paused<M::Constants<f64>, N>>,
    lane_use: LaneUse,
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
                // The source of points may be waiting for rows that wait here. With few of them most lanes would be
                // empty.
                if idle {
                    self.find_and_measure_all();
                } else if self.near.len() >= Vector::<I>::LANES {
                    self.vary();
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

    /// Goes on with the runs that wait for others, until some are to march or none waits any more. Measures last, when the
    /// most orbits have been found.
    fn find_and_measure_all(&mut self) {
        while self.resumed.is_empty() && !self.jobs.interrupted() {
            if !self.near.is_empty() {
                self.vary();
            } else if !self.found.is_empty() {
                self.measure();
            } else {
                break;
            }
        }
    }

    /// Puts a run where its next step is made. A run without one has its row.
    fn sort(&mut self, mut run: Searched<M::Constants<f64>, N>, next: Next<N>) {
        match next {
            Next::March(y) => self.resumed.push((run, y)),
            Next::Vary(y) => self.near.push((run, y)),
            Next::Measure => self.found.push(run),
            Next::Done => self.jobs.done(run.index, orbit_row::unsettled(&run.search, run.last.take())),
        }
    }

    /// Integrates periods with responses of the runs that wait for them.
    fn vary(&mut self) {
        let pending = std::mem::take(&mut self.near);
        let mut varying = Varying::<_, N, K> { jobs: &*self.jobs, pending, done: Vec::new() };
        let ode = Variation(self.model);
        self.lane_use.varying += run(self.simd, &ode, &Unobserved, &self.solver.tolerances(), &mut varying);
        let Varying { done, .. } = varying;
        if self.jobs.interrupted() {
            return;
        }
        for (run, next) in done {
            self.sort(run, next);
        }
    }

    /// Measures the orbits that have been found, and hands on their rows. Runs whose orbit turns out not to be one, or
    /// whose row is not accurate enough, go on.
    fn measure(&mut self) {
        let mut orbits = std::mem::take(&mut self.found);
        let fine = orbits.iter().map(|run| run.search.orbit(&run.start)).collect();
        let mut compared = vec![Compared::new(); orbits.len()];
        let mut next = vec![None; orbits.len()];
        let signals = Signals::all(self.model).with_loads(self.solver.loads);
        for PeriodEnd { position, end, outcome } in self.periods(&signals, fine) {
            let search = &mut orbits[position].search;
            search.charge(outcome);
            next[position] = search.confirm(end.as_ref().map(|(y, _)| y));
            compared[position].take_fine(end.map(|(_, totals)| totals), outcome);
        }
        let coarse = orbits.iter().zip(&next).map(|(run, next)| match next {
            None => run.search.coarse_orbit(&run.start),
            Some(_) => None,
        });
        let coarse = coarse.collect();
        for PeriodEnd { position, end, outcome } in self.periods(&Signals::means(self.model), coarse) {
            orbits[position].search.charge(outcome);
            compared[position].coarse = end.map(|(_, totals)| totals);
        }
        if self.jobs.interrupted() {
            return;
        }
        for ((mut run, next), compared) in orbits.into_iter().zip(next).zip(compared) {
            if let Some(next) = next {
                self.sort(run, next);
                continue;
            }
            let Searched { index, start, search, last } = &mut run;
            match judge(search, self.model, start, &compared, last.take(), self.solver) {
                Verdict::Done(row) => self.jobs.done(*index, row),
                Verdict::Again(row, y) => {
                    *last = Some(row);
                    self.near.push((run, y));
                }
            }
        }
    }

    /// Integrates a period from each start, as far as there are any, and observes it.
    fn periods<V: Observer<M, N>>(
        &mut self,
        observer: &V,
        starts: Vec<Option<Start<M::Constants<f64>, N>>>,
    ) -> Vec<PeriodEnd<V::Totals<f64>, N>> {
        let mut queue = Periods::new(&*self.jobs, starts);
        self.lane_use.measuring +=
            run(self.simd, self.model, observer, &self.solver.tolerances(), &mut queue);
        queue.ended
    }
}

impl<I: Simd, M: Model<N, S>, const N: usize, const K: usize, const S: usize> Queue<M, Size, N>
    for Marching<'_, I, M, N, K, S>
{
    type Run = Searched<M::Constants<f64>, N>;

    fn next(&mut self, idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, N>> {
        if let Some((run, y)) = self.resumed.pop() {
            let start = run.search.marching(&run.start, &y);
            return Some((run, start));
        }
        loop {
            let point = self.next_point(idle)?;
            match begin(self.model, &point.values, point.begin.as_deref()) {
                Ok(start) => {
                    let search = Search::new(&start, self.solver, point.begin.is_some());
                    let first = search.marching(&start, &start.y);
                    return Some((Searched { index: point.index, start, search, last: None }, first));
                }
                Err(error) => self.jobs.done(point.index, Row::invalid(error)),
            }
        }
    }

    fn span_end(&mut self, run: &mut Self::Run, y: &[f64; N], largest: &[f64; N]) -> ControlFlow<()> {
        run.search.period_end(y, largest)
    }

    fn ended(&mut self, mut run: Self::Run, outcome: Outcome) -> Option<(Self::Run, Continuation<N>)> {
        let next = run.search.marched(outcome);
        if let Next::March(y) = next {
            let next = Continuation::from(&run.search.marching(&run.start, &y));
            return Some((run, next));
        }
        self.sort(run, next);
        if self.near.len() >= BATCH {
            self.vary();
        }
        if self.found.len() >= BATCH {
            self.measure();
        }
        None
    }

    fn interrupted(&self) -> bool {
        self.jobs.interrupted()
    }
}
