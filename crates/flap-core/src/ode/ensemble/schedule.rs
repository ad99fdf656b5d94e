//! Schedule of an ensemble: it loads runs from the queue into lanes, steps, and unloads runs that have ended.

use core::ops::AddAssign;

use super::bank::{Bank, Events};
use super::queue::{MOST_LANES, Next, Observer, Queue, SpanEnd};
use crate::num::{Lanes, Simd, Vector};
use crate::ode::{Ending, INTERRUPT_STEPS, Ode, Outcome, Start, Tolerances};

/// Use of the lanes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Occupancy {
    /// Steps attempted in lanes with a run.
    pub used: u64,
    /// Steps attempted in all lanes.
    pub room: u64,
}

impl AddAssign for Occupancy {
    fn add_assign(&mut self, more: Occupancy) {
        self.used += more.used;
        self.room += more.room;
    }
}

/// Integrates the runs of `queue` until it is empty or interrupted. Returns the use of the lanes.
pub fn run<S: Simd, O: Ode<N>, V: Observer<O, N>, const N: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    queue: &mut dyn Queue<O, V, N>,
) -> Occupancy {
    run_varied::<_, _, _, N, 0>(simd, ode, observer, tolerances, queue)
}

/// [`run`] with the responses of the states to changes of their initial values.
pub(crate) fn run_with_responses<S: Simd, O: Ode<N>, V: Observer<O, N>, const N: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    queue: &mut dyn Queue<O, V, N>,
) -> Occupancy {
    run_varied::<_, _, _, N, N>(simd, ode, observer, tolerances, queue)
}

/// [`run`] with responses to D changes. The queue is not generic, so this is compiled once per observer.
fn run_varied<S: Simd, O: Ode<N>, V: Observer<O, N>, const N: usize, const D: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    queue: &mut dyn Queue<O, V, N>,
) -> Occupancy {
    let Some(first) = queue.next(0, true) else { return Occupancy::default() };
    // The queue's callbacks may call this again, so it enters a function with these instructions enabled.
    simd.vectorize(
        #[inline(always)]
        || {
            Schedule::<Vector<S>, O, V, N, D>::new(simd, observer, tolerances, &first)
                .drive(simd, ode, observer, queue)
        },
    )
}

/// The lanes, and which of them have a run.
struct Schedule<R: Lanes, O: Ode<N>, V: Observer<O, N>, const N: usize, const D: usize> {
    bank: Bank<R, O, V, N, D>,
    /// Number of vector steps at the beginning of the run in each lane.
    began: [u64; MOST_LANES],
    /// Number of vector steps.
    steps: u64,
    /// Number of steps of the runs that have ended.
    used: u64,
    /// Lanes with a run, one bit each.
    active: u64,
    /// Lanes whose run has not started, one bit each.
    fresh: u64,
}

impl<R: Lanes, O: Ode<N>, V: Observer<O, N>, const N: usize, const D: usize> Schedule<R, O, V, N, D> {
    /// Returns a schedule with one run, in lane 0.
    #[inline(always)]
    fn new(
        token: R::Token,
        observer: &V,
        tolerances: &Tolerances,
        first: &Start<O::Constants<f64>, N>,
    ) -> Self {
        const { assert!(R::LANES <= MOST_LANES) };
        let mut schedule = Schedule {
            bank: Bank::new(token, observer, tolerances, first),
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
    fn load(&mut self, lane: usize, start: &Start<O::Constants<f64>, N>, observer: &V) {
        self.bank.load(lane, start, observer);
        self.begin(lane);
    }

    /// Starts the loaded run of a lane.
    fn begin(&mut self, lane: usize) {
        self.began[lane] = self.steps;
        self.active |= 1 << lane;
        self.fresh |= 1 << lane;
    }

    /// Integrates until the queue is empty.
    #[inline(always)]
    fn drive(mut self, simd: impl Simd, ode: &O, observer: &V, queue: &mut dyn Queue<O, V, N>) -> Occupancy {
        loop {
            self.refill(observer, queue);
            if self.active == 0 || queue.interrupted() {
                return Occupancy { used: self.used, room: self.steps * R::LANES as u64 };
            }
            if self.fresh != 0 {
                self.bank.begin(ode, self.fresh);
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

    /// Attempts steps in every lane until a lane has an event, or for a few milliseconds.
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

    /// Fills waiting lanes, as long as the queue has runs.
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

    /// Passes runs at the ends of their spans and failed runs to the queue.
    fn settle(&mut self, events: &Events, observer: &V, queue: &mut dyn Queue<O, V, N>) {
        for lane in 0..R::LANES {
            let bit = 1 << lane;
            if (events.landed | events.failed) & bit == 0 {
                continue;
            }
            let failed = events.failed & bit != 0;
            let ending = if failed { self.bank.failure(lane) } else { Ending::Stopped };
            let steps = self.steps - self.began[lane];
            let (y, totals) = (&self.bank.state(lane), &self.bank.totals(lane));
            let responses = &self.bank.responses(lane);
            let outcome = Outcome::new::<O, N>(ending, steps, self.bank.switches(lane));
            match queue.ended(lane, SpanEnd { y, totals, responses, outcome }) {
                Some(Next::Span) if !failed => self.bank.begin_span(lane),
                Some(Next::Restart(next)) => {
                    self.used += steps;
                    self.bank.restart(lane, &next, observer);
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
        let Events { landed, failed } = self.bank.advance(ode, observer);
        self.steps += 1;
        let landed = landed & self.active;
        Events { landed, failed: failed & self.active & !landed }
    }
}
