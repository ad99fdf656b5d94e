//! Expressions of a plan: derived parameters, conditions, and the user's measures.

use crate::notation::expression::{Expression, Kind};

/// Parameters that are computed from other parameters.
#[derive(Clone, Debug, Default)]
pub struct Derived {
    /// Indices into the model's parameter table with their expressions, in the order of the file.
    formulas: Vec<(usize, Expression)>,
    /// Indices of `formulas` in an order in which each formula is after the formulas on which it depends.
    order: Vec<usize>,
}

impl Derived {
    /// Returns parameters with the given expressions, which are computed in the given `order`. In `order`, each
    /// expression must be after its dependencies.
    pub(crate) fn new(formulas: Vec<(usize, Expression)>, order: Vec<usize>) -> Derived {
        Derived { formulas, order }
    }

    /// Returns the indices of the parameters, in the order of the file.
    pub fn parameters(&self) -> impl Iterator<Item = usize> + '_ {
        self.formulas.iter().map(|(parameter, _)| *parameter)
    }

    /// Returns true if a parameter is computed from `other`, directly or by other formulas.
    pub fn depends(&self, parameter: usize, other: usize) -> bool {
        let formula = self.formulas.iter().find(|(derived, _)| *derived == parameter);
        formula.is_some_and(|(_, formula)| {
            formula.reads().any(|read| read == other || self.depends(read, other))
        })
    }

    /// Computes the parameters from the other `values` of a point, except parameters in `except`.
    pub fn fill(&self, values: &mut [f64], except: &[usize]) {
        for &place in &self.order {
            let (parameter, expression) = &self.formulas[place];
            if !except.contains(parameter) {
                values[*parameter] = expression.value(values);
            }
        }
    }
}

/// A condition. Points that do not satisfy the condition are not run.
#[derive(Clone, Debug)]
pub struct Condition {
    /// Name in the grid file.
    pub name: String,
    pub(crate) expression: Expression,
}

impl Condition {
    /// Returns true if the point with these values satisfies the condition; `None` if the result is unknown.
    pub fn holds(&self, values: &[f64]) -> Option<bool> {
        let value = self.expression.value(values);
        (!value.is_nan()).then_some(value != 0.0)
    }
}

/// A column computed from the model's measures and the parameters.
#[derive(Clone, Debug)]
pub struct OwnMeasure {
    /// Name in the grid file and of the column.
    pub name: String,
    pub(crate) expression: Expression,
}

impl OwnMeasure {
    /// Returns the type of the measure's values: a number, or true or false.
    pub fn kind(&self) -> Kind {
        self.expression.kind()
    }

    /// Returns the value of the measure. `values` contains the parameters, the model's measures, and the user's
    /// measures that precede this measure.
    ///
    /// Returns NaN if the value is unknown or not finite.
    pub(crate) fn value(&self, values: &[f64]) -> f64 {
        let value = self.expression.value(values);
        if value.is_finite() { value } else { f64::NAN }
    }
}
