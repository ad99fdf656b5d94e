//! The runs in the lanes of an ensemble, and the integration of one step in all lanes.

use super::queue::Observer;
use crate::num::{Lanes, PerLane};
use crate::ode::controller::{Memory, judge};
use crate::ode::norm::add_squares;
use crate::ode::start::{first_step, span_step};
use crate::ode::step::{Attempt, Step};
use crate::ode::switch::{Crossing, Switching, cross, landing_stretch};
use crate::ode::variation::{RESPONSE_SCALE, Varied};
use crate::ode::{Ending, MIN_STEP, Ode, Start, Tolerances};

/// States and constants of the runs in all lanes, and the responses of each run to D changes of its initial
/// state.
pub(super) struct LaneRuns<R: Lanes, O: Ode<N>, V: Observer<O, N>, const N: usize, const D: usize> {
    token: R::Token,
    tolerances: Tolerances,

    // One set per lane.
    constants: O::Constants<R>,
    totals: V::Totals<R>,
    span: R,
    rtol: R,
    atol: [R; N],
    atol_of_responses: [R; N],
    t: R,
    h: R,
    /// Step size at the beginning of the current time span.
    h_begin: R,
    step: Step<R, N>,
    responses: [Step<R, N>; D],
    memory: Memory<R>,
    switching: Switching<R>,
    steps_in_span: R,
    switches: R,
    error: R,
}

/// Lanes in which a time span ended or a run failed in the last step, with one bit for each lane.
pub(super) struct Events {
    /// Lanes in which the run is at the end of a time span.
    pub(super) landed: u64,
    /// Lanes in which the run has failed.
    pub(super) failed: u64,
}

impl<R: Lanes, O: Ode<N>, V: Observer<O, N>, const N: usize, const D: usize> LaneRuns<R, O, V, N, D> {
    /// Returns lanes that all contain the run of `start`. Idle lanes also integrate this run, so that their
    /// numbers stay finite.
    #[inline(always)]
    pub(super) fn new(
        token: R::Token,
        observer: &V,
        tolerances: &Tolerances,
        start: &Start<&O::Constants<f64>, N>,
    ) -> Self {
        let number = R::splat(token, 0.0);
        let Start { constants, y, span, scale, tolerance_factor, change } = start;
        let mut responses = [Step::new([number; N], [number; N]); D];
        for (i, response) in responses.iter_mut().enumerate() {
            response.y[0][i] = number.lit(change[i]);
        }
        LaneRuns {
            token,
            tolerances: *tolerances,
            constants: O::Constants::<R>::fill(number, constants),
            totals: V::Totals::<R>::fill(number, &observer.nothing()),
            span: number.lit(*span),
            rtol: number.lit(tolerances.rtol * tolerance_factor),
            atol: PerLane::fill(number, &tolerances.absolute(*tolerance_factor, scale)),
            atol_of_responses: PerLane::fill(number, &of_responses(tolerances, *tolerance_factor, change)),
            t: number,
            h: number.lit(*span),
            h_begin: number.lit(*span),
            step: Step::new(PerLane::fill(number, y), [number; N]),
            responses,
            memory: Memory::new(number),
            switching: Switching::new(number),
            steps_in_span: number,
            switches: number,
            error: number,
        }
    }

    /// Loads a run into a lane.
    pub(super) fn load(&mut self, lane: usize, start: &Start<&O::Constants<f64>, N>, observer: &V) {
        self.constants.set(lane, start.constants);
        self.restart(lane, start, observer);
    }

    /// Replaces the run in a lane by a run that begins at `next` and has the same constants as the replaced
    /// run.
    pub(super) fn restart<C>(&mut self, lane: usize, next: &Start<C, N>, observer: &V) {
        self.totals.set(lane, &observer.nothing());
        self.rtol.set_lane(lane, self.tolerances.rtol * next.tolerance_factor);
        let Start { y, span, scale, tolerance_factor, change, .. } = next;
        self.span.set_lane(lane, *span);
        self.step.y[0].set(lane, y);
        self.atol.set(lane, &self.tolerances.absolute(*tolerance_factor, scale));
        if D > 0 {
            self.atol_of_responses.set(lane, &of_responses(&self.tolerances, *tolerance_factor, change));
        }
        for (i, response) in self.responses.iter_mut().enumerate() {
            let mut begin = [0.0; N];
            begin[i] = change[i];
            response.y[0].set(lane, &begin);
        }
    }

