//! The step-size controller accepts or rejects a step according to the error of the step, and chooses the
//! next step size.
//!
//! The method is proportional-integral control, with the constants in section II.4 of Hairer I and in the
//! code DOPRI5. The safety factor is 0.9, and β is 0.04. Right after a rejected step, the step size does not
//! grow. The next step size is 0.21 to 9.5 times the last step size (0.2 to 10 times in DOPRI5).
//!
//! The base-2 logarithm of the factor between two step sizes is rounded to a multiple of 1/8. Two motions
//! that hardly differ are therefore integrated with exactly the same steps, and their final states also
//! hardly differ. Without the rounding of step sizes, the states at the ends of successive periods would
//! differ by the integration error. With these differences, a motion would not repeat within a tight settling
//! tolerance.

use crate::num::Lanes;

const SAFETY_LOG2: f64 = -0.152_003_093_445_049_97; // log2 0.9
const BETA: f64 = 0.04;
const ALPHA: f64 = 0.2 - 0.75 * BETA;
/// Base-2 logarithms of the smallest and the largest factor between two step sizes, 0.21 and 9.5.
const OCTAVES_MIN: f64 = -18.0 / 8.0;
const OCTAVES_MAX: f64 = 26.0 / 8.0;
/// Base-2 logarithm of 10^-8, the smallest squared error that the controller stores. Squared errors below
/// 10^-8 are stored as 10^-8.
const LOG2_ERROR_MIN: f64 = -26.575_424_759_098_897;

/// Values that the controller keeps from one step to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Memory<R> {
    /// Base-2 logarithm of the squared error of the last accepted step.
    pub log2_error: R,
    /// Base-2 logarithm of the largest allowed ratio of the next step size to the last step size. The
    /// logarithm is 0 (a ratio of 1) right after a rejected step.
    pub(super) octaves_max: R,
}

impl<R: Lanes> Memory<R> {
    /// Returns the values of the controller before the first step of a run.
    #[inline(always)]
    pub(super) fn new(like: R) -> Memory<R> {
        Memory { log2_error: like.lit(LOG2_ERROR_MIN), octaves_max: like.lit(OCTAVES_MAX) }
    }
}

/// Decision of the controller on an attempted step.
#[derive(Clone, Copy)]
pub(super) struct Verdict<R: Lanes> {
    /// True if the step is accepted.
    pub(super) accepted: R::Mask,
    /// Ratio of the next step size to the size of the attempted step.
    pub(super) factor: R,
}

/// Returns the decision on a step with the given squared error (see [`super::norm`]), and updates `memory`. A
/// step whose error is NaN is rejected.
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
