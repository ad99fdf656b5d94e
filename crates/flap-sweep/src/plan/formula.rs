//! Expressions of a plan: derived parameters, conditions, and measures of the user's own.

use crate::notation::expression::{Expression, Kind};

/// Parameters that are computed from others.
#[derive(Clone, Debug, Default)]
pub struct Derived {
    /// Indices into the model's parameter table with their expressions, in the order of the file.
    formulas: Vec<(usize, Expression)>,
    /// Places in `formulas`, each behind those that it depends on.
    order: Vec<usize>,
}

impl Derived {
    /// The parameters with these expressions, computed in this order, in which each must stand behind those that its
    /// expression reads.
    pub(crate) fn new(formulas: Vec<(usize, Expression)>, order: Vec<usize>) -> Derived {
        Derived { formulas, order }
    }

    /// Indices of the parameters, in the order of the file.
    pub fn parameters(&self) -> impl Iterator<Item = usize> + '_ {
        self.formulas.iter().map(|(parameter, _)| *parameter)
    }

    /// Computes the parameters, but for those in `except`, from the other `values` of a point.
    pub fn fill(&self, values: &mut [f64], except: &[usize]) {
        for &place in &self.order {
            let (parameter, expression) = &self.formulas[place];
            if !except.contains(parameter) {
                values[*parameter] = expression.value(values);
            }
        }
    }
}

/// A condition that points satisfy, or are not run.
#[derive(Clone, Debug)]
pub struct Condition {
    /// Its name in the grid file.
    pub name: String,
    pub(crate) expression: Expression,
}

impl Condition {
    /// True if the point with these values satisfies it; `None` if that is not known.
    pub fn holds(&self, values: &[f64]) -> Option<bool> {
        let value = self.expression.value(values);
        (!value.is_nan()).then_some(value != 0.0)
    }
}

/// A column that is computed from the model's measures and the parameters.
#[derive(Clone, Debug)]
pub struct OwnMeasure {
    /// Its name in the grid file, and of the column.
    pub name: String,
    pub(crate) expression: Expression,
}

impl OwnMeasure {
    /// The type of its values: a number, or true or false.
    pub fn kind(&self) -> Kind {
        self.expression.kind()
    }

    /// Its value where parameters, the model's measures and the measures above it have these values, one behind the
    /// other. NaN if the value is not finite or not known.
    pub(crate) fn value(&self, values: &[f64]) -> f64 {
        let value = self.expression.value(values);
        if value.is_finite() { value } else { f64::NAN }
    }
}
