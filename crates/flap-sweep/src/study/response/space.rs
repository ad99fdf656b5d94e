//! The space of states and parameters in which curves of orbits are computed.

use flap_core::num::Backend;
use flap_core::simulate::{Interrupt, Period, Point, PointRun, SolverSettings, Unfinished};
use nalgebra::{DMatrix, DVector};

use super::curve::Curve;
use crate::plan::Plan;

/// The space of the state at the beginning of a drive period and of `P` parameters. A point of this space
/// determines the motion over the drive period.
///
/// The first coordinates are the state components, divided by their sizes. The last coordinates are the
/// parameter values, divided by their units.
pub(super) struct OrbitSpace<'a, const P: usize> {
    pub(super) plan: &'a Plan,
    pub(super) design: &'a Point,
    /// Indices of the parameters in the model's parameter table.
    pub(super) parameters: [usize; P],
    /// One value for each parameter, in SI units. If the parameter changes by this value, the point in the
    /// space moves by a distance of 1.
    pub(super) units: [f64; P],
    /// Size of each state component. If a component is always zero, its size is 1.
    pub(super) sizes: Vec<f64>,
    pub(super) solver: SolverSettings,
    backend: Backend,
    interrupted: Interrupt<'a>,
}

impl<'a, const P: usize> OrbitSpace<'a, P> {
    /// Returns the space for the design of `curve`. `parameters` contains the indices and the units of the
    /// parameters. The tolerances of the integration are multiplied by `finer`.
    pub(super) fn new(
        plan: &'a Plan,
        curve: &'a Curve,
        parameters: [(usize, f64); P],
        finer: f64,
        backend: Backend,
        interrupted: Interrupt<'a>,
    ) -> Self {
        let SolverSettings { rtol, atol, .. } = *plan.solver();
        OrbitSpace {
            plan,
            design: &curve.design,
            parameters: parameters.map(|(index, _)| index),
            units: parameters.map(|(_, unit)| unit),
            // A component that is always zero has no size.
            sizes: curve.sizes.iter().map(|&size| if size == 0.0 { 1.0 } else { size }).collect(),
            solver: SolverSettings { rtol: finer * rtol, atol: finer * atol, ..*plan.solver() },
            backend,
            interrupted,
        }
    }

    /// Returns the number of state components.
    pub(super) fn states(&self) -> usize {
        self.sizes.len()
    }

    /// Returns the coordinates of a point with the given state and parameter values.
    pub(super) fn place(&self, state: &[f64], values: [f64; P]) -> DVector<f64> {
        let state = state.iter().zip(&self.sizes).map(|(y, size)| y / size);
        let values = values.into_iter().zip(self.units).map(|(value, unit)| value / unit);
        DVector::from_iterator(self.states() + P, state.chain(values))
    }

    /// Returns the state at the point with the coordinates `place`.
    pub(super) fn state(&self, place: &DVector<f64>) -> Vec<f64> {
        place.iter().zip(&self.sizes).map(|(y, size)| y * size).collect()
    }

    /// Returns the parameter values at the point with the coordinates `place`.
    pub(super) fn values(&self, place: &DVector<f64>) -> [f64; P] {
        core::array::from_fn(|k| place[self.states() + k] * self.units[k])
    }

    /// Returns the values of all parameters of the design at the point with the coordinates `place`.
    pub(super) fn model_values(&self, place: &DVector<f64>) -> Vec<f64> {
        let mut values = self.design.values.clone();
        for (parameter, value) in self.parameters.into_iter().zip(self.values(place)) {
            values[parameter] = value;
        }
        self.plan.derived().fill(&mut values, &[]);
        values
    }

    /// Returns the motion over one drive period with the initial state and the parameters at the coordinates
    /// `place`.
    pub(super) fn period(&self, place: &DVector<f64>) -> Result<Period, Unfinished> {
        let values = self.model_values(place);
        if let Some(invalid) = self.plan.invalid(&values) {
            return Err(invalid.into());
        }
        let run = PointRun::new(self.backend, &self.solver, &values).until(self.interrupted);
        self.plan.simulator().motions()?.period(&run, &self.state(place))
    }

    /// Returns the monodromy matrix for state components that are divided by their sizes.
    pub(super) fn monodromy(&self, period: &Period) -> DMatrix<f64> {
        let n = self.states();
        DMatrix::from_fn(n, n, |i, j| period.responses[j][i] * self.sizes[j] / self.sizes[i])
    }
}
