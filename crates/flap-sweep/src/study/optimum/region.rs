//! The region in which an optimum is sought. Some parameters vary continuously between two values. For
//! parameters that do not vary continuously, each value is tried.

use flap_core::parameter::{Kind, Parameter, Range};

use crate::plan::Plan;
use crate::plan::axes::{Axis, Values};
use crate::plan::sample::Distribution;

/// A coordinate that is closer to 0 or 1 than this distance counts as 0 or 1. The tolerance is necessary
/// because rounding errors move a coordinate away from exactly 0 or 1.
const AT_END: f64 = 1e-9;

/// A parameter that varies continuously between two values. A coordinate from 0 to 1 represents the value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Variable {
    pub(super) parameter: usize,
    pub(super) from: f64,
    pub(super) to: f64,
    /// True if the scale is logarithmic: equal steps of the coordinate multiply the value by equal factors.
    is_log: bool,
}

impl Variable {
    /// Returns the parameter's value for a coordinate between 0 and 1.
    pub(super) fn value(&self, coordinate: f64) -> f64 {
        let Variable { from, to, is_log, .. } = *self;
        let value = match coordinate {
            _ if coordinate <= AT_END => from,
            _ if coordinate >= 1.0 - AT_END => to,
            _ if is_log => from * libm::pow(to / from, coordinate),
            _ => from + (to - from) * coordinate,
        };
        value.clamp(from, to)
    }

    /// Returns the coordinate, between 0 and 1, for a value of the parameter.
    pub(super) fn coordinate(&self, value: f64) -> f64 {
        let Variable { from, to, is_log, .. } = *self;
        let share = if is_log {
            libm::log(value / from) / libm::log(to / from)
        } else {
            (value - from) / (to - from)
        };
        share.clamp(0.0, 1.0)
    }

    /// Returns the derivative of the parameter's value with respect to the coordinate.
    pub(super) fn slope(&self, coordinate: f64) -> f64 {
        let Variable { from, to, is_log, .. } = *self;
        if is_log { self.value(coordinate) * libm::log(to / from) } else { to - from }
    }
}

/// The region in which an optimum is sought.
#[derive(Clone, Debug, Default)]
pub(super) struct Region {
    pub(super) variables: Vec<Variable>,
    /// Indices of the parameters that do not vary continuously: the optimisation tries each of their values.
    /// Choices, whole numbers, parameters with one value, and parameters of an axis with several parameters
    /// do not vary continuously.
    pub(super) enumerated: Vec<usize>,
}

impl Region {
    /// Returns the region that the axes of a plan span.
    ///
    /// # Errors
    /// The index of a parameter whose distribution has no smallest and largest value.
    pub(super) fn of(plan: &Plan) -> Result<Region, usize> {
        let mut region = Region::default();
        for axis in plan.axes().as_slice() {
            region.add(plan.parameters(), axis)?;
        }
        Ok(region)
    }

    fn add(&mut self, parameters: &[Parameter<'_>], axis: &Axis) -> Result<(), usize> {
        let is_alone = axis.parameters().len() == 1;
        for (index, values) in axis.parameters() {
            let is_whole = match parameters[*index].kind {
                Kind::Choice(_) | Kind::Number(Range::Whole(..)) => true,
                Kind::Number(_) | Kind::Following(..) => false,
            };
            let bounds = match values {
                Values::Correlated { .. }
                | Values::Sampled { distribution: Distribution::Normal { .. }, .. } => return Err(*index),
                Values::Sampled { distribution: Distribution::Uniform { from, to }, .. } => {
                    Some((*from, *to, false))
                }
                Values::Sampled { distribution: Distribution::LogUniform { from, to }, .. } => {
                    Some((*from, *to, true))
                }
                Values::Sampled { distribution: Distribution::Among(list), .. } => Some(extremes(list)),
                _ if !is_alone => None,
                Values::List(list) | Values::Unchecked(list) => Some(extremes(list)),
                Values::Linear { .. } | Values::Step { .. } => {
                    Some((values.get(0), values.get(values.len() - 1), false))
                }
                Values::Log { .. } => Some((values.get(0), values.get(values.len() - 1), true)),
            };
            match bounds.filter(|(one, other, _)| !is_whole && one != other) {
                Some((one, other, is_log)) => {
                    let (from, to) = (one.min(other), one.max(other));
                    let is_log = is_log && from > 0.0;
                    self.variables.push(Variable { parameter: *index, from, to, is_log });
                }
                None => self.enumerated.push(*index),
            }
        }
        Ok(())
    }

    /// Returns the coordinates of the point with the given parameter values.
    pub(super) fn coordinates(&self, values: &[f64]) -> Vec<f64> {
        self.variables.iter().map(|variable| variable.coordinate(values[variable.parameter])).collect()
    }

    /// Returns the values of the parameters in `enumerated` from the parameter values of a point.
    pub(super) fn choice(&self, values: &[f64]) -> Vec<f64> {
        self.enumerated.iter().map(|&parameter| values[parameter]).collect()
    }

    /// Returns the indices and values of all varied parameters. `coordinates` determines the values of
    /// continuous parameters. `choice` contains the values of the parameters that do not vary continuously.
    pub(super) fn varied(&self, coordinates: &[f64], choice: &[f64]) -> Vec<(usize, f64)> {
        let continuous = self.variables.iter().zip(coordinates);
        let continuous = continuous.map(|(variable, &at)| (variable.parameter, variable.value(at)));
        continuous.chain(self.enumerated.iter().copied().zip(choice.iter().copied())).collect()
    }
}

fn extremes(list: &[f64]) -> (f64, f64, bool) {
    let least = list.iter().copied().fold(f64::INFINITY, f64::min);
    (least, list.iter().copied().fold(f64::NEG_INFINITY, f64::max), false)
}

#[cfg(test)]
mod tests {
    use super::Variable;

    #[test]
    fn coordinates_and_values_are_inverse() {
        for is_log in [false, true] {
            let variable = Variable { parameter: 0, from: 2.0, to: 50.0, is_log };
            for coordinate in [0.0, 0.1, 0.5, 1.0] {
                let value = variable.value(coordinate);
                assert!((variable.coordinate(value) - coordinate).abs() < 1e-14);
                let step = 1e-6;
                let slope = (variable.value(coordinate + step) - value) / step;
                assert!(coordinate == 1.0 || (slope / variable.slope(coordinate) - 1.0).abs() < 1e-5);
            }
            assert_eq!([0.0, 1.0].map(|at| variable.value(at)), [2.0, 50.0]);
        }
    }
}
