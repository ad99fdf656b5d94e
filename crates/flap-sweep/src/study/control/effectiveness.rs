//! The matrix of control effectiveness.

use flap_core::num::Backend;
use flap_core::simulate::{
    Change, Gradients as _, Interrupt, NoSlope, PointRun, Row, Rows as _, SolverSettings, Status, Unfinished,
};
use flap_core::vehicle::{FORCES, TORQUES, Vehicle, standing};
use nalgebra::DMatrix;

use super::input::{Input, parameters};
use crate::plan::gradient::is_least;

/// Force and torque: the columns of rows.
pub const COMPONENTS: [&str; 6] = [FORCES[0], FORCES[1], FORCES[2], TORQUES[0], TORQUES[1], TORQUES[2]];

/// The share of the largest effect of an input below which another one has none.
const IDLE: f64 = 1e-9;

/// The reason why a vehicle's control effectiveness is not known.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ControlError {
    /// The motion of its wings has no derivatives.
    #[error("the vehicle does not settle on an orbit of one drive period: it is {}{}", status.name(), because(reason.as_deref()))]
    NotPeriodic {
        /// Status of its row.
        status: Status,
        /// The reason of an invalid row.
        reason: Option<String>,
    },
    /// An input that is zero, and has no size by which it may be changed.
    #[error("`{0}` is zero and has no typical size: give it a value")]
    NoSize(String),
    /// A derivative is not known.
    #[error("the derivative of {of} by `{by}` is not known: {}", reason.name())]
    NoSlope {
        /// The component.
        of: &'static str,
        /// The input.
        by: String,
        /// The reason.
        reason: NoSlope,
    },
    /// The motion cannot be followed.
    #[error(transparent)]
    Unfinished(#[from] Unfinished),
}

fn because(reason: Option<&str>) -> String {
    reason.map(|reason| format!(" ({reason})")).unwrap_or_default()
}

/// A vehicle at an operating point.
pub struct Flight<'f> {
    /// The vehicle.
    pub vehicle: &'f Vehicle,
    /// Settings of its integration.
    pub solver: &'f SolverSettings,
    /// Ends the work early.
    pub interrupted: Interrupt<'f>,
}

/// The change of a vehicle's mean force and torque with its inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Effectiveness {
    /// The inputs, in the order of the columns.
    pub inputs: Vec<Input>,
    /// The values of the inputs, in their units.
    pub values: Vec<f64>,
    /// Mean force (mN) and torque (uN·m), see [`COMPONENTS`].
    pub wrench: [f64; 6],
    /// 6 × inputs: the change of each component, in mN or uN·m, per unit of each input.
    pub matrix: DMatrix<f64>,
    /// The row at the operating point.
    pub row: Row,
}

/// A combination of inputs, and the combination of force and torque that it makes.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Singular value: force (mN) and torque (uN·m, which is mN at 1 mm) per unit of the combination.
    pub size: f64,
    /// Shares of the components, a vector of length 1.
    pub components: [f64; 6],
    /// Shares of the inputs, a vector of length 1.
    pub inputs: Vec<f64>,
}

