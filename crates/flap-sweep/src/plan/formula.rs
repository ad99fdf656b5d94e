//! Expressions of a plan: derived parameters, conditions, and the user's measures.

use crate::notation::expression::{Expression, Kind};

/// Parameters that are computed from other parameters.
#[derive(Clone, Debug, Default)]
pub struct Derived {
    /// Derived parameters in the order of the file, each as an index in the model's parameter table and an
    /// expression.
    formulas: Vec<(usize, Expression)>,
    /// Indices into `formulas`, in an order in which each formula comes after the formulas on which it
    /// depends.
    order: Vec<usize>,
}

impl Derived {
    /// Returns derived parameters with the given expressions. `order` contains the indices of the
    /// expressions, each after the expressions on which it depends.
    pub(crate) fn new(formulas: Vec<(usize, Expression)>, order: Vec<usize>) -> Derived {
        Derived { formulas, order }
    }

    /// Returns the indices of the derived parameters, in the order of the file.
    pub fn parameters(&self) -> impl Iterator<Item = usize> + '_ {
        self.formulas.iter().map(|(parameter, _)| *parameter)
    }

    /// Returns true if the value of `parameter` depends on `other`, directly or through other derived
    /// parameters.
    pub fn depends(&self, parameter: usize, other: usize) -> bool {
        let formula = self.formulas.iter().find(|(derived, _)| *derived == parameter);
        formula.is_some_and(|(_, formula)| {
            formula.reads().any(|read| read == other || self.depends(read, other))
        })
    }

    /// Computes the derived parameters of a point from the other parameters in `values`. Derived parameters
    /// in `except` keep their values.
    pub fn fill(&self, values: &mut [f64], except: &[usize]) {
        for &place in &self.order {
            let (parameter, expression) = &self.formulas[place];
            if !except.contains(parameter) {
                values[*parameter] = expression.value(values);
            }
        }
    }
}

/// A condition of a grid file. flap does not compute points that do not satisfy the condition.
#[derive(Clone, Debug)]
pub struct Condition {
    /// Name of the condition in the grid file.
    pub name: String,
    pub(crate) expression: Expression,
}

impl Condition {
    /// Returns true if a point with the parameter values `values` satisfies the condition. If the result is
    /// unknown, returns `None`.
    pub fn holds(&self, values: &[f64]) -> Option<bool> {
        let value = self.expression.value(values);
        (!value.is_nan()).then_some(value != 0.0)
    }
}

/// A column that the user defines by an expression of measures and parameters.
#[derive(Clone, Debug)]
pub struct OwnMeasure {
    /// Name of the measure in the grid file, which is also the name of its column.
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
