//! Points in SIMD lanes: march each until it settles, then measure one cycle on its orbit.
//!
//! Two ensembles share the work. The first marches without measuring, which is cheaper per step; runs that
//! have settled wait in a buffer, and whenever that is full the second ensemble measures them together.

use core::ops::ControlFlow;

use fearless_simd::Simd;

use super::row::{Settled, invalid};
use super::simulator::{Jobs, Point, SolverSettings};
use crate::measure::cycle::{Signals, Totals};
use crate::measure::strobe::Strobe;
use crate::model::Model;
use crate::num::Kernel;
use crate::ode::ensemble::{NewRun, Queue, Unobserved, run};
use crate::ode::{Outcome, Start};

/// Settled runs measured together: enough to keep 16 lanes full, few enough to hand rows on soon.
const BATCH: usize = 64;

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
pub(super) struct Sized<K, const N: usize, const S: usize>(pub(super) K);

impl<M: Model<N, S>, const N: usize, const S: usize> Kernel for Sized<LanesKernel<'_, M>, N, S> {
    type Output = ();

    #[inline(always)]
    fn run<I: Simd>(self, simd: I) {
        let LanesKernel { model, solver, jobs } = self.0;
        let tolerances = solver.tolerances();
        let mut waiting: Vec<(M, Point)> = Vec::new();
        // One ensemble per variant, until no points are left.
        loop {
            if waiting.is_empty() {
                let Some(point) = jobs.next(true) else { return };
                waiting.push((model.variant(&point.values), point));
            }
            let model = &model.variant(&waiting[0].1.values);
            let settled = Vec::with_capacity(BATCH);
            let mut marching = Marching { simd, model, solver, jobs: &mut *jobs, waiting, settled };
            run(simd, model, &Unobserved, &tolerances, &mut marching);
            marching.measure();
            waiting = marching.waiting;
        }
    }
}

/// The queue of the first ensemble.
struct Marching<'a, I, M: Model<N, S>, const N: usize, const S: usize> {
    simd: I,
    model: &'a M,
    solver: &'a SolverSettings,
    jobs: &'a mut dyn Jobs,
    /// Points that have been taken from `jobs` and not been run, each with its variant.
    waiting: Vec<(M, Point)>,
    settled: Vec<Orbit<M::Constants<f64>, N>>,
}

/// A run on its way to its orbit.
struct March<C, const N: usize> {
    index: u64,
    start: Start<C, N>,
    strobe: Strobe<N>,
    period: Option<u32>,
}

/// A run that has settled.
struct Orbit<C, const N: usize> {
    index: u64,
    start: Start<C, N>,
    settled: Settled<N>,
}

impl<I: Simd, M: Model<N, S>, const N: usize, const S: usize> Marching<'_, I, M, N, S> {
    /// The next point of this ensemble's variant. Those of others are put aside, up to a limit.
    fn next_point(&mut self, idle: bool) -> Option<Point> {
        if let Some(ours) = self.waiting.iter().position(|(variant, _)| variant == self.model) {
            return Some(self.waiting.remove(ours).1);
        }
        while self.waiting.len() < ASIDE {
            let point = if let Some(point) = self.jobs.next(false) {
                point
            } else {
                // Whoever hands out points may be waiting for rows that wait here.
                self.measure();
                // Points put aside are to run before this one waits for more.
                if !idle || !self.waiting.is_empty() {
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

    /// Measures the runs that have settled and hands on their rows.
    fn measure(&mut self) {
        if self.settled.is_empty() {
            return;
        }
        let tolerances = self.solver.tolerances();
        let mut measuring =
            Measuring { model: self.model, jobs: &mut *self.jobs, orbits: self.settled.drain(..) };
        run(self.simd, self.model, &Signals::<S>, &tolerances, &mut measuring);
    }
}

impl<I: Simd, M: Model<N, S>, const N: usize, const S: usize> Queue<M, Unobserved, N>
    for Marching<'_, I, M, N, S>
{
    type Run = March<M::Constants<f64>, N>;

    fn next(&mut self, idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, N>> {
        loop {
            let point = self.next_point(idle)?;
            match self.model.start(&point.values) {
                Ok(start) => {
                    let strobe = Strobe::new(&start.y, &start.scale, self.solver.settle_tol);
                    return Some((March { index: point.index, start, strobe, period: None }, start));
                }
                Err(error) => self.jobs.done(point.index, invalid(error)),
            }
        }
    }

    fn span_end(&mut self, march: &mut Self::Run, y: &[f64; N], (): &()) -> ControlFlow<()> {
        march.period = march.strobe.period_end(y);
        if march.period.is_some() || march.strobe.cycles() >= self.solver.max_cycles {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    fn ended(&mut self, march: Self::Run, outcome: Outcome) {
        let March { index, mut start, strobe, period } = march;
        let settled = Settled { strobe, period, outcome };
        if let Some(row) = settled.unmeasured() {
            self.jobs.done(index, row);
            return;
        }
        start.y = *strobe.state();
        self.settled.push(Orbit { index, start, settled });
        if self.settled.len() == BATCH {
            self.measure();
        }
    }
}

/// The queue of the second ensemble.
struct Measuring<'a, Q, M> {
    model: &'a M,
    jobs: &'a mut dyn Jobs,
    orbits: Q,
}

/// A run whose cycle is being measured.
struct Measured<C, const N: usize, const S: usize> {
    orbit: Orbit<C, N>,
    totals: Option<[Totals<f64>; S]>,
}

impl<M, Q, const N: usize, const S: usize> Queue<M, Signals<S>, N> for Measuring<'_, Q, M>
where
    M: Model<N, S>,
    Q: Iterator<Item = Orbit<M::Constants<f64>, N>>,
{
    type Run = Measured<M::Constants<f64>, N, S>;

    fn next(&mut self, _idle: bool) -> Option<NewRun<Self::Run, M::Constants<f64>, N>> {
        let orbit = self.orbits.next()?;
        let start = orbit.start;
        Some((Measured { orbit, totals: None }, start))
    }

    fn span_end(&mut self, run: &mut Self::Run, _y: &[f64; N], totals: &[Totals<f64>; S]) -> ControlFlow<()> {
        run.totals = Some(*totals);
        ControlFlow::Break(())
    }

    fn ended(&mut self, run: Self::Run, outcome: Outcome) {
        let Orbit { index, start, settled } = run.orbit;
        let row = settled.measured(self.model, &start.constants, start.span, run.totals.as_ref(), outcome);
        self.jobs.done(index, row);
    }
}
