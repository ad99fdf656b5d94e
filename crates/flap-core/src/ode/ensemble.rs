//! Many runs in SIMD lanes.
//!
//! Every lane has its own time, step size, accept or reject, and constants. A lane whose run has ended takes
//! the next one from the queue while its neighbours go on, so lanes are full until the queue is empty; a run
//! that fails is reported and replaced likewise. No operation mixes lanes: a run's results do not depend on
//! what runs beside it, and equal those of [`super::solve`] to the last bit.

use core::ops::{AddAssign, ControlFlow};

use super::controller::{Memory, judge};
use super::norm::error_squared;
use super::start::{first_step, span_step};
use super::step::{Attempt, Step};
use super::switch::{Crossing, Switching, landing_stretch};
use super::{Ending, MIN_STEP, Ode, Outcome, Start, Tolerances, UNASKED, input, slope};
use crate::num::{Lanes, PerLane, Simd, Vector};

/// A run to be started: what to remember of it, and where it begins.
pub type NewRun<Run, C, const N: usize> = (Run, Start<C, N>);

/// Where runs come from and what becomes of them.
pub trait Queue<O: Ode<N>, V: Observer<O, N>, const N: usize> {
    /// What the caller wants to remember of a run while it is in a lane.
    type Run;

    /// The next run, or `None` if there is none for now.
    ///
    /// With `idle`, no lane is running: the call may wait, and `None` ends the ensemble.
    fn next(&mut self, idle: bool) -> Option<NewRun<Self::Run, O::Constants<f64>, N>>;

    /// Looks at a run at the end of a span, and goes on with it or breaks.
    fn span_end(&mut self, run: &mut Self::Run, y: &[f64; N], totals: &V::Totals<f64>) -> ControlFlow<()>;

    /// Takes leave of a run that has been stopped or has failed.
    fn ended(&mut self, run: Self::Run, outcome: Outcome);

    /// Whether to end with runs in lanes, which are dropped; see [`Interrupt`](super::Interrupt).
    fn interrupted(&self) -> bool {
        false
    }
}

/// Something that is summed up along a run, lane by lane.
pub trait Observer<O: Ode<N>, const N: usize> {
    /// The sums.
    type Totals<R: Lanes>: PerLane<R, One = Self::Totals<f64>>;

    /// The sums before the first step.
    fn nothing(&self) -> Self::Totals<f64>;

    /// Adds a step, in the lanes in which it was accepted.
    fn add<R: Lanes>(
        &self,
        ode: &O,
        c: &O::Constants<R>,
        attempt: &Attempt<'_, R, N>,
        accepted: R::Mask,
        totals: &mut Self::Totals<R>,
    );
}

/// Observes nothing.
#[derive(Clone, Copy, Debug)]
pub struct Unobserved;

impl<O: Ode<N>, const N: usize> Observer<O, N> for Unobserved {
    type Totals<R: Lanes> = ();

    #[inline(always)]
    fn nothing(&self) {}

    #[inline(always)]
    fn add<R: Lanes>(
        &self,
        _ode: &O,
        _c: &O::Constants<R>,
        _attempt: &Attempt<'_, R, N>,
        _accepted: R::Mask,
        (): &mut (),
    ) {
    }
}

/// How full lanes were.
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

/// Integrates the runs of `queue` until it has no more or is interrupted. Returns how full the lanes were.
pub fn run<S, O, V, Q, const N: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    tolerances: &Tolerances,
    queue: &mut Q,
) -> Occupancy
where
    S: Simd,
    O: Ode<N>,
    V: Observer<O, N>,
    Q: Queue<O, V, N>,
{
    let Some(first) = queue.next(true) else { return Occupancy::default() };
    // The callbacks of a queue may call this again: enter a function with these instructions enabled.
    simd.vectorize(
        #[inline(always)]
        || {
            Bank::<Vector<S>, O, V, Q::Run, N>::new(simd, observer, tolerances, first)
                .drive(ode, observer, queue)
        },
    )
}

/// The lanes and what runs in them.
struct Bank<R: Lanes, O: Ode<N>, V: Observer<O, N>, Run, const N: usize> {
    token: R::Token,
    tolerances: Tolerances,

    // One of each per lane.
    constants: O::Constants<R>,
    totals: V::Totals<R>,
    span: R,
    rtol: R,
    atol: [R; N],
    t: R,
    h: R,
    /// The step size with which a span begins.
    h_begin: R,
    step: Step<R, N>,
    memory: Memory<R>,
    switching: Switching<R>,
    steps_in_span: R,
    switches: R,
    error: R,

    /// What runs in each lane; `None` in a lane that waits for work.
    runs: Vec<Option<Running<Run>>>,
    /// Vector steps made.
    steps: u64,
    /// Steps that the runs which have ended took.
    used: u64,
    /// Lanes with a run, one bit each.
    active: u64,
    /// Lanes whose run has not begun, one bit each.
    fresh: u64,
}

