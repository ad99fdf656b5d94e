//! Integration of one run on scalars, in simple code.
//!
//! The code makes the same decisions as [`super::ensemble`], with the same arithmetic. The results of this
//! module and of the ensemble are therefore equal to the last bit. Tests compare the results of the ensemble
//! with the results of this module.

use core::ops::ControlFlow;

use super::controller::{Memory, judge};
use super::norm::error_squared;
use super::start::{first_step, span_step};
use super::step::{Attempt, Step};
use super::switch::{Crossing, Switching, landing_stretch};
use super::variation::Varied;
use super::{
    Ending, INTERRUPT_STEPS, Interrupt, MIN_STEP, Ode, Outcome, Start, Tolerances, input, never, slope,
};
use crate::num::{PerLane, Scalar};

/// Integrates one run until `at_span_end` returns [`ControlFlow::Break`] or the run fails.
///
/// The integrator calls `on_step` with every accepted step, and `at_span_end` with the state at the end of
/// each time span. The number type `R` is `f64` or [`crate::num::Unfused`].
pub fn solve<O: Ode<N>, R: Scalar, const N: usize>(
    ode: &O,
    tolerances: &Tolerances,
    start: &Start<O::Constants<f64>, N>,
    mut on_step: impl FnMut(&O::Constants<R>, &Attempt<'_, R, N>),
    mut at_span_end: impl FnMut(&[f64; N]) -> ControlFlow<()>,
) -> Outcome {
    solve_until::<O, R, N>(ode, tolerances, start, &never, &mut on_step, &mut at_span_end)
}

/// Callback that receives every accepted step.
type OnStep<'a, O, R, const N: usize> = dyn FnMut(&<O as Ode<N>>::Constants<R>, &Attempt<'_, R, N>) + 'a;

/// Integrates one run as [`solve`] does. The run also ends if `interrupted` returns true, with the ending
/// [`Ending::Stopped`].
///
/// The ending does not show whether the run was interrupted, so the caller must also call `interrupted`. The
/// types of the callbacks are not generic, so the function is compiled only once for each system of
/// equations.
#[inline(never)]
pub(crate) fn solve_until<O: Ode<N>, R: Scalar, const N: usize>(
    ode: &O,
    tolerances: &Tolerances,
    start: &Start<O::Constants<f64>, N>,
    interrupted: Interrupt<'_>,
    on_step: &mut OnStep<'_, O, R, N>,
    at_span_end: &mut dyn FnMut(&[f64; N]) -> ControlFlow<()>,
) -> Outcome {
    R::enter(
        #[inline(always)]
        || {
            let number = |x: f64| R::new(x);
            let c = O::Constants::<R>::fill(number(0.0), &start.constants);
            let span = number(start.span);
            let rtol = number(tolerances.rtol * start.tolerance_factor);
            let y = <[R; N]>::fill(span, &start.y);
            let atol = <[R; N]>::fill(span, &tolerances.absolute(start.tolerance_factor, &start.scale));

            let mut switching = Switching::begin(ode, &c, &y);
            let alone = Varied::alone(y);
            let (k1, mut h) = first_step(ode, &c, switching.side, &alone, span, [&atol; 2], rtol);
            switching.value = ode.switch(&c, &y, &k1.motion);
            let mut step = Step::new(y, k1.motion);
            let mut h_begin = h;
            let mut memory = Memory::new(span);
            let mut t = number(0.0);
            let mut attempts = 0;
            let mut switches = 0;
            let mut steps_in_span = 0;
            loop {
                let target = ode.next_break(&c, t).min(span);
                let remaining = target - t;
                let landing = remaining.lt(h * landing_stretch(&switching));
                let h_try = if landing { remaining } else { h };

                let side = switching.side;
                step.attempt(ode, &c, t, h_try, side);
                let error = error_squared(&step.error, [&step.y[0], &step.y[6]], &atol, rtol);
                let verdict = judge(error, &mut memory);
                attempts += 1;
                steps_in_span += 1;

                let proposal = h_try * verdict.factor;
                // A step shortened to land on its target is no measure for the next step size.
                let h_next = if verdict.accepted && landing { proposal.max(h) } else { proposal };
                let mut crossing = Crossing { accepted: verdict.accepted, h: h_next, arrived: false };
                if O::SWITCHES {
                    crossing = switching.decide(ode, &c, &step, h_try, verdict.accepted, h_next);
                }
                h = crossing.h;
                let accepted = crossing.accepted;
                if accepted {
                    on_step(&c, &Attempt { t, h: h_try, side, step: &step });
                    t = if landing { target } else { t + h_try };
                    step.advance(true);
                }
                if crossing.arrived {
                    step.k[0] = slope(ode, &c, &input(ode, &c, t), switching.side, &step.y[0]);
                    switching.value = ode.switch(&c, &step.y[0], &step.k[0]);
                    switches += 1;
                }

                if accepted && landing && !target.lt(span) {
                    if at_span_end(&step.y[0].get(0)).is_break() || interrupted() {
                        return Outcome::new::<O, N>(Ending::Stopped, attempts, switches);
                    }
                    h = number(span_step(h_begin.lane(0), h.lane(0)));
                    h_begin = h;
                    memory = Memory::new(span);
                    t = number(0.0);
                    steps_in_span = 0;
                } else if steps_in_span >= tolerances.max_steps || h.lt(span * MIN_STEP) {
                    return Outcome::new::<O, N>(Ending::of_failure(error.lane(0)), attempts, switches);
                } else if steps_in_span % INTERRUPT_STEPS == 0 && interrupted() {
                    return Outcome::new::<O, N>(Ending::Stopped, attempts, switches);
                }
            }
        },
    )
}
