//! The step-size controller: it accepts or rejects a step by its error and chooses the next step size.
//!
//! Proportional-integral control with the constants of DOPRI5 (Hairer I, section II.4 and the code):
//! safety 0.9, factors between 0.21 and 9.5 (there 0.2 and 10), β = 0.04, no growth right after a rejection.
//!
//! Factors are rounded to a few per octave. Motions that hardly differ are then integrated with the very same steps, and
//! their ends differ as little: otherwise a period's end would jitter by the integration error, and a tight tolerance on
//! periodic motion would not be met.

use crate::num::Float;
use crate::num::functions::{rough_exp2, rough_log2, round};

const SAFETY_LOG2: f64 = -0.152_003_093_445_049_97; // log2 0.9
const BETA: f64 = 0.04;
const ALPHA: f64 = 0.2 - 0.75 * BETA;
/// Factors per octave.
const LEVELS: f64 = 8.0;
/// The smallest and the largest factor, in levels: 0.21 and 9.5.
const LEVEL_MIN: f64 = -18.0;
const LEVEL_MAX: f64 = 26.0;
/// log2 of the square of 10^-4: an error smaller than this is remembered as this.
const LOG2_ERROR_MIN: f64 = -26.575_424_759_098_897;

/// The controller's memory from step to step.
#[derive(Clone, Copy, Debug)]
pub struct Memory<R> {
    /// log2 of the square of the last accepted error.
    pub log2_error: R,
    /// The largest factor allowed now, in levels: 0, which is a factor of 1, right after a rejection.
    pub level_max: R,
}

impl<R: Float> Memory<R> {
    /// The memory of a run that has made no step.
    #[inline(always)]
    pub fn new(like: R) -> Memory<R> {
        Memory { log2_error: like.lit(LOG2_ERROR_MIN), level_max: like.lit(LEVEL_MAX) }
    }
}

/// A decision of the controller.
#[derive(Clone, Copy)]
pub struct Verdict<R: Float> {
    /// The step is accepted.
    pub accepted: R::Mask,
    /// The factor on the step size.
    pub factor: R,
}

/// Judges a step by its squared error (see [`super::norm`]) and updates the memory. NaN is rejected.
#[inline(always)]
pub fn judge<R: Float>(error_squared: R, memory: &mut Memory<R>) -> Verdict<R> {
    let accepted = error_squared.lt(error_squared.lit(1.0));
    // Finite for any error, NaN included: the factor is then the smallest.
    let log2_error = rough_log2(error_squared);
    let zero = log2_error.lit(0.0);

    // log2 of 0.9 error^-α last^β, in levels; half of it because errors are squared.
    let own = log2_error.mul_add(zero.lit(-0.5 * LEVELS * ALPHA), zero.lit(LEVELS * SAFETY_LOG2));
    let last = R::select(accepted, memory.log2_error, zero);
    let level = round(last.mul_add(zero.lit(0.5 * LEVELS * BETA), own));
    let level = level.max(zero.lit(LEVEL_MIN)).min(memory.level_max);

    let remembered = log2_error.max(zero.lit(LOG2_ERROR_MIN));
    memory.log2_error = R::select(accepted, remembered, memory.log2_error);
    memory.level_max = R::select(accepted, zero.lit(LEVEL_MAX), zero);
    Verdict { accepted, factor: rough_exp2(level * (1.0 / LEVELS)) }
}