struct Running<Run> {
    run: Run,
    /// Vector steps made when it began.
    began: u64,
}

/// Lanes to which something has happened in a step, one bit each.
struct Events {
    landed: u64,
    failed: u64,
}

impl<R: Lanes, O: Ode<N>, V: Observer<O, N>, Run, const N: usize> Bank<R, O, V, Run, N> {
    /// A bank with one run in lane 0. The idle lanes hold the same numbers, so that they compute nothing odd.
    #[inline(always)]
    fn new(
        token: R::Token,
        observer: &V,
        tolerances: &Tolerances,
        (run, start): NewRun<Run, O::Constants<f64>, N>,
    ) -> Self {
        let number = R::splat(token, 0.0);
        let mut bank = Bank {
            token,
            tolerances: *tolerances,
            constants: O::Constants::<R>::fill(token, &start.constants),
            totals: V::Totals::<R>::fill(token, &observer.nothing()),
            span: number.lit(start.span),
            rtol: number.lit(tolerances.rtol * start.tighten),
            atol: [number; N],
            t: number,
            h: number.lit(start.span),
            h_begin: number.lit(start.span),
            step: Step::new([number; N], [number; N]),
            memory: Memory::new(number),
            switching: Switching::new(number),
            steps_in_span: number,
            switches: number,
            error: number,
            runs: (0..R::LANES).map(|_| None).collect(),
            steps: 0,
            used: 0,
            active: 0,
            fresh: 0,
        };
        for i in 0..N {
            bank.step.y[0][i] = number.lit(start.y[i]);
            bank.atol[i] = number.lit(tolerances.atol * start.tighten * start.scale[i]);
        }
        bank.load(0, run, &start, observer);
        bank
    }

    /// Puts a run into a lane.
    fn load(&mut self, lane: usize, run: Run, start: &Start<O::Constants<f64>, N>, observer: &V) {
        self.constants.set(lane, &start.constants);
        self.totals.set(lane, &observer.nothing());
        self.span.set_lane(lane, start.span);
        self.rtol.set_lane(lane, self.tolerances.rtol * start.tighten);
        for i in 0..N {
            self.step.y[0][i].set_lane(lane, start.y[i]);
            self.atol[i].set_lane(lane, self.tolerances.atol * start.tighten * start.scale[i]);
        }
        self.runs[lane] = Some(Running { run, began: self.steps });
        self.active |= 1 << lane;
        self.fresh |= 1 << lane;
    }

    /// Runs the queue empty.
    #[inline(always)]
    fn drive<Q: Queue<O, V, N, Run = Run>>(mut self, ode: &O, observer: &V, queue: &mut Q) -> Occupancy {
        loop {
            self.refill(observer, queue);
            if self.active == 0 || queue.interrupted() {
                return Occupancy { used: self.used, room: self.steps * R::LANES as u64 };
            }
            if self.fresh != 0 {
                self.begin(ode);
            }
            let mut unasked = UNASKED;
            let events = loop {
                let events = self.advance(ode, observer);
                unasked -= 1;
                if events.landed | events.failed != 0 || unasked == 0 {
                    break events;
                }
            };
            self.settle(&events, queue);
        }
    }

