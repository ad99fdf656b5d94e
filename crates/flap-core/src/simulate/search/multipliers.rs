//! The monodromy matrix of an orbit and its Floquet multipliers.

use nalgebra::DMatrix;
use nalgebra::linalg::Schur;

use crate::ode::variation::response;

/// Iterations for the eigenvalues of a matrix after which they are given up: some ten are usual.
const LONGEST: usize = 200;

/// Squarings of a matrix after which its powers tell its spectral radius to rounding.
const SQUARINGS: u32 = 54;

/// The monodromy matrix, given the end of a period with its responses to changes by `scale`. Column j: response to a change
/// of component j by its scale, in units of the scales.
pub(in crate::simulate) fn monodromy<const N: usize, const K: usize>(
    all: &[f64; K],
    scale: &[f64; N],
) -> [[f64; N]; N] {
    let mut monodromy = [[0.0; N]; N];
    for j in 0..N {
        let column = response::<N, K>(all, j);
        for i in 0..N {
            monodromy[i][j] = column[i] / scale[i];
        }
    }
    monodromy
}

/// The identity matrix.
pub(super) fn identity<const N: usize>() -> [[f64; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| f64::from(u8::from(i == j))))
}

/// The product `second * first`.
pub(super) fn product<const N: usize>(second: &[[f64; N]; N], first: &[[f64; N]; N]) -> [[f64; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| (0..N).map(|k| second[i][k] * first[k][j]).sum()))
}

/// Largest modulus of the eigenvalues; infinite if one of the matrix's components is, NaN if one is not a number.
pub(in crate::simulate) fn spectral_radius<const N: usize>(m: &[[f64; N]; N]) -> f64 {
    if m.iter().flatten().any(|x| x.is_nan()) {
        return f64::NAN;
    }
    if m.iter().flatten().any(|x| x.is_infinite()) {
        return f64::INFINITY;
    }
    let matrix = DMatrix::from_fn(N, N, |i, j| m[i][j]);
    // For some matrices the iteration for the eigenvalues does not end.
    let Some(schur) = Schur::try_new(matrix, f64::EPSILON, LONGEST) else {
        return spectral_radius_by_powers(m);
    };
    let eigenvalues = schur.complex_eigenvalues();
    eigenvalues.iter().fold(0.0, |radius, value| libm::hypot(value.re, value.im).max(radius))
}

/// The same by Gelfand's formula: the limit of the n-th root of the norm of the n-th power, by repeated squaring.
fn spectral_radius_by_powers<const N: usize>(m: &[[f64; N]; N]) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::{spectral_radius, spectral_radius_by_powers};

    fn assert_radius<const N: usize>(matrix: [[f64; N]; N], radius: f64) {
        for found in [spectral_radius(&matrix), spectral_radius_by_powers(&matrix)] {
            assert!((found - radius).abs() <= 1e-13 * radius, "{found} for {matrix:?}, not {radius}");
        }
    }

    #[test]
    fn spectral_radius_of_known_matrices() {
        assert_radius([[0.5, 100.0], [0.0, -0.25]], 0.5);
        assert_radius([[-0.7, 0.0], [0.0, 0.7]], 0.7);
        // Complex pair 0.3 ± 0.4 i.
        assert_radius([[0.3, -0.4], [0.4, 0.3]], 0.5);
        // A double eigenvalue with one eigenvector.
        assert_radius([[0.9, 1.0], [0.0, 0.9]], 0.9);
        assert_radius([[0.0, 1.0], [0.0, 0.0]], 0.0);
        assert_radius([[0.0; 3]; 3], 0.0);
        assert_radius([[1e-200, 0.0], [0.0, 1e-250]], 1e-200);
        assert_radius([[1e200, 0.0], [0.0, 1e250]], 1e250);
    }

    #[test]
    fn spectral_radius_of_a_matrix_for_which_the_qr_iteration_does_not_end() {
        // Of a wing of the small direct-drive type with three times the hinge stiffness.
        let matrix = [
            [0.716829871620778, -0.06433805565737562, 0.2709486576858242, -0.006971521642095943],
            [-0.47697096305704617, -0.07505796002278277, 0.02053453321083217, 0.08772767623270193],
            [-0.20975383030676636, -0.06096919247467027, 0.7073329173684636, -0.07152471565387758],
            [-0.3118221469593069, -0.4016506098467258, -0.49818152982218755, -0.11190367309843476],
        ];
        assert_radius(matrix, 0.775_618_305_047_727_9);
    }

    #[test]
    fn spectral_radius_without_a_value() {
        assert!(spectral_radius(&[[f64::NAN, 0.0], [0.0, 0.5]]).is_nan());
        assert!(spectral_radius(&[[f64::INFINITY, 0.0], [0.0, 0.5]]).is_infinite());
    }
}
