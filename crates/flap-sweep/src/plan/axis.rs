//! The values of varied parameters: of one parameter, or of several that move together.
//! Values are computed on demand, so that an axis of 10^9 values costs nothing.

use std::sync::Arc;

use crate::plan::sample::{Design, Distribution, normal_quantile};

/// The values of one parameter along an axis, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Values given one by one.
    List(Vec<f64>),
    /// Values that a program gives one by one, and nobody has checked: some may be out of range.
    Unchecked(Vec<f64>),
    /// `count` values evenly spaced from `from` to `to`, both included.
    Linear {
        /// First value.
        from: f64,
        /// Last value, exact.
        to: f64,
        /// Number of values.
        count: u64,
    },
    /// `from`, `from + step`, `from + 2 step`, and so on.
    Step {
        /// First value.
        from: f64,
        /// Distance between values; negative for a falling axis.
        step: f64,
        /// Number of values.
        count: u64,
    },
    /// `count` values from `from` to `to`, both included, in constant ratio.
    Log {
        /// First value.
        from: f64,
        /// Last value, exact.
        to: f64,
        /// Number of values.
        count: u64,
    },
    /// The points of a sample along one of its dimensions.
    Sampled {
        /// The points, shared by all parameters of the sample.
        design: Arc<Design>,
        /// The dimension.
        dimension: usize,
        /// The distribution that carries its coordinate over to the parameter.
        distribution: Distribution,
    },
    /// The points of a sample of normal distributions that are correlated.
    Correlated {
        /// The points, shared by all parameters of the sample.
        design: Arc<Design>,
        /// Mean.
        mean: f64,
        /// Standard deviation.
        sd: f64,
        /// Weights of the first dimensions' independent normal numbers in this parameter's; the squares sum to 1.
        weights: Vec<f64>,
    },
}

impl Values {
    /// Number of values.
    pub fn len(&self) -> u64 {
        match self {
            Values::List(list) | Values::Unchecked(list) => list.len() as u64,
            Values::Linear { count, .. } | Values::Step { count, .. } | Values::Log { count, .. } => *count,
            Values::Sampled { design, .. } | Values::Correlated { design, .. } => design.count(),
        }
    }

    /// True if there are no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Value number `index`, which must be less than [`Values::len`].
    pub fn get(&self, index: u64) -> f64 {
        match *self {
            Values::List(ref list) | Values::Unchecked(ref list) => {
                usize::try_from(index).map_or(f64::NAN, |index| list[index])
            }
            Values::Linear { from, to, count } => match index {
                0 => from,
                _ if index + 1 == count => to,
                _ => decimal(from + (to - from) * index as f64 / (count - 1) as f64),
            },
            Values::Sampled { ref design, dimension, ref distribution } => {
                distribution.quantile(design.coordinate(index, dimension))
            }
            Values::Correlated { ref design, mean, sd, ref weights } => {
                let normal = |dimension| normal_quantile(design.coordinate(index, dimension));
                let number: f64 =
                    weights.iter().enumerate().map(|(dimension, weight)| weight * normal(dimension)).sum();
                mean + sd * number
            }
            Values::Step { from, step, .. } => decimal(from + step * index as f64),
            Values::Log { from, to, count } => match index {
                0 => from,
                _ if index + 1 == count => to,
                // libm, not std: the same bits on every machine.
                _ => from * libm::pow(to / from, index as f64 / (count - 1) as f64),
            },
        }
    }
}

/// `x` to 15 significant digits, so that 60e-6 and 10e-6 more make the 70e-6 one would write, and not its
/// neighbour 7.000000000000001e-5.
fn decimal(x: f64) -> f64 {
    format!("{x:.14e}").parse().unwrap_or(x)
}

/// One axis: one or more parameters that move together.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub(super) parameters: Vec<(usize, Values)>,
}

impl Axis {
    /// The axis of these parameters: indices into the model's parameter table, each with its values.
    pub fn new(parameters: Vec<(usize, Values)>) -> Axis {
        Axis { parameters }
    }

    /// Indices into the model's parameter table, each with its values.
    pub fn parameters(&self) -> &[(usize, Values)] {
        &self.parameters
    }

    /// Number of positions along the axis: the length of its shortest list of values.
    pub fn len(&self) -> u64 {
        self.parameters.iter().map(|(_, values)| values.len()).min().unwrap_or(0)
    }

    /// True if the axis has no positions.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
