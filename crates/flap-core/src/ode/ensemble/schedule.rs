//! The schedule of an ensemble loads runs from the queue into lanes, integrates the runs, and passes the
//! results to the queue.

use core::ops::AddAssign;

use super::lane_runs::{Events, LaneRuns};
use super::queue::{MOST_LANES, Next, Observer, Queue, SpanEnd};
use crate::num::{Lanes, Simd, Vector};
use crate::ode::{Ending, INTERRUPT_STEPS, Ode, Outcome, Start, Tolerances};

/// Use of the lanes of an ensemble: the number of attempted steps in lanes with a run, and in all lanes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Occupancy {
    /// Number of steps attempted in lanes that have a run.
    pub used: u64,
    /// Number of steps attempted in all lanes, including lanes without a run.
    pub room: u64,
}

impl AddAssign for Occupancy {
    fn add_assign(&mut self, more: Occupancy) {
        self.used += more.used;
        self.room += more.room;
    }
}

/// Integrates the runs of `queue` until the queue is empty or interrupted. Returns the number of steps that
/// were attempted in lanes with a run, and in all lanes.
pub fn run<S: Simd, O: Ode<N>, V: Observer<O, N>, const N: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    queue: &mut dyn Queue<O, V, N>,
) -> Occupancy {
    run_varied::<_, _, _, N, 0>(simd, ode, observer, tolerances, queue)
}

/// Integrates the runs of `queue` as [`run`] does, and also computes the responses of the states to changes
/// of the initial state.
pub(crate) fn run_with_responses<S: Simd, O: Ode<N>, V: Observer<O, N>, const N: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    queue: &mut dyn Queue<O, V, N>,
) -> Occupancy {
    run_varied::<_, _, _, N, N>(simd, ode, observer, tolerances, queue)
}

/// Integrates the runs of `queue` as [`run`] does, and also computes the responses to D changes of the
/// initial state. Because the type of `queue` is not generic, the function is compiled once for each
/// observer.
fn run_varied<S: Simd, O: Ode<N>, V: Observer<O, N>, const N: usize, const D: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    queue: &mut dyn Queue<O, V, N>,
) -> Occupancy {
    // The queue's callbacks may call this again, so it enters a function with these instructions enabled.
    simd.vectorize(
        #[inline(always)]
        || {
            let Some(first) = queue.next(0, true) else { return Occupancy::default() };
            Schedule::<Vector<S>, O, V, N, D>::new(simd, observer, tolerances, &first)
                .drive(simd, ode, observer, queue)
        },
    )
}

/// The runs in the lanes, the lanes that are in use, and the numbers of steps.
struct Schedule<R: Lanes, O: Ode<N>, V: Observer<O, N>, const N: usize, const D: usize> {
    runs: LaneRuns<R, O, V, N, D>,
    /// Value of `steps` at the beginning of the run in each lane.
    began: [u64; MOST_LANES],
    /// Number of attempted steps. A step that is attempted in all lanes at the same time counts as one step.
    steps: u64,
    /// Number of steps of all runs that have ended.
    used: u64,
    /// Lanes that have a run, with one bit for each lane.
    active: u64,
    /// Lanes whose run has not started, with one bit for each lane.
    fresh: u64,
}

impl<R: Lanes, O: Ode<N>, V: Observer<O, N>, const N: usize, const D: usize> Schedule<R, O, V, N, D> {
    /// Returns a schedule with one run, in lane 0.
    #[inline(always)]
    fn new(
        token: R::Token,
        observer: &V,
        tolerances: &Tolerances,
        first: &Start<&O::Constants<f64>, N>,
    ) -> Self {
        const { assert!(R::LANES <= MOST_LANES) };
        let mut schedule = Schedule {
            runs: LaneRuns::new(token, observer, tolerances, first),
            began: [0; MOST_LANES],
            steps: 0,
            used: 0,
            active: 0,
            fresh: 0,
        };
        schedule.load(0, first, observer);
        schedule
    }

    /// Loads a run into a lane.
    fn load(&mut self, lane: usize, start: &Start<&O::Constants<f64>, N>, observer: &V) {
        self.runs.load(lane, start, observer);
        self.begin(lane);
    }

    /// Starts the loaded run of a lane.
    fn begin(&mut self, lane: usize) {
        self.began[lane] = self.steps;
        self.active |= 1 << lane;
        self.fresh |= 1 << lane;
    }

    /// Integrates the runs until the queue is empty or interrupted.
    #[inline(always)]
    fn drive(mut self, simd: impl Simd, ode: &O, observer: &V, queue: &mut dyn Queue<O, V, N>) -> Occupancy {
        loop {
            self.refill(observer, queue);
            if self.active == 0 || queue.interrupted() {
                return Occupancy { used: self.used, room: self.steps * R::LANES as u64 };
            }
            if self.fresh != 0 {
                self.runs.begin(ode, self.fresh);
                self.fresh = 0;
            }
            // In a function of its own: beside the code for the queue, the steps take up to 1 % more instructions.
            let events = simd.vectorize(
                #[inline(always)]
                || self.advance(ode, observer),
            );
            self.settle(&events, observer, queue);
        }
    }

    /// Attempts steps in all lanes until a time span ends, a run fails, or a few milliseconds have passed.
    #[inline(always)]
    fn advance(&mut self, ode: &O, observer: &V) -> Events {
        let mut left = INTERRUPT_STEPS;
        loop {
            let events = self.step(ode, observer);
            left -= 1;
            if events.landed | events.failed != 0 || left == 0 {
                return events;
            }
        }
    }

    /// Loads runs into free lanes, as long as the queue contains runs.
    fn refill(&mut self, observer: &V, queue: &mut dyn Queue<O, V, N>) {
        for lane in 0..R::LANES {
            if self.active & (1 << lane) != 0 {
                continue;
            }
            match queue.next(lane, self.active == 0) {
                Some(start) => self.load(lane, &start, observer),
                None => return,
            }
        }
    }

    /// Passes failed runs, and runs at the end of a time span, to the queue.
    fn settle(&mut self, events: &Events, observer: &V, queue: &mut dyn Queue<O, V, N>) {
        for lane in 0..R::LANES {
            let bit = 1 << lane;
            if (events.landed | events.failed) & bit == 0 {
                continue;
            }
            let failed = events.failed & bit != 0;
            let ending = if failed { self.runs.failure(lane) } else { Ending::Stopped };
            let steps = self.steps - self.began[lane];
            let (y, totals) = (&self.runs.state(lane), &self.runs.totals(lane));
            let responses = &self.runs.responses(lane);
            let outcome = Outcome::new::<O, N>(ending, steps, self.runs.switches(lane));
            match queue.ended(lane, SpanEnd { y, totals, responses, outcome }) {
                Some(Next::Span) if !failed => self.runs.begin_span(lane),
                Some(Next::Restart(next)) => {
                    self.used += steps;
                    self.runs.restart(lane, &next, observer);
                    self.begin(lane);
                }
                _ => {
                    self.used += steps;
                    self.active &= !bit;
                }
            }
        }
    }

    /// Attempts one step in every lane.
    #[inline(always)]
    fn step(&mut self, ode: &O, observer: &V) -> Events {
        let Events { landed, failed } = self.runs.advance(ode, observer);
        self.steps += 1;
        let landed = landed & self.active;
        Events { landed, failed: failed & self.active & !landed }
    }
}
