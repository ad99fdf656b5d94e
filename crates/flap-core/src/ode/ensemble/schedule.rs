//! Schedule of an ensemble: it loads runs from the queue into lanes, steps, and unloads runs that have ended.

use core::ops::AddAssign;

use super::bank::{Bank, Events};
use super::queue::{NewRun, Next, Observer, Queue, SpanEnd};
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
    queue: &mut impl Queue<O, V, N>,
) -> Occupancy {
    run_varied::<_, _, _, N, 0>(simd, ode, observer, tolerances, queue)
}

/// [`run`] with the responses of the states to changes of their initial values.
pub(crate) fn run_with_responses<S: Simd, O: Ode<N>, V: Observer<O, N>, const N: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    queue: &mut impl Queue<O, V, N>,
) -> Occupancy {
    run_varied::<_, _, _, N, N>(simd, ode, observer, tolerances, queue)
}

/// [`run`] with responses to D changes.
fn run_varied<S: Simd, O: Ode<N>, V: Observer<O, N>, const N: usize, const D: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    queue: &mut impl Queue<O, V, N>,
) -> Occupancy {
    let Some(first) = queue.next(true) else { return Occupancy::default() };
    // The queue's callbacks may call this again, so it enters a function with these instructions enabled.
    simd.vectorize(
        #[inline(always)]
        || {
            Schedule::<Vector<S>, O, V, _, N, D>::new(simd, observer, tolerances, first)
                .drive(ode, observer, queue)
        },
    )
}

/// Largest number of lanes of any backend: two registers of AVX-512.
const MOST_LANES: usize = 16;

/// The lanes, and the run in each of them.
struct Schedule<R: Lanes, O: Ode<N>, V: Observer<O, N>, Run, const N: usize, const D: usize> {
    bank: Bank<R, O, V, N, D>,
    /// Run in each lane; `None` if the lane waits for work.
    runs: [Option<Running<Run>>; MOST_LANES],
    /// Number of vector steps.
    steps: u64,
    /// Number of steps of the runs that have ended.
    used: u64,
    /// Lanes with a run, one bit each.
    active: u64,
    /// Lanes whose run has not started, one bit each.
    fresh: u64,
}

struct Running<Run> {
    run: Run,
    /// Number of vector steps at its start.
    began: u64,
}

impl<R: Lanes, O: Ode<N>, V: Observer<O, N>, Run, const N: usize, const D: usize>
    Schedule<R, O, V, Run, N, D>
{
    /// Returns a schedule with one run, in lane 0.
    #[inline(always)]
    fn new(
        token: R::Token,
        observer: &V,
        tolerances: &Tolerances,
        (run, start): NewRun<Run, O::Constants<f64>, N>,
    ) -> Self {
        const { assert!(R::LANES <= MOST_LANES) };
        let mut schedule = Schedule {
            bank: Bank::new(token, observer, tolerances, &start),
            runs: [const { None }; MOST_LANES],
            steps: 0,
            used: 0,
            active: 0,
            fresh: 0,
        };
        schedule.load(0, run, &start, observer);
        schedule
    }

    /// Loads a run into a lane.
    fn load(&mut self, lane: usize, run: Run, start: &Start<O::Constants<f64>, N>, observer: &V) {
        self.bank.load(lane, start, observer);
        self.begin(lane, run);
    }

    /// Starts a loaded run.
    fn begin(&mut self, lane: usize, run: Run) {
        self.runs[lane] = Some(Running { run, began: self.steps });
        self.active |= 1 << lane;
        self.fresh |= 1 << lane;
    }

    /// Integrates until the queue is empty.
    #[inline(always)]
    fn drive(mut self, ode: &O, observer: &V, queue: &mut impl Queue<O, V, N, Run = Run>) -> Occupancy {
        loop {
            self.refill(observer, queue);
            if self.active == 0 || queue.interrupted() {
                return Occupancy { used: self.used, room: self.steps * R::LANES as u64 };
            }
            if self.fresh != 0 {
                self.bank.begin(ode, self.fresh);
                self.fresh = 0;
            }
            let mut left = INTERRUPT_STEPS;
            let events = loop {
                let events = self.advance(ode, observer);
                left -= 1;
                if events.landed | events.failed != 0 || left == 0 {
                    break events;
                }
            };
            self.settle(&events, observer, queue);
        }
    }

    /// Fills waiting lanes, as long as the queue has runs.
    fn refill(&mut self, observer: &V, queue: &mut impl Queue<O, V, N, Run = Run>) {
        for lane in 0..R::LANES {
            if self.active & (1 << lane) != 0 {
                continue;
            }
            match queue.next(self.active == 0) {
                Some((run, start)) => self.load(lane, run, &start, observer),
                None => return,
            }
        }
    }

    /// Passes runs at the ends of their spans and failed runs to the queue.
    fn settle(&mut self, events: &Events, observer: &V, queue: &mut impl Queue<O, V, N, Run = Run>) {
        for lane in 0..R::LANES {
            let bit = 1 << lane;
            if (events.landed | events.failed) & bit == 0 {
                continue;
            }
            let Some(Running { run, began }) = self.runs[lane].take() else { continue };
            let failed = events.failed & bit != 0;
            let ending = if failed { self.bank.failure(lane) } else { Ending::Stopped };
            let steps = self.steps - began;
            let (y, totals) = (&self.bank.state(lane), &self.bank.totals(lane));
            let responses = &self.bank.responses(lane);
            let outcome = Outcome::new::<O, N>(ending, steps, self.bank.switches(lane));
            match queue.ended(run, SpanEnd { y, totals, responses, outcome }) {
                Some((run, Next::Span)) if !failed => {
                    self.runs[lane] = Some(Running { run, began });
                    self.bank.begin_span(lane);
                }
                Some((run, Next::Restart(next))) => {
                    self.used += steps;
                    self.bank.restart(lane, &next, observer);
                    self.begin(lane, run);
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
    fn advance(&mut self, ode: &O, observer: &V) -> Events {
        let Events { landed, failed } = self.bank.advance(ode, observer);
        self.steps += 1;
        let landed = landed & self.active;
        Events { landed, failed: failed & self.active & !landed }
    }
}
