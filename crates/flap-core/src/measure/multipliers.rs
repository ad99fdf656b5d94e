//! The monodromy matrix of an orbit and its Floquet multipliers.

use nalgebra::DMatrix;
use nalgebra::linalg::Schur;

/// Largest number of iterations for the eigenvalues of a matrix. The eigenvalues usually converge within
/// about ten iterations.
const LONGEST: usize = 200;

/// Largest number of squarings in the stability test. Usually, about three squarings prove that a stable
/// matrix is stable. If the last squaring does not prove that the matrix is stable, the test computes the
/// eigenvalues.
const STABILITY_SQUARINGS: u32 = 8;

/// Number of times that a matrix is squared to compute its spectral radius. After `SQUARINGS` squarings, the
/// error of the spectral radius is of the order of rounding errors.
const SQUARINGS: u32 = 54;

/// A matrix of N rows and columns, in row-major order.
pub type Matrix<const N: usize> = [[f64; N]; N];

/// Returns the monodromy matrix, in units of the typical sizes `scale` of the states.
///
/// `responses[j]` is the change of the state after a period, if component j of the initial state changes by
/// its typical size `scale[j]`. Column j of the monodromy matrix is `responses[j]` in units of the typical
/// sizes.
pub(crate) fn monodromy<const N: usize>(responses: &[[f64; N]], scale: &[f64; N]) -> Matrix<N> {
    core::array::from_fn(|i| core::array::from_fn(|j| responses[j][i] / scale[i]))
}

/// Returns the identity matrix.
pub(crate) fn identity<const N: usize>() -> Matrix<N> {
    core::array::from_fn(|i| core::array::from_fn(|j| f64::from(u8::from(i == j))))
}

/// Returns the product `second * first`.
pub(crate) fn product<const N: usize>(second: &Matrix<N>, first: &Matrix<N>) -> Matrix<N> {
    core::array::from_fn(|i| core::array::from_fn(|j| (0..N).map(|k| second[i][k] * first[k][j]).sum()))
}

/// Returns true if every eigenvalue of the matrix is less than 1 in magnitude. If all eigenvalues are less
/// than 1 in magnitude, the powers of the matrix converge to zero.
pub(crate) fn is_stable<const N: usize>(m: &Matrix<N>) -> bool {
    let mut power = *m;
    for _ in 0..STABILITY_SQUARINGS {
        let row_sums = power.map(|row| row.iter().map(|x| x.abs()).sum());
        if row_sums.iter().all(|&sum: &f64| sum < 1.0) {
            return true;
        }
        power = product(&power, &power);
    }
    spectral_radius(m) < 1.0
}

/// Returns the largest magnitude of the eigenvalues. The result is NaN if an entry of the matrix is NaN, and
/// infinite if an entry is infinite.
pub fn spectral_radius<const N: usize>(m: &Matrix<N>) -> f64 {
    if m.iter().flatten().any(|x| x.is_nan()) {
        return f64::NAN;
    }
    if m.iter().flatten().any(|x| x.is_infinite()) {
        return f64::INFINITY;
    }
    let matrix = DMatrix::from_fn(N, N, |i, j| m[i][j]);
    // For some matrices the iteration does not converge.
    let Some(schur) = Schur::try_new(matrix, f64::EPSILON, LONGEST) else {
        return spectral_radius_by_powers(m);
    };
    let eigenvalues = schur.complex_eigenvalues();
    eigenvalues.iter().fold(0.0, |radius, value| libm::hypot(value.re, value.im).max(radius))
}

/// Returns the [`spectral_radius`] of a matrix with finite entries by Gelfand's formula, with repeated
/// squaring.
///
/// The spectral radius is the limit of the n-th root of the norm of the matrix's n-th power. flap uses this
/// function if the iteration for the eigenvalues does not converge.
pub fn spectral_radius_by_powers<const N: usize>(m: &Matrix<N>) -> f64 {
    let mut power = *m;
    let mut logarithm = 0.0;
    let mut share = 1.0;
    for _ in 0..SQUARINGS {
        let norm = power.iter().flatten().fold(0.0_f64, |norm, x| norm.max(x.abs()));
        if norm == 0.0 {
            return 0.0;
        }
        logarithm += share * libm::log(norm);
        share *= 0.5;
        let scaled = power.map(|row| row.map(|x| x / norm));
        power = product(&scaled, &scaled);
    }
    libm::exp(logarithm)
}
