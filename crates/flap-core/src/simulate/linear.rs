//! Solution of the small linear systems of Newton's method for periodic orbits, without memory allocation.

use crate::measure::multipliers::{Matrix, identity};

/// Largest allowed condition number of a linear system. If the condition number exceeds this limit, the
/// solution may have no correct digit.
const MAX_CONDITION: f64 = 1e15;

/// LU decomposition of a matrix with row pivoting.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lu<const N: usize> {
    /// The factor U, and below its diagonal the factor L. The diagonal of L consists of ones and is not
    /// stored.
    factors: Matrix<N>,
    /// For each row of the factors, the index of the corresponding row of the original matrix.
    rows: [usize; N],
}

impl<const N: usize> Lu<N> {
    /// Returns the LU decomposition of I − M for a monodromy matrix M. Returns `None` if I − M is singular
    /// within rounding errors or not finite.
    pub(super) fn of_identity_minus(m: &Matrix<N>) -> Option<Lu<N>> {
        let mut matrix = identity();
        for i in 0..N {
            for j in 0..N {
                matrix[i][j] -= m[i][j];
            }
        }
        let lu = Lu::of(matrix);
        // This comparison is also false for NaN.
        (row_sum(&matrix) * row_sum(&lu.inverse()) <= MAX_CONDITION).then_some(lu)
    }

    fn of(mut a: Matrix<N>) -> Lu<N> {
        let mut rows = core::array::from_fn(|i| i);
        for k in 0..N {
            let pivot = (k..N).fold(k, |best, i| if a[i][k].abs() > a[best][k].abs() { i } else { best });
            a.swap(k, pivot);
            rows.swap(k, pivot);
            for i in k + 1..N {
                a[i][k] /= a[k][k];
                for j in k + 1..N {
                    a[i][j] -= a[i][k] * a[k][j];
                }
            }
        }
        Lu { factors: a, rows }
    }

    /// Returns the solution x of the linear system A x = b, where A is the decomposed matrix.
    pub(super) fn solve(&self, b: &[f64; N]) -> [f64; N] {
        let Lu { factors, rows } = self;
        let mut x = rows.map(|row| b[row]);
        for i in 0..N {
            for j in 0..i {
                x[i] -= factors[i][j] * x[j];
            }
        }
        for i in (0..N).rev() {
            for j in i + 1..N {
                x[i] -= factors[i][j] * x[j];
            }
            x[i] /= factors[i][i];
        }
        x
    }

    /// Returns the inverse of the decomposed matrix, in row-major order.
    pub(super) fn inverse(&self) -> Matrix<N> {
        let columns = identity().map(|unit| self.solve(&unit));
        core::array::from_fn(|i| core::array::from_fn(|j| columns[j][i]))
    }
}

/// Returns the row-sum norm of a matrix: for each row the magnitudes are added, and the largest sum is the
/// norm.
fn row_sum<const N: usize>(matrix: &Matrix<N>) -> f64 {
    let sums = matrix.map(|row| row.iter().map(|x| x.abs()).sum::<f64>());
    sums.into_iter().fold(0.0, |largest, sum| if sum.is_nan() { sum } else { sum.max(largest) })
}