    /// Fills the lanes that wait, as far as there are runs.
    fn refill<Q: Queue<O, V, N, Run = Run>>(&mut self, observer: &V, queue: &mut Q) {
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

    /// First slope and step size of the fresh lanes. The others compute along and keep what they have.
    #[inline(always)]
    fn begin(&mut self, ode: &O) {
        let fresh = R::mask(self.token, self.fresh);
        let switching = Switching::begin(ode, &self.constants, &self.step.y[0]);
        let (k1, h) = first_step(
            ode,
            &self.constants,
            switching.side,
            &self.step.y[0],
            self.span,
            &self.atol,
            self.rtol,
        );
        let value = ode.switch(&self.constants, &self.step.y[0], &k1);
        let zero = self.t.lit(0.0);
        let memory = Memory::new(zero);
        for i in 0..N {
            self.step.k[0][i] = R::select(fresh, k1[i], self.step.k[0][i]);
        }
        self.h = R::select(fresh, h, self.h);
        self.h_begin = R::select(fresh, h, self.h_begin);
        self.t = R::select(fresh, zero, self.t);
        self.steps_in_span = R::select(fresh, zero, self.steps_in_span);
        self.memory.log2_error = R::select(fresh, memory.log2_error, self.memory.log2_error);
        self.memory.level_max = R::select(fresh, memory.level_max, self.memory.level_max);
        if O::SWITCHES {
            self.switching.side = R::select(fresh, switching.side, self.switching.side);
            self.switching.heading = R::select(fresh, zero, self.switching.heading);
            self.switching.value = [
                R::select(fresh, value[0], self.switching.value[0]),
                R::select(fresh, value[1], self.switching.value[1]),
            ];
            self.switches = R::select(fresh, zero, self.switches);
        }
        self.fresh = 0;
    }

    /// Makes a lane ready for the next span.
    fn begin_span(&mut self, lane: usize) {
        let h = span_step(self.h_begin.lane(lane), self.h.lane(lane));
        let memory = Memory::new(0.0);
        self.t.set_lane(lane, 0.0);
        self.steps_in_span.set_lane(lane, 0.0);
        self.h.set_lane(lane, h);
        self.h_begin.set_lane(lane, h);
        self.memory.log2_error.set_lane(lane, memory.log2_error);
        self.memory.level_max.set_lane(lane, memory.level_max);
    }

    /// Attempts one step in every lane.
    #[inline(always)]
    fn advance(&mut self, ode: &O, observer: &V) -> Events {
        let target = ode.next_break(&self.constants, self.t).min(self.span);
        let remaining = target - self.t;
        let landing = remaining.lt(self.h * landing_stretch(&self.switching));
        let h = R::select(landing, remaining, self.h);

        let side = self.switching.side;
        self.step.attempt(ode, &self.constants, self.t, h, side);
        let Step { y: [y, .., y_new], error, .. } = &self.step;
        self.error = error_squared(error, y, y_new, &self.atol, self.rtol, O::CONTROLLED);
        let verdict = judge(self.error, &mut self.memory);
        self.steps += 1;
        self.steps_in_span = self.steps_in_span + 1.0;

        let proposal = h * verdict.factor;
        // A step cut short by its target says little about the next one.
        let h_next = R::select(verdict.accepted & landing, proposal.max(self.h), proposal);
        let mut crossing =
            Crossing { accepted: verdict.accepted, h: h_next, arrived: R::mask(self.token, 0) };
        if O::SWITCHES {
            crossing = self.switching.judge(ode, &self.constants, &self.step, h, verdict.accepted, h_next);
        }
        self.h = crossing.h;
        let accepted = crossing.accepted;
        let attempt = Attempt { t: self.t, h, side, step: &self.step };
        observer.add(ode, &self.constants, &attempt, accepted, &mut self.totals);
        let t = R::select(landing, target, self.t + h);
        self.t = R::select(accepted, t, self.t);
        self.step.advance(accepted);
        if O::SWITCHES && R::bits(crossing.arrived) != 0 {
            self.change_sides(ode, crossing.arrived);
        }
        let landed = R::bits(accepted & landing) & !R::bits(target.lt(self.span));

        let limit = self.t.lit(f64::from(self.tolerances.max_steps) - 0.5);
        let exhausted = R::bits(limit.lt(self.steps_in_span));
        let stuck = R::bits(self.h.lt(self.span * MIN_STEP));
        let landed = landed & self.active;
        Events { landed, failed: (exhausted | stuck) & self.active & !landed }
    }

    /// Renews the first slope in the lanes that have arrived at their switching surface.
    #[inline(always)]
    fn change_sides(&mut self, ode: &O, arrived: R::Mask) {
        let u = input(ode, &self.constants, self.t);
        let Step { y: [y, ..], k: [k1, ..], .. } = &mut self.step;
        let crossed = ode.crossed(&self.constants, &u, self.switching.side, y);
        for i in 0..N {
            y[i] = R::select(arrived, crossed[i], y[i]);
        }
        let slope = slope(ode, &self.constants, &u, self.switching.side, y);
        for i in 0..N {
            k1[i] = R::select(arrived, slope[i], k1[i]);
        }
        let value = ode.switch(&self.constants, y, k1);
        for i in 0..2 {
            self.switching.value[i] = R::select(arrived, value[i], self.switching.value[i]);
        }
        self.switches = R::select(arrived, self.switches + 1.0, self.switches);
    }

    /// Asks the queue about the lanes that have landed, and gives up those that have failed.
    fn settle<Q: Queue<O, V, N, Run = Run>>(&mut self, events: &Events, queue: &mut Q) {
        for lane in 0..R::LANES {
            let bit = 1 << lane;
            if (events.landed | events.failed) & bit == 0 {
                continue;
            }
            let Some(running) = &mut self.runs[lane] else { continue };
            let ending = if events.failed & bit != 0 {
                Some(Ending::of_failure(self.error.lane(lane)))
            } else {
                let mut y = [0.0; N];
                for i in 0..N {
                    y[i] = self.step.y[0][i].lane(lane);
                }
                let verdict = queue.span_end(&mut running.run, &y, &self.totals.get(lane));
                verdict.is_break().then_some(Ending::Stopped)
            };
            match ending {
                None => self.begin_span(lane),
                Some(ending) => {
                    self.active &= !bit;
                    if let Some(Running { run, began }) = self.runs[lane].take() {
                        #[expect(
                            clippy::cast_possible_truncation,
                            clippy::cast_sign_loss,
                            reason = "a count: whole, positive and small"
                        )]
                        let switches = self.switches.lane(lane) as u64;
                        let steps = self.steps - began;
                        self.used += steps;
                        queue.ended(run, Outcome::new::<O, N>(ending, steps, switches));
                    }
                }
            }
        }
    }
}
