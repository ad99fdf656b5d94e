//! Standard errors of parameters, and correlations between parameters.

use nalgebra::DMatrix;

/// Standard errors of parameters, and correlations between parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Uncertainty {
    /// Indices of parameters in ascending order, each with the standard error of the parameter in its SI
    /// unit.
    errors: Vec<(usize, f64)>,
    correlations: Vec<Correlation>,
}

/// Correlation of two parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// Indices of the two parameters in the model's parameter table.
    pub between: [usize; 2],
    /// Correlation coefficient, between -1 and 1.
    pub coefficient: f64,
}

impl Uncertainty {
    /// Returns true if no parameter has a standard error.
    pub fn is_empty(&self) -> bool {
        self.errors.is_empty()
    }

    /// Returns the indices of parameters in ascending order, each with the standard error of the parameter in its SI
    /// unit.
    pub fn errors(&self) -> &[(usize, f64)] {
        &self.errors
    }

    /// Returns the correlations that were given. Two parameters without a given correlation are not
    /// correlated.
    pub fn correlations(&self) -> &[Correlation] {
        &self.correlations
    }

    /// Returns the standard error of a parameter in its SI unit, if the parameter has a standard error.
    pub fn error(&self, parameter: usize) -> Option<f64> {
        self.errors.iter().find(|(index, _)| *index == parameter).map(|(_, error)| *error)
    }

    /// Sets or removes the standard error of a parameter. The correlations of the parameter are removed,
    /// because they refer to the earlier value of the parameter.
    pub(crate) fn set(&mut self, parameter: usize, error: Option<f64>) {
        self.errors.retain(|(index, _)| *index != parameter);
        self.correlations.retain(|correlation| !correlation.between.contains(&parameter));
        self.errors.extend(error.map(|error| (parameter, error)));
        self.errors.sort_by_key(|(index, _)| *index);
    }

    /// Sets the correlation of two parameters, and removes an earlier correlation of the same parameters.
    pub(crate) fn correlate(&mut self, correlation: Correlation) {
        let [one, other] = correlation.between;
        self.correlations.retain(|old| old.between != [one, other] && old.between != [other, one]);
        self.correlations.push(correlation);
    }

    /// Returns the lower triangular Cholesky factor L of the correlation matrix R = L Lᵀ. The factor has one
    /// row for each parameter in [`Uncertainty::errors`].
    ///
    /// If the correlations contradict each other, R is not positive definite, and the function returns
    /// `None`.
    pub(crate) fn factor(&self) -> Option<Vec<Vec<f64>>> {
        let n = self.errors.len();
        let mut matrix = DMatrix::identity(n, n);
        let place = |parameter: usize| self.errors.iter().position(|(index, _)| *index == parameter);
        for Correlation { between: [one, other], coefficient } in &self.correlations {
            if let (Some(row), Some(column)) = (place(*one), place(*other)) {
                matrix[(row, column)] = *coefficient;
                matrix[(column, row)] = *coefficient;
            }
        }
        let lower = matrix.cholesky()?.unpack();
        Some((0..n).map(|row| (0..=row).map(|column| lower[(row, column)]).collect()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uncertainty(coefficients: [f64; 3]) -> Uncertainty {
        let mut uncertainty = Uncertainty::default();
        for parameter in [7, 2, 5] {
            uncertainty.set(parameter, Some(1.0));
        }
        for (between, coefficient) in [[2, 5], [2, 7], [5, 7]].into_iter().zip(coefficients) {
            uncertainty.correlate(Correlation { between, coefficient });
        }
        uncertainty
    }

    #[test]
    fn the_factor_makes_the_correlations() {
        let rows = uncertainty([0.5, -0.3, 0.2]).factor().unwrap();
        let product = |i: usize, j: usize| rows[i].iter().zip(&rows[j]).map(|(a, b)| a * b).sum::<f64>();
        for (i, j, expected) in
            [(0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0), (0, 1, 0.5), (0, 2, -0.3), (1, 2, 0.2)]
        {
            assert!((product(i, j) - expected).abs() < 1e-15, "{i}, {j}: {}", product(i, j));
        }
    }

    #[test]
    fn contradictions_have_no_factor() {
        assert_eq!(uncertainty([0.9, 0.9, -0.9]).factor(), None);
    }

    #[test]
    fn a_new_value_ends_its_correlations() {
        let mut uncertainty = uncertainty([0.5, -0.3, 0.2]);
        uncertainty.set(5, Some(2.0));
        assert_eq!(uncertainty.correlations().len(), 1);
        assert_eq!(uncertainty.error(5), Some(2.0));
        uncertainty.set(5, None);
        assert_eq!(uncertainty.errors().iter().map(|(index, _)| *index).collect::<Vec<_>>(), [2, 7]);
    }
}
