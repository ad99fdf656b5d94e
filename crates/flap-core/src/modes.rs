//! Natural frequencies of small undamped motions.

use core::f64::consts::PI;

use nalgebra::{Matrix2, Vector2};

/// Name and natural frequency of a small undamped oscillation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Name, such as `mode_1`.
    pub name: &'static str,
    /// Natural frequency (Hz).
    pub frequency: f64,
}

impl Mode {
    /// Returns modes with the given names and natural frequencies (Hz).
    pub(crate) fn of<const N: usize>(names: [&'static str; N], frequencies: [f64; N]) -> Vec<Mode> {
        names.into_iter().zip(frequencies).map(|(name, frequency)| Mode { name, frequency }).collect()
    }

    /// Returns the two modes of the equation M q̈ + diag(K) q = 0, in ascending order of frequency.
    ///
    /// If the mass matrix M with the entries [M₁₁, M₁₂, M₂₂] is not positive definite, both frequencies are
    /// NaN. For each negative entry of `stiffness`, one frequency is NaN.
    pub(crate) fn coupled([m11, m12, m22]: [f64; 3], stiffness: [f64; 2]) -> Vec<Mode> {
        // M = L Lᵀ leads to an ordinary symmetric eigenvalue problem, L⁻¹ K L⁻ᵀ.
        let inverse =
            Matrix2::new(m11, m12, m12, m22).cholesky().and_then(|cholesky| cholesky.l().try_inverse());
        let mut frequencies = inverse.map_or([f64::NAN; 2], |inverse| {
            let squares = (inverse * Matrix2::from_diagonal(&Vector2::from(stiffness)) * inverse.transpose())
                .symmetric_eigenvalues();
            [squares[0], squares[1]].map(|square| square.sqrt() / (2.0 * PI))
        });
        frequencies.sort_by(f64::total_cmp);
        Mode::of(["mode_1", "mode_2"], frequencies)
    }
}
