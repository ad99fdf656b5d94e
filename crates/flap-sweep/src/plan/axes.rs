//! The axes of a plan. An axis contains the values of one varied parameter, or of several parameters that
//! vary together. The module also contains the parameter that rises and falls in a response.
//!
//! Each value is computed when it is needed, so a range of 10^9 values takes no memory.

use std::sync::Arc;

use super::sample::{Distribution, SamplePoints, normal_quantile};

/// Values of one parameter along an axis, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Values from a list.
    List(Vec<f64>),
    /// Values from a list that a program provides. The values from a program are not checked, and may be out
    /// of range.
    Unchecked(Vec<f64>),
    /// `count` equidistant values from `from` to `to`, both included.
    Linear {
        /// First value.
        from: f64,
        /// Last value, without a rounding error.
        to: f64,
        /// Number of values.
        count: u64,
    },
    /// Equally spaced values, which are `from`, `from + step`, `from + 2 step`, and so on.
    Step {
        /// First value.
        from: f64,
        /// Distance between neighbouring values, which is negative if the values descend.
        step: f64,
        /// Number of values.
        count: u64,
    },
    /// `count` values from `from` to `to`, both included, with a constant ratio between neighbouring values.
    Log {
        /// First value.
        from: f64,
        /// Last value, without a rounding error.
        to: f64,
        /// Number of values.
        count: u64,
    },
    /// Values of a sampled parameter.
    Sampled {
        /// Points of the sample. All parameters of a sample use the same points.
        sample: Arc<SamplePoints>,
        /// Index of the sample's dimension that gives the values of the parameter.
        dimension: usize,
        /// Distribution that turns a coordinate of the sample into a value of the parameter.
        distribution: Distribution,
    },
    /// Values of a sampled parameter that has a normal distribution and is correlated with other sampled
    /// parameters.
    Correlated {
        /// Points of the sample. All parameters of a sample use the same points.
        sample: Arc<SamplePoints>,
        /// Mean of the distribution.
        mean: f64,
        /// Standard deviation of the distribution.
        sd: f64,
        /// Weights of independent normal random numbers. The weighted sum of the random numbers determines
        /// the value of the parameter. The random numbers are computed from the first coordinates of each
        /// point of the sample, and the sum of the squared weights is 1.
        weights: Vec<f64>,
    },
}

impl Values {
    /// Returns the number of values.
    pub fn len(&self) -> u64 {
        match self {
            Values::List(list) | Values::Unchecked(list) => list.len() as u64,
            Values::Linear { count, .. } | Values::Step { count, .. } | Values::Log { count, .. } => *count,
            Values::Sampled { sample, .. } | Values::Correlated { sample, .. } => sample.count(),
        }
    }

    /// Returns true if the axis has no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns value number `index`, which must be less than [`Values::len`].
    pub fn get(&self, index: u64) -> f64 {
        match *self {
            Values::List(ref list) | Values::Unchecked(ref list) => {
                usize::try_from(index).map_or(f64::NAN, |index| list[index])
            }
            Values::Linear { from, to, count } => match index {
                0 => from,
                _ if index + 1 == count => to,
                _ => decimal(from + (to - from) * index as f64 / (count - 1) as f64, from),
            },
            Values::Sampled { ref sample, dimension, ref distribution } => {
                distribution.quantile(sample.coordinate(index, dimension))
            }
            Values::Correlated { ref sample, mean, sd, ref weights } => {
                let normal = |dimension| normal_quantile(sample.coordinate(index, dimension));
                let number: f64 =
                    weights.iter().enumerate().map(|(dimension, weight)| weight * normal(dimension)).sum();
                mean + sd * number
            }
            Values::Step { from, step, .. } => decimal(from + step * index as f64, from),
            Values::Log { from, to, count } => match index {
                0 => from,
                _ if index + 1 == count => to,
                // libm instead of std, for equal bits on every machine.
                _ => from * libm::pow(to / from, index as f64 / (count - 1) as f64),
            },
        }
    }

    /// Returns the value at a position along the axis, from 0 to [`Values::len`] minus 1. If the position is
    /// a whole number, the result equals [`Values::get`].
    ///
    /// Between two values of the axis, the function interpolates with the linear or logarithmic spacing of
    /// the axis. Values from a sample or a program are not interpolated: the function returns the value
    /// before the position.
    pub(crate) fn at(&self, position: f64) -> f64 {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a position is not negative"
        )]
        let below = position as u64;
        let share = position - below as f64;
        if share == 0.0 {
            return self.get(below);
        }
        match *self {
            Values::Linear { from, to, count } => {
                decimal(from + (to - from) * position / (count - 1) as f64, from)
            }
            Values::Step { from, step, .. } => decimal(from + step * position, from),
            Values::Log { from, to, count } => from * libm::pow(to / from, position / (count - 1) as f64),
            Values::List(_) => {
                let [low, high] = [self.get(below), self.get(below + 1)];
                decimal(low + (high - low) * share, low)
            }
            Values::Unchecked(_) | Values::Sampled { .. } | Values::Correlated { .. } => self.get(below),
        }
    }
}

