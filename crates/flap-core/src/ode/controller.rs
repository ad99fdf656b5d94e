//! The step-size controller: from an error, whether to accept a step and how long the next should be.
//!
//! Proportional-integral control with the constants of DOPRI5 (Hairer I, section II.4 and the code):
//! safety 0.9, factors between 0.2 and 10, β = 0.04, no growth right after a rejection.
//!
//! Factors are rounded to a few per octave. Motions that hardly differ are then integrated with the very same steps, and
//! their ends differ as little: otherwise a period's end would jitter by the integration error, and a tight tolerance on
//! periodic motion would not be met.

use core::f64::consts::LN_2;

use crate::num::Lanes;

const SAFETY_LN: f64 = -0.105_360_515_657_826_3; // ln 0.9
const FACTOR_MIN: f64 = 0.2;
const FACTOR_MAX: f64 = 10.0;
const BETA: f64 = 0.04;
const ALPHA: f64 = 0.2 - 0.75 * BETA;
/// Factors per octave.
const LEVELS: f64 = 8.0;
/// 1.5 · 2^52: adding it rounds to a whole number.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// ln 10^-4: an error smaller than this is remembered as this.
const LN_ERROR_MIN: f64 = -9.210_340_371_976_182;

/// What the controller remembers from step to step.
#[derive(Clone, Copy, Debug)]
pub struct Memory<R> {
    /// Logarithm of the last accepted error.
    pub ln_error: R,
    /// Largest factor allowed now: 1 right after a rejection.
    pub factor_max: R,
}

impl<R: Lanes> Memory<R> {
    /// The memory of a run that has made no step.
    #[inline(always)]
    pub fn new(like: R) -> Memory<R> {
        Memory { ln_error: like.lit(LN_ERROR_MIN), factor_max: like.lit(FACTOR_MAX) }
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
    let ln_error = error_squared.ln() * 0.5;

    let history = R::select(accepted, memory.ln_error * BETA, ln_error.lit(0.0));
    let ln_factor = ln_error.mul_add(ln_error.lit(-ALPHA), history) + SAFETY_LN;
    // exp is for |x| up to 700, and no factor above e³ or below e⁻³ survives the next line.
    let ln_factor = ln_factor.max(ln_factor.lit(-3.0)).min(ln_factor.lit(3.0));
    let level = ln_factor.mul_add(ln_factor.lit(LEVELS / LN_2), ln_factor.lit(ROUND)) - ROUND;
    let factor = (level * (LN_2 / LEVELS)).exp().max(ln_factor.lit(FACTOR_MIN)).min(memory.factor_max);

    let remembered = ln_error.max(ln_error.lit(LN_ERROR_MIN));
    memory.ln_error = R::select(accepted, remembered, memory.ln_error);
    memory.factor_max = R::select(accepted, factor.lit(FACTOR_MAX), factor.lit(1.0));
    Verdict { accepted, factor }
}
