//! Size of the error of a step, relative to the tolerances.

use crate::num::Lanes;

/// Returns the mean square of the errors of a step, each divided by its tolerance. The formula is Hairer I,
/// Eq. (II.4.11), without the square root. A step is accepted if the result is below 1.
///
/// ```text
/// 1/N Σᵢ (eᵢ / (atolᵢ + rtol max(|yᵢ|, |yᵢ new|)))²
/// ```
///
/// Each quotient has an error of up to 0.2 %, because an approximate reciprocal replaces the division.
#[inline(always)]
pub fn error_squared<R: Lanes, const N: usize>(
    error: &[R; N],
    [y, y_new]: [&[R; N]; 2],
    atol: &[R; N],
    rtol: R,
) -> R {
    add_squares(rtol.lit(0.0), error, [y, y_new], atol, rtol) * (1.0 / N as f64)
}

/// Returns `sum` plus the squares of the errors of a step, each divided by its tolerance.
#[inline(always)]
pub(super) fn add_squares<R: Lanes, const N: usize>(
    mut sum: R,
    error: &[R; N],
    [y, y_new]: [&[R; N]; 2],
    atol: &[R; N],
    rtol: R,
) -> R {
    for i in 0..N {
        let tolerance = rtol.mul_add(y[i].abs().max(y_new[i].abs()), atol[i]);
        let ratio = error[i] * tolerance.rough_reciprocal();
        sum = ratio.mul_add(ratio, sum);
    }
    sum
}