/// Returns `x` rounded to 15 significant digits. For example, 60e-6 + 10e-6 gives 70e-6 and not 7.000000000000001e-5.
///
/// `from` is the first summand of `x`. If `x` is only a rounding error compared with `from`, the function
/// returns zero.
fn decimal(x: f64, from: f64) -> f64 {
    if x.abs() < 1e-14 * from.abs() {
        return 0.0;
    }
    format!("{x:.14e}").parse().unwrap_or(x)
}

/// An axis, along which one parameter varies, or several parameters vary together.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub(super) parameters: Vec<(usize, Values)>,
}

impl Axis {
    /// Returns an axis along which the given parameters vary. Each item of `parameters` is an index into the
    /// model's parameter table, with the values of the parameter.
    pub fn new(parameters: Vec<(usize, Values)>) -> Axis {
        Axis { parameters }
    }

    /// Returns the parameters that vary along the axis, as indices into the model's parameter table, each
    /// with its values.
    pub fn parameters(&self) -> &[(usize, Values)] {
        &self.parameters
    }

    /// Returns the number of positions along the axis: the length of the shortest list of values.
    pub fn len(&self) -> u64 {
        self.parameters.iter().map(|(_, values)| values.len()).min().unwrap_or(0)
    }

    /// Returns true if the axis has no positions.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The axes of a plan. From point to point, the last axis varies fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    axes: Vec<Axis>,
    points: u64,
}

/// Error if axes have more than [`Axes::MAX_POINTS`] points in total.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the axes have more than 2^63 points in total")]
pub struct TooManyPoints {
    /// Index of the first axis with which the number of points exceeds the limit.
    pub axis: usize,
    /// Length of each axis.
    pub lengths: Vec<u64>,
}

impl Axes {
    /// Largest number of points: 2^63.
    pub const MAX_POINTS: u64 = 1 << 63;

    /// Combines `axes`: the points are all combinations of the values of the axes.
    ///
    /// # Errors
    /// [`TooManyPoints`] if there are more than [`Axes::MAX_POINTS`] points.
    pub fn new(axes: Vec<Axis>) -> Result<Axes, TooManyPoints> {
        // An axis without positions counts as one, so that the others are still checked against the limit.
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

    /// Returns an empty list of axes. A plan without axes has one point.
    pub(crate) fn none() -> Axes {
        Axes { axes: Vec::new(), points: 1 }
    }

    /// Adds `axis` before all other axes.
    ///
    /// # Errors
    /// [`TooManyPoints`] if there are more than [`Axes::MAX_POINTS`] points.
    pub fn crossed_with(mut self, axis: Axis) -> Result<Axes, TooManyPoints> {
        self.axes.insert(0, axis);
        Axes::new(self.axes)
    }

    /// Removes the axis that varies only `parameter`. Returns the remaining axes, and the values of the
    /// removed axis if there was such an axis.
    pub(crate) fn without(mut self, parameter: usize) -> (Axes, Option<Values>) {
        let alone = |axis: &Axis| matches!(axis.parameters(), [(varied, _)] if *varied == parameter);
        let Some(place) = self.axes.iter().position(alone) else { return (self, None) };
        let axis = self.axes.remove(place);
        let points = self.axes.iter().map(Axis::len).product();
        let values = axis.parameters.into_iter().next().map(|(_, values)| values);
        (Axes { axes: self.axes, points }, values)
    }

    /// Returns the number of points.
    pub fn points(&self) -> u64 {
        self.points
    }

    /// Returns the axes, in the order of the grid file.
    pub fn as_slice(&self) -> &[Axis] {
        &self.axes
    }

    /// Returns the indices of the varied parameters, in the order of the axes.
    pub fn varied(&self) -> impl Iterator<Item = usize> + '_ {
        self.parameters().map(|(parameter, _)| *parameter)
    }

    /// Returns the varied parameters in the order of the axes, each with its values.
    pub fn parameters(&self) -> impl Iterator<Item = &(usize, Values)> + '_ {
        self.axes.iter().flat_map(Axis::parameters)
    }

    /// Writes the values of point number `index` into `values`.
    ///
    /// `index` must be less than [`Axes::points`]. `values` has one number per parameter of the model.
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

    /// Writes the parameter values at the given positions into `values`. There is one position for each axis,
    /// from 0 to the length of the axis minus 1.
    pub(crate) fn fill_between(&self, positions: &[f64], values: &mut [f64]) {
        for (axis, position) in self.axes.iter().zip(positions) {
            for (parameter, along) in axis.parameters() {
                values[*parameter] = along.at(*position);
            }
        }
    }

    /// Returns true if there is one position for each axis, and each position is from 0 to the length of the
    /// axis minus 1.
    pub(crate) fn contain(&self, positions: &[f64]) -> bool {
        let within = |(axis, position): (&Axis, &f64)| (0.0..=(axis.len() as f64 - 1.0)).contains(position);
        positions.len() == self.axes.len() && self.axes.iter().zip(positions).all(within)
    }
}

/// The parameter that rises and falls in a response.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// Index of the parameter in the model's parameter table.
    pub parameter: usize,
    /// At least two values of the parameter, in ascending order.
    pub values: Vec<f64>,
    /// Largest allowed error of the parameter value at an end of a bistable band. The allowed error must be
    /// more than zero.
    pub tolerance: f64,
    /// True if the unstable orbits in bistable bands are computed.
    pub unstable: bool,
}
