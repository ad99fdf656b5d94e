//! The step-size controller: from an error, whether to accept a step and how long the next should be.
//!
//! Proportional-integral control with the constants of DOPRI5 (Hairer I, section II.4 and the code):
//! safety 0.9, factors between 0.21 and 9.5 (there 0.2 and 10), β = 0.04, no growth right after a rejection.
//!
//! Factors are rounded to a few per octave. Motions that hardly differ are then integrated with the very same steps, and
//! their ends differ as little: otherwise a period's end would jitter by the integration error, and a tight tolerance on
//! periodic motion would not be met.

use crate::num::Lanes;

const SAFETY_LOG2: f64 = -0.152_003_093_445_049_97; // log2 0.9
const BETA: f64 = 0.04;
const ALPHA: f64 = 0.2 - 0.75 * BETA;
/// Factors per octave.
const LEVELS: f64 = 8.0;
/// The smallest and the largest factor, in levels: 0.21 and 9.5.
const LEVEL_MIN: f64 = -18.0;
const LEVEL_MAX: f64 = 26.0;
/// 1.5 · 2^52: adding it rounds to a whole number.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// log2 of the square of 10^-4: an error smaller than this is remembered as this.
const LOG2_ERROR_MIN: f64 = -26.575_424_759_098_897;

/// What the controller remembers from step to step.
#[derive(Clone, Copy, Debug)]
pub struct Memory<R> {
    /// log2 of the square of the last accepted error.
    pub log2_error: R,
    /// The largest factor allowed now, in levels: 0, which is a factor of 1, right after a rejection.
    pub level_max: R,
}

impl<R: Lanes> Memory<R> {
    /// The memory of a run that has made no step.
    #[inline(always)]
    pub fn new(like: R) -> Memory<R> {
        Memory { log2_error: like.lit(LOG2_ERROR_MIN), level_max: like.lit(LEVEL_MAX) }
    }
}

/// What the controller decided.
#[derive(Clone, Copy)]
pub struct Verdict<R: Lanes> {
    /// Whether the step is accepted.
    pub accepted: R::Mask,
    /// By how much to multiply the step size.
    pub factor: R,
}

/// Judges a step by its squared error (see [`super::norm`]) and updates the memory. NaN is rejected.
#[inline(always)]
pub fn judge<R: Lanes>(error_squared: R, memory: &mut Memory<R>) -> Verdict<R> {
    let accepted = error_squared.lt(error_squared.lit(1.0));
    // Finite for any error, NaN included: the factor is then the smallest.
    let log2_error = rough_log2(error_squared);
    let zero = log2_error.lit(0.0);

    // log2 of 0.9 error^-α last^β, in levels; half of it because errors are squared.
    let own = log2_error.mul_add(zero.lit(-0.5 * LEVELS * ALPHA), zero.lit(LEVELS * SAFETY_LOG2));
    let last = R::select(accepted, memory.log2_error, zero);
    let level = (last.mul_add(zero.lit(0.5 * LEVELS * BETA), own) + ROUND) - ROUND;
    let level = level.max(zero.lit(LEVEL_MIN)).min(memory.level_max);

    let remembered = log2_error.max(zero.lit(LOG2_ERROR_MIN));
    memory.log2_error = R::select(accepted, remembered, memory.log2_error);
    memory.level_max = R::select(accepted, zero.lit(LEVEL_MAX), zero);
    Verdict { accepted, factor: rough_exp2(level * (1.0 / LEVELS)) }
}

/// log2 of a normal positive number to 10^-3, exact for powers of two. 1024 or more for NaN and infinity.
#[inline(always)]
fn rough_log2<R: Lanes>(x: R) -> R {
    let (exponent, mantissa) = x.exponent_and_mantissa();
    let f = mantissa - 1.0;
    // Minimax, and 1 at f = 1.
    let slope = f.mul_add(f.lit(0.159_219_181_177_909_34), f.lit(-0.582_084_010_769_231_8));
    slope.mul_add(f, f.lit(1.422_864_829_591_322_4)).mul_add(f, exponent)
}

/// 2^x for |x| up to 700, with a relative error of at most 10^-4; exact for whole numbers.
#[inline(always)]
fn rough_exp2<R: Lanes>(x: R) -> R {
    let k = (x + ROUND) - ROUND;
    let r = x - k;
    let slope = r.mul_add(r.lit(0.055_977_122_005_913_864), r.lit(0.242_223_863_477_723_57));
    slope.mul_add(r, r.lit(0.693_112_519_163_185)).mul_add(r, r.lit(1.0)).times_power_of_two(k)
}
