//! Runs the searches of many points, and integrates the drive periods of these searches in SIMD lanes.
//!
//! A search is a future that requests the integration of a drive period and waits for the result. Periods of
//! different [kinds](Kind) are integrated by different ensembles, so that lanes integrate no unnecessary
//! quantities.
//!
//! In most periods, only the states are integrated. One ensemble integrates these periods. When a lane of
//! this ensemble becomes free, the ensemble starts the search of a new point. If a search requests more than
//! the states, the search waits until many searches request the same quantities, or until no lane has work. A
//! second ensemble then integrates the periods of the searches that wait. Meanwhile, the first ensemble
//! pauses the periods in its lanes.
//!
//! The same code runs the search of a single point, with one scalar instead of SIMD lanes.

use core::cell::{Cell, RefCell};
use core::pin::Pin;
use core::task::{Context, Waker};
use std::collections::VecDeque;
use std::rc::Rc;

use super::jobs::{Jobs, LaneUse, Point};
use super::periods::{Exchange, Kind, PeriodEnd};
use super::row::Row;
use super::search::settle;
use super::settings::SolverSettings;
use super::start::start_at;
use crate::measure::cycle::{SignalObserver, SumsOf};
use crate::measure::multipliers::monodromy;
use crate::measure::size::Size;
use crate::model::Model;
use crate::num::{Kernel, Lanes, OneLane, Scalar, Simd, Vector};
use crate::ode::ensemble::{
    MOST_LANES, Next, Observer, Occupancy, Queue, Restart, SpanEnd, Unobserved, run, run_with_responses,
};
use crate::ode::{Interrupt, Start};

/// If this number of searches wait for periods of one kind, the periods are integrated together.
///
/// With far more searches than lanes, lanes are empty only for a small part of the time, while the last
/// periods end.
const BATCH: usize = 128;

/// Largest number of points that wait because the form of their equations differs from the equations that are
/// being integrated.
///
/// With far more points than lanes, lanes are seldom empty.
const ASIDE: usize = 512;

/// Kernel that runs the points of `jobs` on SIMD lanes, for a model with N states.
pub(super) struct LanesKernel<'a, M, const N: usize> {
    pub(super) model: &'a M,
    pub(super) solver: &'a SolverSettings,
    pub(super) jobs: &'a mut dyn Jobs,
}

impl<M: Model<N>, const N: usize> Kernel for LanesKernel<'_, M, N> {
    type Output = ();

    #[inline(always)]
    fn run<I: Simd>(self, simd: I) {
        let LanesKernel { model, solver, jobs } = self;
        let jobs = RefCell::new(jobs);
        let interrupted = || jobs.borrow().interrupted();
        let mut waiting: Vec<(M, Point)> = Vec::new();
        let mut lane_use = LaneUse::default();
        // One driver per variant, until no points are left.
        while !interrupted() {
            if waiting.is_empty() {
                let Some(point) = jobs.borrow_mut().next(true) else { break };
                waiting.push((model.variant(&point.values), point));
            }
            let model = &model.variant(&waiting[0].1.values);
            let mut next = |idle| loop {
                let Point { index, values, begin } = next_point(model, &jobs, &mut waiting, idle)?;
                match start_at(model, solver, &values, begin.as_deref()) {
                    Ok(start) => {
                        let (jobs, nearby) = (&jobs, begin.is_some());
                        let search = |exchange| {
                            let settled = settle(model, solver, nearby, exchange);
                            async move {
                                let row = settled.await.row;
                                jobs.borrow_mut().done(index, row);
                            }
                        };
                        return Some(Running::new(start, search));
                    }
                    Err(error) => jobs.borrow_mut().done(index, Row::invalid(error)),
                }
            };
            let mut driver = Driver::<_, _, N>::new(simd, model, solver, &mut next, &interrupted);
            driver.lane_use = lane_use;
            driver.run();
            lane_use = driver.lane_use;
        }
        jobs.into_inner().occupied(&lane_use);
    }
}

/// Returns the next point whose equations have the form that `model` selects (see [`Model::variant`]). Points
/// whose equations have a different form are added to `waiting`, up to a limit.
fn next_point<M: Model<N>, const N: usize>(
    model: &M,
    jobs: &RefCell<&mut dyn Jobs>,
    waiting: &mut Vec<(M, Point)>,
    idle: bool,
) -> Option<Point> {
    if let Some(ours) = waiting.iter().position(|(variant, _)| variant == model) {
        return Some(waiting.remove(ours).1);
    }
    while waiting.len() < ASIDE {
        // While points are set aside, the call does not wait for more.
        let point = jobs.borrow_mut().next(idle && waiting.is_empty())?;
        let variant = model.variant(&point.values);
        if variant == *model {
            return Some(point);
        }
        waiting.push((variant, point));
    }
    None
}

