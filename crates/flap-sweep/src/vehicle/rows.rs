//! Computes rows of vehicles at hover, and rows that contain the damping matrix.

use std::sync::Arc;

use flap_core::body::BodyParameters;
use flap_core::model::OverWings;
use flap_core::num::Backend;
use flap_core::simulate::{
    Change, Column, Gradient, Gradients as _, Interrupt, Jobs, NoSlope, PointRun, Row, Rows, Simulator as _,
    SolverSettings, Status, Unfinished,
};
use flap_core::vehicle::{Vehicle, standing};
use nalgebra::DMatrix;

use super::control::{COMPONENTS, ControlError, Effectiveness, Input, VehicleRun};
use super::hover::{HoverError, HoverModel, WRENCH_TO_SI, damping, residual_share, trim};
use super::hover_slopes;
use super::modes::HoverMode;
use crate::derivative::{Per, column_name, meaning};

/// Units of the derivatives in the damping matrix. The first row contains units for forces, and the second
/// row units for torques. The first column is for velocities, and the second column for angular rates.
const DAMPING_UNITS: [[&str; 2]; 2] = [["mN/(m/s)", "mN/(rad/s)"], ["uN*m/(m/s)", "uN*m/(rad/s)"]];

/// Number of columns between the measures of the vehicle and the inputs: growth rate, period and residual.
const OF_HOVER: usize = 3;

/// Name of the column with the largest force or torque that is not balanced at hover, as a fraction of the
/// weight.
pub(crate) const HOVER_RESIDUAL: &str = "hover_residual";

/// Computes rows of a vehicle: rows at hover, rows with the damping matrix, or rows at hover with the damping
/// matrix.
///
/// A row begins with the measures of the vehicle. If the row is computed at hover, the next columns are the
/// growth rate and the period of the fastest-growing mode. Then follow the largest unbalanced force or
/// torque, and the values of the inputs. The entries of the damping matrix come last.
#[derive(Clone)]
pub struct BodyRows {
    vehicle: Arc<Vehicle>,
    /// Inputs that the search for hover changes. `None` if rows are computed without a search for hover.
    inputs: Option<Vec<Input>>,
    has_damping: bool,
    columns: Vec<Column>,
}

impl BodyRows {
    /// Returns a source of rows for `vehicle`. If `inputs` is not `None`, a search changes these inputs until
    /// the vehicle hovers.
    pub fn new(vehicle: Arc<Vehicle>, inputs: Option<Vec<Input>>, has_damping: bool) -> BodyRows {
        let mut columns = vehicle.columns().to_vec();
        let mut add = |name: String, unit, doc: String| {
            columns.push(Column { name, unit, doc, over_wings: OverWings::Omitted });
        };
        if let Some(inputs) = &inputs {
            let growth = "largest real part of the eigenvalues of hover: positive if hover is unstable; without the eigenvalue zero of the heading";
            add("hover_growth_1_s".to_owned(), "1/s", growth.to_owned());
            let period =
                "period of the mode of hover with this real part; empty if the mode is no oscillation";
            add("hover_period_s".to_owned(), "s", period.to_owned());
            let residual = "force or torque that the search for hover leaves, as a share of the weight: the largest share; a torque is divided by the weight times 1 mm";
            add(HOVER_RESIDUAL.to_owned(), "", residual.to_owned());
            for input in inputs {
                let doc = format!("value of the input {} at which the vehicle hovers", input.name);
                add(input_column(input), input.unit, doc);
            }
        }
        if has_damping {
            for (i, of) in COMPONENTS.into_iter().enumerate() {
                for (j, by) in BodyParameters::MOTION.into_iter().enumerate() {
                    let unit = DAMPING_UNITS[i / 3][j / 3];
                    let of_unit = ["mN", "uN*m"][i / 3];
                    add(column_name(of, by, Per::Unit), unit, meaning(of, of_unit, by, Per::Unit));
                }
            }
        }
        BodyRows { vehicle, inputs, has_damping, columns }
    }

    /// If rows are computed at hover, searches hover from the given parameter values, and returns the control
    /// effectiveness at hover.
    ///
    /// # Errors
    /// Returns an error if the mass is not set, or if the search finds no hover. A velocity or rate of the
    /// body that is not zero is also an error.
    pub fn trim(
        &self,
        solver: &SolverSettings,
        values: &[f64],
        interrupted: Interrupt<'_>,
    ) -> Option<Result<Effectiveness, HoverError>> {
        let vehicle_run = VehicleRun { vehicle: &self.vehicle, solver, interrupted };
        self.inputs.as_ref().map(|inputs| trim(&vehicle_run, values, inputs))
    }

    /// Returns the row at the parameter values of `run`, without a search for hover.
    pub fn row_at(&self, run: &PointRun<'_>, begin: Option<&[f64]>) -> Row {
        let mut row = self.vehicle.run_point(run, begin);
        if row.status == Status::Periodic {
            let vehicle_run =
                VehicleRun { vehicle: &self.vehicle, solver: run.solver, interrupted: run.interrupted };
            self.extend(&vehicle_run, run.values, &mut row);
        }
        row
    }

    /// Returns a copy of `values` in which the inputs have their values at hover. The measures of a row
    /// contain these values of the inputs.
    pub(crate) fn at_hover(&self, values: &[f64], measures: &[f64]) -> Vec<f64> {
        let mut values = values.to_vec();
        let found = measures.iter().skip(self.vehicle.columns().len() + OF_HOVER);
        for (input, found) in self.inputs.iter().flatten().zip(found) {
            values[input.parameter] = found * input.factor;
        }
        values
    }