    /// Computes the derivative ẏ at the start of the time span, and the first step size, in the lanes whose
    /// bits are set in `fresh`. Lanes whose bits are not set do not change.
    #[inline(always)]
    pub(super) fn begin(&mut self, ode: &O, fresh: u64) {
        let fresh = R::mask(self.token, fresh);
        let switching = Switching::begin(ode, &self.constants, &self.step.y[0]);
        let (k1, h) = first_step(
            ode,
            &self.constants,
            switching.side,
            &self.begins(),
            self.span,
            [&self.atol, &self.atol_of_responses],
            self.rtol,
        );
        let value = ode.switch(&self.constants, &self.step.y[0], &k1.motion);
        let zero = self.t.lit(0.0);
        let memory = Memory::new(zero);
        for i in 0..N {
            self.step.k[0][i] = R::select(fresh, k1.motion[i], self.step.k[0][i]);
            for (response, k1) in self.responses.iter_mut().zip(&k1.responses) {
                response.k[0][i] = R::select(fresh, k1[i], response.k[0][i]);
            }
        }
        self.h = R::select(fresh, h, self.h);
        self.h_begin = R::select(fresh, h, self.h_begin);
        self.t = R::select(fresh, zero, self.t);
        self.steps_in_span = R::select(fresh, zero, self.steps_in_span);
        self.memory.log2_error = R::select(fresh, memory.log2_error, self.memory.log2_error);
        self.memory.octaves_max = R::select(fresh, memory.octaves_max, self.memory.octaves_max);
        if O::SWITCHES {
            self.switching.side = R::select(fresh, switching.side, self.switching.side);
            self.switching.heading = self.switching.heading & !fresh;
            self.switching.value = [
                R::select(fresh, value[0], self.switching.value[0]),
                R::select(fresh, value[1], self.switching.value[1]),
            ];
            self.switches = R::select(fresh, zero, self.switches);
        }
    }

    /// Prepares the run in a lane for the next time span.
    pub(super) fn begin_span(&mut self, lane: usize) {
        let h = span_step(self.h_begin.lane(lane), self.h.lane(lane));
        let memory = Memory::new(0.0);
        self.t.set_lane(lane, 0.0);
        self.steps_in_span.set_lane(lane, 0.0);
        self.h.set_lane(lane, h);
        self.h_begin.set_lane(lane, h);
        self.memory.log2_error.set_lane(lane, memory.log2_error);
        self.memory.octaves_max.set_lane(lane, memory.octaves_max);
    }

    /// Attempts one step in every lane.
    #[inline(always)]
    pub(super) fn advance(&mut self, ode: &O, observer: &V) -> Events {
        let target = ode.next_break(&self.constants, self.t).min(self.span);
        let remaining = target - self.t;
        let landing = remaining.lt(self.h * landing_stretch(&self.switching));
        let h = R::select(landing, remaining, self.h);

        let side = self.switching.side;
        self.step.attempt_with(&mut self.responses, ode, &self.constants, self.t, h, side);
        self.error = self.error_squared();
        let verdict = judge(self.error, &mut self.memory);
        self.steps_in_span = self.steps_in_span + 1.0;

        let proposal = h * verdict.factor;
        // A step shortened to land on its target is no measure for the next step size.
        let h_next = R::select(verdict.accepted & landing, proposal.max(self.h), proposal);
        let mut crossing =
            Crossing { accepted: verdict.accepted, h: h_next, arrived: R::mask(self.token, 0) };
        if O::SWITCHES {
            crossing = self.switching.decide(ode, &self.constants, &self.step, h, verdict.accepted, h_next);
        }
        self.h = crossing.h;
        let accepted = crossing.accepted;
        let attempt = Attempt { t: self.t, h, side, step: &self.step };
        observer.add(&self.constants, &attempt, accepted, &mut self.totals);
        let t = R::select(landing, target, self.t + h);
        self.t = R::select(accepted, t, self.t);
        self.step.advance(accepted);
        for response in &mut self.responses {
            response.advance(accepted);
        }
        if O::SWITCHES && R::bits(crossing.arrived) != 0 {
            self.change_sides(ode, crossing.arrived);
        }
        let landed = R::bits(accepted & landing) & !R::bits(target.lt(self.span));

        let limit = self.t.lit(f64::from(self.tolerances.max_steps) - 0.5);
        let exhausted = R::bits(limit.lt(self.steps_in_span));
        let stuck = R::bits(self.h.lt(self.span * MIN_STEP));
        Events { landed, failed: exhausted | stuck }
    }