/// Returns the output of one search on scalars from `start`, or `None` if the search is interrupted.
pub(super) fn run_alone<M, R, T, F, const N: usize>(
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    interrupted: Interrupt<'_>,
    search: impl FnOnce(Rc<Exchange<M, N>>) -> F,
) -> Option<T>
where
    M: Model<N>,
    R: Scalar,
    F: Future<Output = T>,
{
    let output = Cell::new(None);
    let search = |exchange| {
        let (search, output) = (search(exchange), &output);
        async move { output.set(Some(search.await)) }
    };
    let mut run = Some(Running::new(*start, search));
    Driver::<_, _, N>::new(OneLane::<R>::new(), model, solver, &mut |_| run.take(), interrupted).run();
    output.take()
}

/// A search that is in progress. The future `search` has no output, because it stores the result of the
/// search.
struct Running<'a, M: Model<N>, const N: usize> {
    exchange: Rc<Exchange<M, N>>,
    search: Pin<Box<dyn Future<Output = ()> + 'a>>,
}

impl<'a, M: Model<N>, const N: usize> Running<'a, M, N> {
    fn new<F: Future<Output = ()> + 'a>(
        start: Start<M::Constants<f64>, N>,
        search: impl FnOnce(Rc<Exchange<M, N>>) -> F,
    ) -> Self {
        let exchange = Rc::new(Exchange::new(start));
        Running { search: Box::pin(search(exchange.clone())), exchange }
    }
}

/// Source of searches.
///
/// Returns the next search, or `None` if no search is available at present. If the argument `idle` is true,
/// the call may wait for a search, and `None` means that no search is left.
type Source<'s, 'a, M, const N: usize> = &'s mut dyn FnMut(bool) -> Option<Running<'a, M, N>>;

/// The driver of searches: it continues the searches, and integrates the periods that the searches request.
struct Driver<'a, 's, I, M: Model<N>, const N: usize> {
    simd: I,
    model: &'a M,
    solver: &'a SolverSettings,
    source: Source<'s, 'a, M, N>,
    interrupted: Interrupt<'s>,
    /// For each kind of period, the searches that wait for a period. The search that has waited longest
    /// continues first.
    waiting: [VecDeque<Running<'a, M, N>>; 4],
    lane_use: LaneUse,
}

impl<'a, 's, I: Simd, M: Model<N>, const N: usize> Driver<'a, 's, I, M, N> {
    fn new(
        simd: I,
        model: &'a M,
        solver: &'a SolverSettings,
        source: Source<'s, 'a, M, N>,
        interrupted: Interrupt<'s>,
    ) -> Self {
        let waiting = core::array::from_fn(|_| VecDeque::with_capacity(2 * BATCH));
        Driver { simd, model, solver, source, interrupted, waiting, lane_use: LaneUse::default() }
    }

    /// Runs all searches that the source of searches provides.
    fn run(&mut self) {
        loop {
            self.integrate_batch(Kind::States);
            self.integrate_others();
            // Searches that fail at the very end may return to marching.
            if self.waiting[Kind::States as usize].is_empty() || (self.interrupted)() {
                return;
            }
        }
    }

    /// Integrates the requested periods of all kinds except [`Kind::States`]. The function returns when a
    /// search requests a period of [`Kind::States`], or when no search waits.
    fn integrate_others(&mut self) {
        while self.waiting[Kind::States as usize].is_empty() && !(self.interrupted)() {
            let Some(other) = self.other_that_waits(1) else { return };
            self.integrate_batch(other);
        }
    }

    /// Returns a kind of period, except [`Kind::States`], for which at least the given number of searches
    /// wait.
    ///
    /// Kinds with sums over the signals are returned last, so that many orbits have been found before the
    /// measures are integrated.
    fn other_that_waits(&self, searches: usize) -> Option<Kind> {
        let mut others = Kind::ALL.into_iter().skip(1);
        others.find(|&kind| self.waiting[kind as usize].len() >= searches)
    }

    fn integrate_batch(&mut self, kind: Kind) {
        let used = self.integrate(kind);
        match kind {
            Kind::States => self.lane_use.marching += used,
            Kind::Responses => self.lane_use.varying += used,
            Kind::Means | Kind::Signals => self.lane_use.measuring += used,
        }
    }