    /// Returns the derivatives of the measures of `row`. The row must be the result of this object for the
    /// parameter values of `run`.
    ///
    /// If a parameter changes at hover, the inputs also change, so that the vehicle keeps hovering. The
    /// growth rate, the period, the residual and the damping matrix have no derivatives.
    ///
    /// # Errors
    /// Returns an error if the computation is interrupted.
    pub fn gradient(
        &self,
        run: &PointRun<'_>,
        row: &Row,
        changes: &[Change],
    ) -> Result<Gradient, Unfinished> {
        let at_hover = |values: &[f64]| self.at_hover(values, &row.measures);
        let changes = changes.iter().map(|change| Change {
            ahead: at_hover(&change.ahead),
            behind: at_hover(&change.behind),
            size: change.size,
        });
        let changes: Vec<Change> = changes.collect();
        let mut found = match &self.inputs {
            None => self.vehicle.gradient(run, &row.state, &changes)?,
            Some(inputs) => {
                let values = at_hover(run.values);
                let run = PointRun { values: &values, ..*run };
                hover_slopes::gradient(&self.vehicle, &run, &row.state, inputs, &changes)?
            }
        };
        for slopes in &mut found.slopes {
            // The columns between the measures of the vehicle and the inputs have no derivatives.
            let of_inputs = slopes.split_off(self.vehicle.columns().len());
            if self.is_at_hover() {
                slopes.extend([Err(NoSlope::Missing); OF_HOVER]);
            }
            slopes.extend(of_inputs);
            slopes.resize(self.columns.len(), Err(NoSlope::Missing));
        }
        Ok(found)
    }

    /// Returns true if rows are computed at hover, with a search for each row.
    pub(crate) fn is_at_hover(&self) -> bool {
        self.inputs.is_some()
    }

    /// Returns true if the search for hover changes this parameter.
    pub(crate) fn has_input(&self, parameter: usize) -> bool {
        self.inputs.iter().flatten().any(|input| input.parameter == parameter)
    }

    /// Adds the columns for hover and for the damping matrix to the measures of `row`. `values` contains the
    /// parameter values of the row.
    fn extend(&self, vehicle_run: &VehicleRun<'_>, values: &[f64], row: &mut Row) {
        // Cells stay empty if a derivative is missing, or the moments of inertia are not set.
        let damping = damping(vehicle_run, values, &row.state).ok();
        if let Some(inputs) = &self.inputs {
            let body = self.vehicle.mass_properties(values);
            let wrench = vehicle_run.wrench(row);
            let wrench = core::array::from_fn(|i| wrench[i] * WRENCH_TO_SI[i]);
            let residual = residual_share(&body, &wrench);
            let model = damping
                .and_then(|damping| HoverModel::new(body, damping, DMatrix::zeros(6, 0), wrench, false).ok());
            let mode = model.as_ref().and_then(HoverModel::fastest_growing);
            row.measures.push(mode.map_or(f64::NAN, |mode| mode.eigenvalue.re));
            row.measures.push(mode.and_then(HoverMode::period).unwrap_or(f64::NAN));
            row.measures.push(residual);
            let value =
                |input: &Input| standing(self.vehicle.parameters(), values, input.parameter) / input.factor;
            row.measures.extend(inputs.iter().map(value));
        }
        if self.has_damping {
            let entry = |i: usize, j: usize| damping.map_or(f64::NAN, |all| all[(i, j)] / WRENCH_TO_SI[i]);
            row.measures.extend((0..36).map(|place| entry(place / 6, place % 6)));
        }
    }
}

impl Rows for BodyRows {
    fn columns(&self) -> &[Column] {
        &self.columns
    }

    fn run(&self, backend: Backend, solver: &SolverSettings, jobs: &mut dyn Jobs) {
        while let Some(point) = jobs.next(true) {
            let interrupted = || jobs.interrupted();
            let run = PointRun::new(backend, solver, &point.values).until(&interrupted);
            let row = self.run_point(&run, point.begin.as_deref());
            if jobs.interrupted() {
                break;
            }
            jobs.done(point.index, row);
        }
    }

    /// Computes the row of a point. The search for hover starts from rest and ignores the state `begin`.
    fn run_point(&self, run: &PointRun<'_>, begin: Option<&[f64]>) -> Row {
        let Some(inputs) = &self.inputs else { return self.row_at(run, begin) };
        let vehicle_run =
            VehicleRun { vehicle: &self.vehicle, solver: run.solver, interrupted: run.interrupted };
        match trim(&vehicle_run, run.values, inputs) {
            Ok(found) => {
                let (values, mut row) = (found.applied(run.values), found.row);
                if row.status == Status::Periodic {
                    self.extend(&vehicle_run, &values, &mut row);
                }
                row
            }
            Err(HoverError::Control(ControlError::NotPeriodic { status, reason })) => {
                Row { status, reason, ..Row::invalid("") }
            }
            Err(error) => Row::invalid(error),
        }
    }
}

/// Returns the name of the column that contains the value of an input at hover, such as `hover_amplitude_v`.
fn input_column(input: &Input) -> String {
    let unit = input.unit.to_lowercase();
    if unit.is_empty() { format!("hover_{}", input.name) } else { format!("hover_{}_{unit}", input.name) }
}
