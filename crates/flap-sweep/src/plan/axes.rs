//! Axes: the values of one varied parameter, or of several parameters that vary together. The module also contains the
//! followed parameter of a response.
//!
//! Values are computed on demand, so an axis of 10^9 values takes no memory.

use std::sync::Arc;

use super::sample::{Distribution, SamplePoints, normal_quantile};

/// Values of one parameter along an axis, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Listed values.
    List(Vec<f64>),
    /// Listed and unchecked values from a program. Some of these values may be out of range.
    Unchecked(Vec<f64>),
    /// `count` equidistant values from `from` to `to`, both included.
    Linear {
        /// First value.
        from: f64,
        /// Last value, exact.
        to: f64,
        /// Number of values.
        count: u64,
    },
    /// Equally spaced values: `from`, `from + step`, `from + 2 step`, and so on.
    Step {
        /// First value.
        from: f64,
        /// Distance between values; negative for a descending axis.
        step: f64,
        /// Number of values.
        count: u64,
    },
    /// `count` values from `from` to `to`, both included, with a constant ratio.
    Log {
        /// First value.
        from: f64,
        /// Last value, exact.
        to: f64,
        /// Number of values.
        count: u64,
    },
    /// Points of a sample along one of its dimensions.
    Sampled {
        /// Points of the sample, which are the same for all parameters of the sample.
        sample: Arc<SamplePoints>,
        /// The dimension.
        dimension: usize,
        /// Distribution that maps the coordinate to the parameter.
        distribution: Distribution,
    },
    /// Points of a sample of correlated normal distributions.
    Correlated {
        /// Points of the sample, which are the same for all parameters of the sample.
        sample: Arc<SamplePoints>,
        /// Mean.
        mean: f64,
        /// Standard deviation.
        sd: f64,
        /// Weights with which the independent normal numbers of the first dimensions are added. The sum of the squared
        /// weights is 1.
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

    /// Returns the value at a position along the axis, from 0 to [`Values::len`] minus 1. At whole numbers the result
    /// equals [`Values::get`].
    ///
    /// Between two values of the axis, the function interpolates with the spacing of the axis. Between points of a
    /// sample there are no values: the function returns the earlier value.
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
/// Next to `from`, the first summand of `x`, a rounding error is returned as zero.
fn decimal(x: f64, from: f64) -> f64 {
    if x.abs() < 1e-14 * from.abs() {
        return 0.0;
    }
    format!("{x:.14e}").parse().unwrap_or(x)
}

/// One axis: one parameter, or several parameters that vary together.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub(super) parameters: Vec<(usize, Values)>,
}

impl Axis {
    /// Returns the axis of these parameters: indices into the model's parameter table, each with its values.
    pub fn new(parameters: Vec<(usize, Values)>) -> Axis {
        Axis { parameters }
    }

    /// Returns the indices into the model's parameter table, each with its values.
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

/// Axes of a design space. The last axis varies fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Axes {
    axes: Vec<Axis>,
    points: u64,
}

/// Error of axes with more than [`Axes::MAX_POINTS`] points in total.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the axes have more than 2^63 points in total")]
pub struct TooManyPoints {
    /// Index of the axis that exceeds the limit.
    pub axis: usize,
    /// Length of each axis.
    pub lengths: Vec<u64>,
}

impl Axes {
    /// Largest number of points: 2^63.
    pub const MAX_POINTS: u64 = 1 << 63;

    /// Returns the product of `axes`.
    ///
    /// # Errors
    /// [`TooManyPoints`] if the product has more than [`Axes::MAX_POINTS`] points.
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

    /// No axes. The product of no axes is one point.
    pub(crate) fn none() -> Axes {
        Axes { axes: Vec::new(), points: 1 }
    }

    /// Returns the axes with `axis` before all other axes.
    ///
    /// # Errors
    /// [`TooManyPoints`] if the product has more than [`Axes::MAX_POINTS`] points.
    pub fn crossed_with(mut self, axis: Axis) -> Result<Axes, TooManyPoints> {
        self.axes.insert(0, axis);
        Axes::new(self.axes)
    }

    /// Returns the axes without the axis that varies `parameter` alone, and the values of this axis; `None` if there
    /// is no such axis.
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

    /// Writes the values at these positions into `values`: one position for each axis, from 0 to the length of the axis
    /// minus 1.
    pub(crate) fn fill_between(&self, positions: &[f64], values: &mut [f64]) {
        for (axis, position) in self.axes.iter().zip(positions) {
            for (parameter, along) in axis.parameters() {
                values[*parameter] = along.at(*position);
            }
        }
    }

    /// Returns true if there are points at these positions: one for each axis, from 0 to the length of the axis minus
    /// 1.
    pub(crate) fn contain(&self, positions: &[f64]) -> bool {
        let within = |(axis, position): (&Axis, &f64)| (0.0..=(axis.len() as f64 - 1.0)).contains(position);
        positions.len() == self.axes.len() && self.axes.iter().zip(positions).all(within)
    }
}

/// Parameter that rises and falls in a response.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// Index in the model's parameter table.
    pub parameter: usize,
    /// Values in ascending order; at least two values.
    pub values: Vec<f64>,
    /// Largest error of the ends of bistable bands, more than zero.
    pub tolerance: f64,
    /// True if unstable orbits of bistable bands are computed.
    pub unstable: bool,
}