    /// Integrates periods of one kind until no search waits for a period of this kind.
    fn integrate(&mut self, kind: Kind) -> Occupancy {
        let (simd, model, tolerances) = (self.simd, self.model, self.solver.tolerances());
        let loads = self.solver.loads;
        match kind {
            Kind::States => {
                let mut periods = self.periods(kind, |size, end, _| end.largest = *size);
                run(simd, model, &Size, &tolerances, &mut periods)
            }
            Kind::Responses => {
                let mut periods = self.periods(kind, |(), _, _| {});
                run_with_responses(simd, model, &Unobserved, &tolerances, &mut periods)
            }
            Kind::Means | Kind::Signals => {
                let all = SignalObserver::all(model).with_loads(loads);
                let signals = if kind == Kind::Means { SignalObserver::means(model) } else { all };
                let mut periods =
                    self.periods(kind, |sums, end, exchange| end.sums = Some(exchange.boxed(*sums)));
                run(simd, model, &signals, &tolerances, &mut periods)
            }
        }
    }

    /// Returns the queue of periods of one kind. The function `store` stores the totals over a period in the
    /// [`PeriodEnd`] of the period.
    fn periods<'d, V>(&'d mut self, kind: Kind, store: Store<V, M, N>) -> Periods<'a, 's, 'd, I, M, V, N> {
        Periods { driver: self, kind, store, runs: [const { None }; MOST_LANES] }
    }

    /// Continues a search until the search requests a period or ends. If the requested period has the given
    /// `kind`, the function returns the search. If the period has a different kind, the function adds the
    /// search to the searches that wait.
    fn poll_search(
        &mut self,
        mut run: Running<'a, M, N>,
        kind: Kind,
    ) -> Option<(Running<'a, M, N>, Option<Restart<N>>)> {
        if run.search.as_mut().poll(&mut Context::from_waker(Waker::noop())).is_ready() {
            return None;
        }
        let request = run.exchange.request()?;
        if request.kind == kind {
            return Some((run, request.begin));
        }
        self.waiting[request.kind as usize].push_back(run);
        // The lanes of the states keep their state meanwhile.
        while kind == Kind::States
            && let Some(other) = self.other_that_waits(BATCH)
        {
            self.integrate_batch(other);
        }
        None
    }

    /// Returns the next search that waits for a period of this kind, or whose first period has this kind.
    fn next(&mut self, kind: Kind, idle: bool) -> Option<(Running<'a, M, N>, Restart<N>)> {
        loop {
            if let Some(run) = self.waiting[kind as usize].pop_front() {
                let begin = run.exchange.request()?.begin?;
                return Some((run, begin));
            }
            if kind != Kind::States {
                return None;
            }
            let run = if let Some(run) = (self.source)(false) {
                run
            } else {
                // The source may wait for results of searches that wait here. With few of them, most lanes would be
                // empty.
                if idle {
                    self.integrate_others();
                } else if let Some(other) = self.other_that_waits(Vector::<I>::LANES) {
                    self.integrate_batch(other);
                }
                if !self.waiting[kind as usize].is_empty() {
                    continue;
                }
                if !idle {
                    return None;
                }
                (self.source)(true)?
            };
            if let Some((run, Some(begin))) = self.poll_search(run, kind) {
                return Some((run, begin));
            }
        }
    }
}

/// Function that stores the totals `V` over a period in the [`PeriodEnd`] of the period.
type Store<V, M, const N: usize> = fn(&V, &mut PeriodEnd<SumsOf<M, N>, N>, &Exchange<M, N>);

/// The periods of one kind, as the queue of an ensemble whose totals over a period have the type `V`.
struct Periods<'a, 's, 'd, I, M: Model<N>, V, const N: usize> {
    driver: &'d mut Driver<'a, 's, I, M, N>,
    kind: Kind,
    store: Store<V, M, N>,
    /// Search of the period in each lane.
    runs: [Option<Running<'a, M, N>>; MOST_LANES],
}

impl<I, M, V, const N: usize> Queue<M, V, N> for Periods<'_, '_, '_, I, M, V::Totals<f64>, N>
where
    I: Simd,
    M: Model<N>,
    V: Observer<M, N>,
{
    fn next(&mut self, lane: usize, idle: bool) -> Option<Start<&M::Constants<f64>, N>> {
        let (run, begin) = self.driver.next(self.kind, idle)?;
        Some(begin.with(&self.runs[lane].insert(run).exchange.start.constants))
    }

    fn ended(&mut self, lane: usize, end: SpanEnd<'_, V::Totals<f64>, N>) -> Option<Next<N>> {
        let run = self.runs[lane].take()?;
        let mut period = PeriodEnd::new(*end.y, end.outcome);
        (self.store)(end.totals, &mut period, &run.exchange);
        if self.kind == Kind::Responses {
            period.monodromy = monodromy(end.responses, &run.exchange.start.scale);
        }
        run.exchange.finish(period);
        let (run, begin) = self.driver.poll_search(run, self.kind)?;
        self.runs[lane] = Some(run);
        Some(begin.map_or(Next::Span, Next::Restart))
    }

    fn interrupted(&self) -> bool {
        (self.driver.interrupted)()
    }
}