    /// In the lanes whose run has reached the switching surface, computes the derivative ẏ at the beginning
    /// of the next step again.
    #[inline(always)]
    fn change_sides(&mut self, ode: &O, arrived: R::Mask) {
        let [crossed, slopes] = cross(ode, &self.constants, self.t, self.switching.side, &self.begins());
        let Step { y: [y, ..], k: [k1, ..], .. } = &mut self.step;
        for i in 0..N {
            k1[i] = R::select(arrived, slopes.motion[i], k1[i]);
            for (j, Step { y: [y, ..], k: [k1, ..], .. }) in self.responses.iter_mut().enumerate() {
                y[i] = R::select(arrived, crossed.responses[j][i], y[i]);
                k1[i] = R::select(arrived, slopes.responses[j][i], k1[i]);
            }
        }
        let value = ode.switch(&self.constants, y, k1);
        for i in 0..2 {
            self.switching.value[i] = R::select(arrived, value[i], self.switching.value[i]);
        }
        self.switches = R::select(arrived, self.switches + 1.0, self.switches);
    }

    /// Returns the states, and their responses to changes of the initial state, at the beginning of the step.
    #[inline(always)]
    fn begins(&self) -> Varied<[R; N], D> {
        let mut begins = Varied { motion: self.step.y[0], responses: [self.step.y[0]; D] };
        for i in 0..D {
            begins.responses[i] = self.responses[i].y[0];
        }
        begins
    }

    /// Returns the mean square of the errors of the step, each divided by its tolerance, as in
    /// [`crate::ode::norm`].
    #[inline(always)]
    fn error_squared(&self) -> R {
        let Step { y: [y, .., y_new], error, .. } = &self.step;
        let mut sum = add_squares(self.rtol.lit(0.0), error, [y, y_new], &self.atol, self.rtol);
        for Step { y: [y, .., y_new], error, .. } in &self.responses {
            sum = add_squares(sum, error, [y, y_new], &self.atol_of_responses, self.rtol);
        }
        sum * (1.0 / (N * (1 + D)) as f64)
    }

    /// Returns the state of the run in one lane.
    pub(super) fn state(&self, lane: usize) -> [f64; N] {
        self.step.y[0].get(lane)
    }

    /// Returns the responses of the run in one lane to changes of the initial state of this run.
    pub(super) fn responses(&self, lane: usize) -> [[f64; N]; D] {
        core::array::from_fn(|i| self.responses[i].y[0].get(lane))
    }

    /// Returns the sums that the observer has computed for the run in one lane.
    pub(super) fn totals(&self, lane: usize) -> V::Totals<f64> {
        self.totals.get(lane)
    }

    /// Returns the ending of the run in one lane, if the run failed in its last step.
    pub(super) fn failure(&self, lane: usize) -> Ending {
        Ending::of_failure(self.error.lane(lane))
    }

    /// Returns the number of times that the run in one lane has crossed the switching surface.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count: whole, positive and small"
    )]
    pub(super) fn switches(&self, lane: usize) -> u64 {
        self.switches.lane(lane) as u64
    }
}

/// Returns the absolute tolerances of the responses to changes of the initial state. `change` contains the
/// size of the change of each component of the initial state.
fn of_responses<const N: usize>(
    tolerances: &Tolerances,
    tolerance_factor: f64,
    change: &[f64; N],
) -> [f64; N] {
    tolerances.absolute(tolerance_factor, &change.map(|change| RESPONSE_SCALE * change))
}
