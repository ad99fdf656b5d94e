//! Integration of runs with the recorded step sizes of an earlier run, from changed constants and initial
//! states.
//!
//! If a step-size controller chooses the steps, the final state jumps by about the tolerance when a constant
//! changes. If the steps are fixed fractions of the time span, the final state is a smooth function of the
//! constants. With such fixed steps, finite differences of the final state are accurate derivatives at any
//! tolerance. If a recorded step ends on the switching surface, the repeated step also ends on the surface. A
//! repeated step may reach the surface earlier or later than the recorded step.

use core::ops::ControlFlow;

use super::ensemble::Observer;
use super::solve::solve_until;
use super::step::{Attempt, Step};
use super::switch::landing_size;
use super::{Interrupt, Ode, Outcome, Start, Tolerances, input, slope};
use crate::num::{Lanes, PerLane, Scalar, Simd, Vector};

/// A recorded step of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RecordedStep {
    /// End of the step, as a fraction of the time span.
    pub(crate) end: f64,
    /// Side of the switching surface on which the step lies: +1 or −1.
    pub(crate) side: f64,
    /// True if the step ends on the switching surface, so that the next step is on the opposite side.
    pub(crate) lands: bool,
}

/// Result of a run that was integrated with recorded steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Repeated<T, const N: usize> {
    /// Final state.
    pub(crate) y: [f64; N],
    /// Totals of the observer.
    pub(crate) totals: T,
    /// True if the run and the recorded run reached the switching surface at almost equal times. The two
    /// times may differ by a small fraction of a mean step. If `meets` is false, the result is unusable.
    pub(crate) meets: bool,
}

/// Returns the accepted steps of a run over one time span, and the outcome of the run. The steps of a failed
/// run are unusable.
pub(crate) fn record<O: Ode<N>, R: Scalar, const N: usize>(
    ode: &O,
    tolerances: &Tolerances,
    start: &Start<O::Constants<f64>, N>,
    interrupted: Interrupt<'_>,
) -> (Vec<RecordedStep>, Outcome) {
    let mut recording: Vec<RecordedStep> = Vec::new();
    let outcome = solve_until::<O, R, N>(
        ode,
        tolerances,
        start,
        interrupted,
        &mut |_, attempt| {
            let side = attempt.side.lane(0);
            if let Some(last) = recording.last_mut() {
                last.lands = last.side != side;
            }
            let end = (attempt.t.lane(0) + attempt.h.lane(0)) / start.span;
            recording.push(RecordedStep { end, side, lands: false });
        },
        &mut |_| ControlFlow::Break(()),
    );
    if let Some(last) = recording.last_mut() {
        last.end = 1.0;
    }
    (recording, outcome)
}

/// Integrates one run from each of `starts`, in lanes, with the steps of `recording`. The steps are scaled to
/// the time span of each run.
///
/// Every run evaluates the right-hand side six times per step, or 18 times if the step ends on the switching
/// surface. One more evaluation is necessary at the start, and after each crossing of the switching surface.
pub(crate) fn replay<S, O, V, const N: usize>(
    simd: S,
    ode: &O,
    observer: &V,
    recording: &[RecordedStep],
    starts: &[Start<O::Constants<f64>, N>],
) -> Vec<Repeated<V::Totals<f64>, N>>
where
    S: Simd,
    O: Ode<N>,
    V: Observer<O, N>,
{
    let mut ends = Vec::with_capacity(starts.len());
    for starts in starts.chunks(Vector::<S>::LANES) {
        simd.vectorize(
            #[inline(always)]
            || in_lanes::<Vector<S>, O, V, N>(simd, ode, observer, recording, starts, &mut ends),
        );
    }
    ends
}

/// Number of times that a step is repeated so that it ends on the switching surface. The first attempt ends
/// close to the surface. Each repetition is a Newton step, which about squares the small distance from the
/// surface.
const LANDINGS: u32 = 2;

/// Largest allowed difference between the times at which a run and the recorded run reach the switching
/// surface, as a fraction of a mean step.
const NEAR: f64 = 1e-2;

/// Integrates a group of runs with the steps of `recording`. The group has at most one run for each lane.
#[inline(always)]
fn in_lanes<R: Lanes, O: Ode<N>, V: Observer<O, N>, const N: usize>(
    token: R::Token,
    ode: &O,
    observer: &V,
    recording: &[RecordedStep],
    starts: &[Start<O::Constants<f64>, N>],
    ends: &mut Vec<Repeated<V::Totals<f64>, N>>,
) {
    let number = R::splat(token, 0.0);
    let mut c = O::Constants::<R>::fill(number, &starts[0].constants);
    let mut span = number.lit(starts[0].span);
    let mut y = [number; N];
    for lane in 0..R::LANES {
        // Idle lanes repeat the first run.
        let start = if lane < starts.len() { &starts[lane] } else { &starts[0] };
        c.set(lane, &start.constants);
        span.set_lane(lane, start.span);
        y.set(lane, &start.y);
    }
    let all = number.lt(number.lit(1.0));
    let mut totals = V::Totals::<R>::fill(number, &observer.nothing());
    let mut t = number;
    let mut moved = number;
    let side = number.lit(if recording.is_empty() { 1.0 } else { recording[0].side });
    let k1 = slope(ode, &c, &input(ode, &c, t), side, &y);
    let mut step = Step::new(y, k1);
    for recorded in recording {
        let side = number.lit(recorded.side);
        let whole = span * recorded.end - t;
        let mut h = whole;
        let tries = if recorded.lands { 1 + LANDINGS } else { 1 };
        for attempt in 0..tries {
            if attempt > 0 {
                h = landing_size(h, ode.switch(&c, &step.y[6], &step.k[6]));
            }
            step.attempt(ode, &c, t, h, side);
        }
        moved = ((h - whole) / span).abs().max(moved);
        observer.add(&c, &Attempt { t, h, side, step: &step }, all, &mut totals);
        t = t + h;
        step.advance(all);
        if recorded.lands {
            step.k[0] = slope(ode, &c, &input(ode, &c, t), -side, &step.y[0]);
        }
    }
    for lane in 0..starts.len() {
        let y: [f64; N] = step.y[0].get(lane);
        // The state is NaN if the surface was missed.
        let steps = moved.lane(lane) * recording.len() as f64;
        let meets = steps <= NEAR && y.iter().all(|y| y.is_finite());
        ends.push(Repeated { y, totals: totals.get(lane), meets });
    }
}
