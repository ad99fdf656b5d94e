//! Axes: the values of varied parameters, of one parameter or of several that move together; and the parameter that a response
//! follows.
//! Values are computed on demand, so that an axis of 10^9 values costs nothing.

use std::sync::Arc;

use super::sample::{Design, Distribution, normal_quantile};

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

/// The axes of a design space, the last of which varies fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    axes: Vec<Axis>,
    points: u64,
}

/// Axes that have more than [`Axes::MAX_POINTS`] points between them.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the axes have more than 2^63 points between them")]
pub struct TooManyPoints {
    /// The place of the axis that is one too many.
    pub axis: usize,
    /// The length of each axis.
    pub lengths: Vec<u64>,
}

impl Axes {
    /// The largest number of points: 2^63.
    pub const MAX_POINTS: u64 = 1 << 63;

    /// The product of `axes`.
    ///
    /// # Errors
    /// [`TooManyPoints`] if it has more than [`Axes::MAX_POINTS`] points.
    pub fn new(axes: Vec<Axis>) -> Result<Axes, TooManyPoints> {
        // An axis without positions counts as one, so that the others can do without it.
        let mut product = 1_u64;
        for (place, axis) in axes.iter().enumerate() {
            product = product
                .checked_mul(axis.len().max(1))
                .filter(|product| *product <= Axes::MAX_POINTS)
                .ok_or_else(|| TooManyPoints {
                axis: place,
                lengths: axes.iter().map(Axis::len).collect(),
            })?;
        }
        let points = if axes.iter().any(Axis::is_empty) { 0 } else { product };
        Ok(Axes { axes, points })
    }

    /// The axes with `axis` before all others.
    ///
    /// # Errors
    /// [`TooManyPoints`] if the product has more than [`Axes::MAX_POINTS`] points.
    pub fn crossed_with(mut self, axis: Axis) -> Result<Axes, TooManyPoints> {
        self.axes.insert(0, axis);
        Axes::new(self.axes)
    }

    /// The axes without the one that varies `parameter` and no other, and the values of that axis; `None` if there is no
    /// such axis.
    pub(crate) fn without(mut self, parameter: usize) -> (Axes, Option<Values>) {
        let alone = |axis: &Axis| matches!(axis.parameters(), [(varied, _)] if *varied == parameter);
        let Some(place) = self.axes.iter().position(alone) else { return (self, None) };
        let axis = self.axes.remove(place);
        let points = self.axes.iter().map(Axis::len).product();
        let values = axis.parameters.into_iter().next().map(|(_, values)| values);
        (Axes { axes: self.axes, points }, values)
    }

    /// Number of points.
    pub fn points(&self) -> u64 {
        self.points
    }

    /// The axes, in the order of the grid file.
    pub fn as_slice(&self) -> &[Axis] {
        &self.axes
    }

    /// Indices of the varied parameters, in the order of the axes.
    pub fn varied(&self) -> impl Iterator<Item = usize> + '_ {
        self.parameters().map(|(parameter, _)| *parameter)
    }

    /// The varied parameters in the order of the axes, each with its values.
    pub fn parameters(&self) -> impl Iterator<Item = &(usize, Values)> + '_ {
        self.axes.iter().flat_map(Axis::parameters)
    }

    /// Puts the values of point number `index`, which must be less than [`Axes::points`], into `values`, which has one number
    /// per parameter of the model.
    pub fn fill(&self, index: u64, values: &mut [f64]) {
        let mut rest = index;
        for axis in self.axes.iter().rev() {
            let position = rest % axis.len();
            rest /= axis.len();
            for (parameter, along) in axis.parameters() {
                values[*parameter] = along.get(position);
            }
        }
    }
}

/// The parameter that rises and falls.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// Its index in the model's parameter table.
    pub parameter: usize,
    /// Its values, rising; two or more.
    pub values: Vec<f64>,
    /// Largest error of the ends of bistable bands, more than zero.
    pub tolerance: f64,
    /// True if the unstable orbits of bistable bands are looked for.
    pub unstable: bool,
}
