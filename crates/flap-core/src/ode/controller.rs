//! Step-size controller: it accepts or rejects a step by its error, and chooses the next step size.
//!
//! The method is proportional-integral control with the constants of DOPRI5 (Hairer I, section II.4 and the code).
//! The safety factor is 0.9, β is 0.04, and there is no growth right after a rejection. Factors lie between 0.21 and
//! 9.5 (0.2 and 10 in DOPRI5).
//!
//! Factors are rounded to a few per octave. Motions that hardly differ are then integrated with exactly the same
//! steps, and their final states differ just as little. Otherwise the state at the end of a period would vary by the
//! integration error, and a motion would not meet a tight settling tolerance.

use crate::num::Lanes;

const SAFETY_LOG2: f64 = -0.152_003_093_445_049_97; // log2 0.9
const BETA: f64 = 0.04;
const ALPHA: f64 = 0.2 - 0.75 * BETA;
/// Smallest and largest factor, in octaves: 0.21 and 9.5.
const OCTAVES_MIN: f64 = -18.0 / 8.0;
const OCTAVES_MAX: f64 = 26.0 / 8.0;
/// log2 of the square of 10^-4. Smaller errors are stored as this value.
const LOG2_ERROR_MIN: f64 = -26.575_424_759_098_897;

/// Memory of the controller from step to step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Memory<R> {
    /// log2 of the square of the last accepted error.
    pub log2_error: R,
    /// Largest factor allowed for the next step, in octaves. It is 0 (a factor of 1) right after a rejection.
    pub(super) octaves_max: R,
}

impl<R: Lanes> Memory<R> {
    /// Returns the memory of a run before its first step.
    #[inline(always)]
    pub(super) fn new(like: R) -> Memory<R> {
        Memory { log2_error: like.lit(LOG2_ERROR_MIN), octaves_max: like.lit(OCTAVES_MAX) }
    }
}

/// Decision of the controller.
#[derive(Clone, Copy)]
pub(super) struct Verdict<R: Lanes> {
    /// True if the step is accepted.
    pub(super) accepted: R::Mask,
    /// Factor on the step size.
    pub(super) factor: R,
}

/// Returns the decision on a step with this squared error (see [`super::norm`]), and updates the memory. NaN is
/// rejected.
#[inline(always)]
pub(super) fn judge<R: Lanes>(error_squared: R, memory: &mut Memory<R>) -> Verdict<R> {
    let accepted = error_squared.lt(error_squared.lit(1.0));
    // Finite for any error, including NaN: the factor is then the smallest.
    let log2_error = error_squared.linear_log2();
    let zero = log2_error.lit(0.0);

    // log2 of 0.9 error^-α last^β, with half exponents because errors are squared.
    let own = log2_error.mul_add(zero.lit(-0.5 * ALPHA), zero.lit(SAFETY_LOG2));
    let last = R::select(accepted, memory.log2_error, zero);
    let octaves = last.mul_add(zero.lit(0.5 * BETA), own);
    let octaves = octaves.max(zero.lit(OCTAVES_MIN)).min(memory.octaves_max);
    let octaves = octaves.round_to_eighths();

    let remembered = log2_error.max(zero.lit(LOG2_ERROR_MIN));
    memory.log2_error = R::select(accepted, remembered, memory.log2_error);
    memory.octaves_max = R::select(accepted, zero.lit(OCTAVES_MAX), zero);
    Verdict { accepted, factor: octaves.rough_exp2() }
}
