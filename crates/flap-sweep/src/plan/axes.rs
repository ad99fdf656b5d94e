//! The axes of a design space, and the points of their product.

use crate::plan::axis::{Axis, Values};

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