impl Flight<'_> {
    /// The row at these values of the vehicle's parameters, near the state `begin` if one is given.
    pub fn row(&self, values: &[f64], begin: Option<&[f64]>) -> Row {
        let run = PointRun::new(Backend::best(), self.solver, values).until(self.interrupted);
        self.vehicle.run_point(&run, begin)
    }

    /// Mean force (mN) and torque (uN·m) of a row with measures.
    pub fn wrench(&self, row: &Row) -> [f64; 6] {
        COMPONENTS.map(|name| row.measures[self.place(name)])
    }

    fn place(&self, component: &str) -> usize {
        self.vehicle.columns().iter().position(|column| column.name == component).unwrap_or_default()
    }

    /// The control effectiveness of `inputs` at these values, from the exact derivatives of the settled orbit. A wing's own
    /// parameter that has no value takes that of all wings.
    ///
    /// # Errors
    /// If the motion is not periodic, or a derivative is not known.
    pub fn effectiveness(
        &self,
        values: &[f64],
        inputs: &[Input],
        begin: Option<&[f64]>,
    ) -> Result<Effectiveness, ControlError> {
        let values = own_values(self.vehicle, values, inputs);
        let row = self.row(&values, begin);
        if (self.interrupted)() {
            return Err(Unfinished::Interrupted.into());
        }
        if row.status != Status::Periodic {
            return Err(ControlError::NotPeriodic { status: row.status, reason: row.reason });
        }
        let mut changes = Vec::with_capacity(inputs.len());
        for input in inputs {
            let size = input.size(self.vehicle, &values);
            let size = size.ok_or_else(|| ControlError::NoSize(input.name.clone()))? * Change::SHARE;
            let moved = |by: f64| {
                let mut values = values.clone();
                values[input.parameter] += by;
                values
            };
            // What can only grow has a one-sided difference; at rest, that would be the square of the change.
            let at_rest = row.floquet_max.is_nan();
            let is_one_sided = !at_rest && is_least(parameters(self.vehicle), &values, input.parameter);
            let behind = moved(if is_one_sided { 0.0 } else { -size });
            changes.push(Change { ahead: moved(size), behind, size });
        }
        let run = PointRun::new(Backend::best(), self.solver, &values).until(self.interrupted);
        let gradient = self.vehicle.gradient(&run, &row.state, &changes)?;
        let mut matrix = DMatrix::zeros(6, inputs.len());
        for (j, (input, slopes)) in inputs.iter().zip(&gradient.slopes).enumerate() {
            for (i, of) in COMPONENTS.into_iter().enumerate() {
                let slope = slopes[self.place(of)];
                let by = || input.name.clone();
                matrix[(i, j)] =
                    slope.map_err(|reason| ControlError::NoSlope { of, by: by(), reason })? * input.factor;
            }
        }
        Ok(Effectiveness {
            values: inputs.iter().map(|input| values[input.parameter] / input.factor).collect(),
            inputs: inputs.to_vec(),
            wrench: self.wrench(&row),
            matrix,
            row,
        })
    }
}

/// The values with those of all wings in place of a wing's own that are not set.
pub(super) fn own_values(vehicle: &Vehicle, values: &[f64], inputs: &[Input]) -> Vec<f64> {
    let mut filled = values.to_vec();
    for input in inputs {
        filled[input.parameter] = standing(parameters(vehicle), values, input.parameter);
    }
    filled
}

impl Effectiveness {
    /// The same without inputs that change nothing beside the others, unless none is left.
    pub fn without_idle(mut self, flight: &Flight<'_>, values: &[f64]) -> Effectiveness {
        let effects = self.inputs.iter().enumerate().map(|(j, input)| {
            let size = input.size(flight.vehicle, values).unwrap_or_default() / input.factor;
            self.matrix.column(j).amax() * size
        });
        let effects: Vec<f64> = effects.collect();
        let largest = effects.iter().copied().fold(0.0, f64::max);
        let kept: Vec<usize> = (0..effects.len()).filter(|&j| effects[j] > IDLE * largest).collect();
        if !kept.is_empty() {
            self.inputs = kept.iter().map(|&j| self.inputs[j].clone()).collect();
            self.values = kept.iter().map(|&j| self.values[j]).collect();
            self.matrix = self.matrix.select_columns(&kept);
        }
        self
    }

    /// The combinations of inputs that make force and torque, the strongest first: the singular value decomposition of the
    /// matrix.
    pub fn modes(&self) -> Vec<Mode> {
        let decomposed = self.matrix.clone().svd(true, true);
        let (Some(u), Some(v_t)) = (decomposed.u, decomposed.v_t) else { return Vec::new() };
        let modes = decomposed.singular_values.iter().enumerate().map(|(i, &size)| {
            let inputs: Vec<f64> = v_t.row(i).iter().copied().collect();
            // The largest share of the inputs is positive.
            let largest = inputs
                .iter()
                .copied()
                .fold(0.0, |one: f64, other| if other.abs() > one.abs() { other } else { one });
            let sign = 1.0_f64.copysign(largest);
            Mode {
                size,
                components: core::array::from_fn(|j| sign * u[(j, i)]),
                inputs: inputs.into_iter().map(|share| sign * share).collect(),
            }
        });
        modes.collect()
    }
}
