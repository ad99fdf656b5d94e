//! Computes the control effectiveness of a vehicle: the derivatives of its mean force and torque with respect
//! to each input.

use flap_core::body::BodyParameters;
use flap_core::num::Backend;
use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::{
    Change, Gradients as _, Interrupt, NoSlope, PointRun, Row, Rows as _, Simulator as _, SolverSettings,
    Status, Unfinished,
};
use flap_core::vehicle::{FORCES, TORQUES, Vehicle, standing};
use nalgebra::DMatrix;

use crate::derivative::{self, is_least};
use crate::notation::{UserError, nearest, text};

/// Words that a user can give for drive parameters. For each word, the list contains the names of the
/// parameter in the models.
pub const WORDS: [(&str, &[&str]); 6] = [
    ("amplitude", &["drive_voltage_pp"]),
    ("bias", &["drive_offset", "drive_bias"]),
    ("frequency", &["drive_frequency"]),
    ("second_harmonic", &["drive_second_harmonic"]),
    ("second_phase", &["drive_second_phase"]),
    ("third_harmonic", &["drive_third_harmonic"]),
];

/// The ending of input names that denote a difference between the left and the right wings.
const DIFFERENCE: &str = "_difference";

/// An input of a vehicle: a parameter that a controller can change.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Name as the user gives it: the name of a parameter, or a word such as `bias_difference`.
    pub name: String,
    /// Index of the input's parameter in the vehicle's parameter table.
    pub parameter: usize,
    /// Unit in which flap prints the input, such as `V` or `deg`. Empty if the input has no unit.
    pub unit: &'static str,
    /// Factor by which a value in the printed unit is multiplied to obtain SI units.
    pub factor: f64,
}

impl Input {
    /// Returns the input with the given name. The name can be a parameter of the vehicle or one of [`WORDS`].
    ///
    /// A word alone, such as `bias`, applies to all wings. With the name of a wing in front, such as
    /// `left_bias`, the word applies to this wing. With the ending `_difference`, the word applies to the
    /// difference between the left and the right wings.
    ///
    /// # Errors
    /// An error if the vehicle has no input with the given name, or if the parameter is a choice.
    pub fn of(vehicle: &Vehicle, name: &str) -> Result<Input, UserError> {
        let Some(index) = index(vehicle, name) else {
            let known = Input::names(vehicle);
            let near = nearest(name, known.iter().map(String::as_str));
            let help = near.map_or("`flap vehicle --help` lists words for inputs".to_owned(), |near| {
                format!("did you mean `{near}`?")
            });
            return Err(UserError::new(format!("the vehicle has no input `{name}`"), Some(&help)));
        };
        let parameter = &vehicle.parameters()[index];
        if let Kind::Choice(_) = parameter.kind {
            return Err(UserError::new(format!("`{name}` is a choice, not an input"), None));
        }
        let (unit, factor) = match parameter.unit {
            "rad" => ("deg", 1.0_f64.to_radians()),
            "m" => ("mm", 1e-3),
            "kg" => ("mg", 1e-6),
            unit => (unit, 1.0),
        };
        Ok(Input { name: name.to_owned(), parameter: index, unit, factor })
    }

    /// Returns the default inputs of a vehicle: amplitude and bias of the drive. If the drive has harmonics,
    /// the second harmonic is also an input.
    ///
    /// Each default input changes all wings together. If there are wings on both sides, the difference
    /// between the left and the right wings is also an input. `values` contains the values of the vehicle's
    /// parameters. Inputs whose parameter is not set are left out.
    pub fn usual(vehicle: &Vehicle, values: &[f64]) -> Vec<Input> {
        let words = ["amplitude", "bias", "second_harmonic"];
        let words = if has_harmonics(vehicle, values) { &words[..] } else { &words[..2] };
        let names = words.iter().flat_map(|word| [(*word).to_owned(), format!("{word}{DIFFERENCE}")]);
        let inputs = names.filter_map(|name| Input::of(vehicle, &name).ok());
        inputs.filter(|input| input.unset(vehicle, values).is_none()).collect()
    }

    /// Returns all names that inputs of the vehicle can have. Error messages suggest the most similar of the
    /// input names.
    pub fn names(vehicle: &Vehicle) -> Vec<String> {
        let words = WORDS.iter().flat_map(|(word, _)| {
            let of_wings = vehicle.mounts().iter().map(move |mount| format!("{}_{word}", mount.name));
            [(*word).to_owned(), format!("{word}{DIFFERENCE}")].into_iter().chain(of_wings)
        });
        let words = words.filter(|name| index(vehicle, name).is_some());
        let parameters = vehicle.parameters().iter();
        let numbers = parameters.filter(|parameter| !matches!(parameter.kind, Kind::Choice(_)));
        words.chain(numbers.map(|parameter| parameter.name.to_owned())).collect()
    }

    /// If the parameter that the input changes is not set, returns the name of this parameter.
    fn unset<'v>(&self, vehicle: &'v Vehicle, values: &[f64]) -> Option<&'v str> {
        let parameters = vehicle.parameters();
        let name = parameters[self.parameter].name;
        let index = match name.strip_prefix("difference_") {
            Some(of_all_wings) => Parameter::index(parameters, of_all_wings)?,
            None => self.parameter,
        };
        standing(parameters, values, index).is_nan().then_some(parameters[index].name)
    }

    /// Returns true if the input changes the amplitude or the phase of a harmonic of the drive.
    fn is_harmonic(&self, vehicle: &Vehicle) -> bool {
        let name = vehicle.parameters()[self.parameter].name;
        ["second", "third"].iter().any(|harmonic| name.contains(&format!("drive_{harmonic}_")))
    }

    /// Returns two points, from which derivatives are computed: the points before and after a small change of
    /// the input.
    ///
    /// If the parameter is zero and cannot be negative, the finite difference is one-sided, except if the
    /// wings rest. For resting wings, mean forces grow with the square of the input's change. A central
    /// difference then gives the derivative, which is zero, and a one-sided difference does not.
    pub(super) fn change(
        &self,
        vehicle: &Vehicle,
        values: &[f64],
        at_rest: bool,
    ) -> Result<Change, ControlError> {
        let size = self.size(vehicle, values)? * Change::SHARE;
        let moved = |by: f64| {
            let mut values = values.to_vec();
            values[self.parameter] += by;
            values
        };
        let is_one_sided = !at_rest && is_least(vehicle.parameters(), values, self.parameter);
        let behind = moved(if is_one_sided { 0.0 } else { -size });
        Ok(Change { ahead: moved(size), behind, size })
    }

    /// Returns the size (SI) of the input's parameter, by which changes of the input are divided.
    pub(super) fn size(&self, vehicle: &Vehicle, values: &[f64]) -> Result<f64, ControlError> {
        let size = derivative::size(vehicle, values, self.parameter);
        size.map(f64::abs).ok_or_else(|| ControlError::NoSize(self.name.clone()))
    }
}

/// Returns true if the drive of the wings has a second and a third harmonic.
fn has_harmonics(vehicle: &Vehicle, values: &[f64]) -> bool {
    let parameters = vehicle.parameters();
    let shape = Parameter::index(parameters, "drive_shape");
    shape.and_then(|shape| text::option(&parameters[shape], values[shape])) == Some("harmonics")
}

/// Returns the index of the parameter that the input with the given name changes.
fn index(vehicle: &Vehicle, name: &str) -> Option<usize> {
    names(vehicle, name).iter().find_map(|name| Parameter::index(vehicle.parameters(), name))
}

/// Returns the names of all parameters that an input with the given name may change.
fn names(vehicle: &Vehicle, name: &str) -> Vec<String> {
    let mut names = vec![name.to_owned()];
    let mut add = |word: &str, first: &str| {
        let known = WORDS.iter().find(|(known, _)| *known == word);
        names.extend(
            known.iter().flat_map(|(_, of_models)| of_models.iter().map(|one| format!("{first}{one}"))),
        );
    };
    add(name, "");
    if let Some(word) = name.strip_suffix(DIFFERENCE) {
        add(word, "difference_");
    }
    for mount in vehicle.mounts() {
        if let Some(word) = name.strip_prefix(&format!("{}_", mount.name)) {
            add(word, &format!("{}_", mount.name));
        }
    }
    names
}

/// Names of the six columns that contain the components of mean force and mean torque.
pub const COMPONENTS: [&str; 6] = [FORCES[0], FORCES[1], FORCES[2], TORQUES[0], TORQUES[1], TORQUES[2]];

/// If the effect of an input is below this fraction of the largest effect, the input counts as an input
/// without effect.
pub(super) const IDLE: f64 = 1e-9;

/// The reason why a control effectiveness or a trim cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ControlError {
    /// The motion of a wing is not periodic, so derivatives do not exist.
    #[error("the vehicle does not settle on an orbit of one drive period: it is {}{}", status.name(), because(reason.as_deref()))]
    NotPeriodic {
        /// Status of the vehicle's row.
        status: Status,
        /// The reason why the row is invalid, if it is invalid.
        reason: Option<String>,
    },
    /// The parameter that an input changes is not set.
    #[error("the input `{input}` changes `{parameter}`, which is not set: set `{parameter}` to a value")]
    Unset {
        /// Name of the input.
        input: String,
        /// Name of the parameter that is not set.
        parameter: String,
    },
    /// An input changes a harmonic of the drive, but the drive has no harmonics.
    #[error("the input `{0}` has an effect only with drive_shape = \"harmonics\"")]
    NoHarmonics(String),
    /// An input has the value zero and no typical size.
    #[error("`{0}` is zero and has no typical size: set it to another value")]
    NoSize(String),
    /// A derivative is missing.
    #[error("the derivative of {of} with respect to `{by}` is missing: {}", reason.name())]
    NoSlope {
        /// Name of the force or torque component.
        of: &'static str,
        /// Name of the input.
        by: String,
        /// The reason why the derivative is missing.
        reason: NoSlope,
    },
    /// The trim has more targets than inputs with an effect.
    #[error("{targets} targets need at least {targets} inputs with an effect, not only [{inputs}]")]
    FewInputs {
        /// Number of targets.
        targets: usize,
        /// Names of the inputs that have an effect on force or torque.
        inputs: String,
    },
    /// The iteration cannot come closer to the targets. The error contains the nearest values of force and
    /// torque.
    #[error("the targets are not reached: {0}")]
    NotReached(String),
    /// The motion cannot be computed.
    #[error(transparent)]
    Unfinished(#[from] Unfinished),
}

/// Returns a reason in brackets for the end of a message. Without a reason, the text is empty.
pub(crate) fn because(reason: Option<&str>) -> String {
    reason.map(|reason| format!(" ({reason})")).unwrap_or_default()
}

/// A vehicle with the settings for computing its motion. The parameter values are arguments of the methods.
pub struct VehicleRun<'f> {
    /// Vehicle.
    pub vehicle: &'f Vehicle,
    /// Settings of the integration.
    pub solver: &'f SolverSettings,
    /// A function that returns true if the computation must end early.
    pub interrupted: Interrupt<'f>,
}

/// The control effectiveness of a vehicle: the derivatives of mean force and torque with respect to the
/// inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Effectiveness {
    /// The inputs, in the order of the matrix columns.
    pub inputs: Vec<Input>,
    /// Values of the inputs at the operating point, each in the printed unit of the input.
    pub values: Vec<f64>,
    /// Mean force (mN) and torque (uN·m) at the operating point, in the order of [`COMPONENTS`].
    pub wrench: [f64; 6],
    /// The control matrix, with six rows for the components of force and torque, and one column for each
    /// input. Each entry is a derivative in mN or uN·m per printed unit of the input.
    pub matrix: DMatrix<f64>,
    /// The row of the vehicle at the operating point.
    pub row: Row,
}

/// A combination of input changes, and the change of force and torque that it causes.
#[derive(Clone, Debug, PartialEq)]
pub struct InputCombination {
    /// Singular value of the control matrix: the change of force (mN) and torque (uN·m) for a combination of
    /// length 1. A torque of 1 uN·m is a force of 1 mN at a lever arm of 1 mm.
    pub size: f64,
    /// Direction of the change of force and torque, as a unit vector.
    pub components: [f64; 6],
    /// Changes of the inputs, as a unit vector.
    pub inputs: Vec<f64>,
}

impl VehicleRun<'_> {
    /// Returns the row at the given values of the vehicle's parameters. The motion starts from the state
    /// `begin`, or from rest if `begin` is `None`.
    pub fn row(&self, values: &[f64], begin: Option<&[f64]>) -> Row {
        let run = PointRun::new(Backend::best(), self.solver, values).until(self.interrupted);
        self.vehicle.run_point(&run, begin)
    }

    /// Returns the row at the given values, like [`VehicleRun::row`], but only if the motion is periodic.
    ///
    /// # Errors
    /// Returns an error if the motion is not periodic, or if the computation is interrupted.
    pub(super) fn settled(&self, values: &[f64], begin: Option<&[f64]>) -> Result<Row, ControlError> {
        let row = self.row(values, begin);
        if (self.interrupted)() {
            return Err(Unfinished::Interrupted.into());
        }
        match row.status {
            Status::Periodic => Ok(row),
            status => Err(ControlError::NotPeriodic { status, reason: row.reason }),
        }
    }

    /// Returns the mean force (mN) and torque (uN·m) from the measures of a row. The motion of the row must
    /// be periodic.
    pub fn wrench(&self, row: &Row) -> [f64; 6] {
        places(self.vehicle).map(|place| row.measures[place])
    }

    /// Returns the control effectiveness of `inputs` at the given parameter values. The derivatives are exact
    /// derivatives of the settled orbit.
    ///
    /// In the four-bar model, an exact derivative with respect to the body's motion may not exist, because
    /// forces have kinks. If an exact derivative does not exist, a central difference replaces the
    /// derivative. If a parameter of one wing is not set, the function uses the value of the parameter for
    /// all wings.
    ///
    /// # Errors
    /// Returns an error if an input has no value, if the motion is not periodic, or if a derivative is missing.
    pub fn effectiveness(
        &self,
        values: &[f64],
        inputs: &[Input],
        begin: Option<&[f64]>,
    ) -> Result<Effectiveness, ControlError> {
        for input in inputs {
            if let Some(parameter) = input.unset(self.vehicle, values) {
                let (input, parameter) = (input.name.clone(), parameter.to_owned());
                return Err(ControlError::Unset { input, parameter });
            }
            if input.is_harmonic(self.vehicle) && !has_harmonics(self.vehicle, values) {
                return Err(ControlError::NoHarmonics(input.name.clone()));
            }
        }
        let values = own_values(self.vehicle, values, inputs);
        let row = self.settled(&values, begin)?;
        // A rest has no multiplier, unless the rest is unstable.
        let at_rest = row.floquet_max.is_nan() || row.floquet_max > 1.0;
        let changes = inputs.iter().map(|input| input.change(self.vehicle, &values, at_rest));
        let changes: Vec<Change> = changes.collect::<Result<_, _>>()?;
        let run = PointRun::new(Backend::best(), self.solver, &values).until(self.interrupted);
        let gradient = self.vehicle.gradient(&run, &row.state, &changes)?;
        let places = places(self.vehicle);
        let mut matrix = DMatrix::zeros(6, inputs.len());
        for (j, (input, slopes)) in inputs.iter().zip(&gradient.slopes).enumerate() {
            let slopes = places.map(|place| slopes[place]);
            let column = match self.motion_step(input) {
                Some(step) if slopes.contains(&Err(NoSlope::Kink)) => {
                    self.differences(&values, input, step, &row)?
                }
                _ => self.slopes(&changes[j].ahead, input, slopes)?,
            };
            matrix.column_mut(j).copy_from_slice(&column.map(|slope| slope * input.factor));
        }
        Ok(Effectiveness {
            values: inputs.iter().map(|input| values[input.parameter] / input.factor).collect(),
            inputs: inputs.to_vec(),
            wrench: self.wrench(&row),
            matrix,
            row,
        })
    }

    /// Returns the derivatives of the six components of force and torque, or an error if a derivative is
    /// missing. `ahead` contains the parameter values after a small change of the input.
    fn slopes(
        &self,
        ahead: &[f64],
        input: &Input,
        slopes: [Result<f64, NoSlope>; 6],
    ) -> Result<[f64; 6], ControlError> {
        let missing = COMPONENTS.into_iter().zip(slopes).find(|(_, slope)| slope.is_err());
        let Some((of, Err(reason))) = missing else { return Ok(slopes.map(Result::unwrap_or_default)) };
        // If the changed point is impossible, its row contains the reason.
        if reason == NoSlope::Edge
            && let Err(error @ ControlError::NotPeriodic { status: Status::Invalid, .. }) =
                self.settled(ahead, None)
        {
            return Err(error);
        }
        Err(ControlError::NoSlope { of, by: input.name.clone(), reason })
    }

    /// Returns the step for central differences (m/s or rad/s) if the input is a velocity or rate of the
    /// body, and otherwise `None`.
    fn motion_step(&self, input: &Input) -> Option<f64> {
        let name = self.vehicle.parameters()[input.parameter].name;
        let component = BodyParameters::MOTION.iter().position(|component| *component == name)?;
        Some(if component < 3 { VELOCITY_STEP } else { RATE_STEP })
    }

    /// Computes the derivatives of the six components of force and torque with respect to an input by central
    /// differences.
    ///
    /// In the four-bar model, the lift of each strip of the wing jumps at an attack angle of 90°. Exact
    /// derivatives therefore do not exist at some points.
    fn differences(
        &self,
        values: &[f64],
        input: &Input,
        step: f64,
        row: &Row,
    ) -> Result<[f64; 6], ControlError> {
        let (rtol, atol) =
            (self.solver.rtol.min(DIFFERENCE_RTOL), self.solver.atol.min(DIFFERENCE_RTOL / 100.0));
        let fine = VehicleRun { solver: &SolverSettings { rtol, atol, ..*self.solver }, ..*self };
        let side = |by: f64| {
            let mut values = values.to_vec();
            values[input.parameter] += by;
            fine.settled(&values, Some(&row.state)).map(|row| self.wrench(&row))
        };
        let (ahead, behind) = (side(step)?, side(-step)?);
        Ok(core::array::from_fn(|i| (ahead[i] - behind[i]) / (2.0 * step)))
    }
}

/// Largest relative tolerance of the integrator for the rows of central differences. The difference of two
/// rows has a larger relative error than each of the rows.
const DIFFERENCE_RTOL: f64 = 1e-9;

/// Change of the body's velocity for central differences (m/s).
const VELOCITY_STEP: f64 = 0.01;

/// Change of the body's angular rates for central differences (rad/s).
const RATE_STEP: f64 = 1.0;

/// Returns the indices of the force and torque components in the measures of a vehicle's row.
pub(crate) fn places(vehicle: &Vehicle) -> [usize; 6] {
    let columns = vehicle.columns();
    COMPONENTS.map(|name| columns.iter().position(|column| column.name == name).unwrap_or_default())
}

/// Returns a copy of `values` in which the parameters of all inputs are set. If a parameter of one wing is
/// not set, the parameter receives the value that applies to all wings.
pub(super) fn own_values(vehicle: &Vehicle, values: &[f64], inputs: &[Input]) -> Vec<f64> {
    let mut filled = values.to_vec();
    for input in inputs {
        filled[input.parameter] = standing(vehicle.parameters(), values, input.parameter);
    }
    filled
}

impl Effectiveness {
    /// Returns a copy of `values`, the vehicle's parameter values, in which the inputs have the values that
    /// this control effectiveness contains.
    pub fn applied(&self, values: &[f64]) -> Vec<f64> {
        let mut values = values.to_vec();
        for (input, value) in self.inputs.iter().zip(&self.values) {
            values[input.parameter] = value * input.factor;
        }
        values
    }

    /// Removes the inputs with a negligible effect. If all effects are zero, no input is removed.
    pub fn without_idle(mut self, vehicle_run: &VehicleRun<'_>, values: &[f64]) -> Effectiveness {
        let effects = self.inputs.iter().enumerate().map(|(j, input)| {
            let size = input.size(vehicle_run.vehicle, values).unwrap_or_default() / input.factor;
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

    /// Returns combinations of input changes whose effects on force and torque are perpendicular to each
    /// other. The combination with the largest effect comes first.
    ///
    /// The combinations are computed by singular value decomposition of the control matrix.
    pub fn combinations(&self) -> Vec<InputCombination> {
        let decomposed = self.matrix.clone().svd(true, true);
        let (Some(u), Some(v_t)) = (decomposed.u, decomposed.v_t) else { return Vec::new() };
        let combinations = decomposed.singular_values.iter().enumerate().map(|(i, &size)| {
            let inputs = v_t.row(i).transpose();
            // The sign is chosen so that the largest input is positive.
            let sign = inputs[inputs.iamax()].signum();
            InputCombination {
                size,
                components: core::array::from_fn(|j| sign * u[(j, i)]),
                inputs: inputs.iter().map(|share| sign * share).collect(),
            }
        });
        combinations.collect()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;

    fn combinations(matrix: DMatrix<f64>) -> Vec<InputCombination> {
        let (inputs, values, row) = (Vec::new(), Vec::new(), Row::invalid(""));
        Effectiveness { inputs, values, wrench: [0.0; 6], matrix, row }.combinations()
    }

    #[test]
    fn a_combination_of_one_input_has_the_sign_of_its_effect() {
        let combination =
            combinations(DMatrix::from_column_slice(6, 1, &[0.0, 0.0, 0.0, 0.0, -0.05, 0.0])).remove(0);
        assert!((combination.size - 0.05).abs() < 1e-12, "{combination:?}");
        assert!((combination.inputs[0] - 1.0).abs() < 1e-12, "{combination:?}");
        assert!((combination.components[4] + 1.0).abs() < 1e-12, "{combination:?}");
    }

    /// Checks that the matrix times the inputs of a combination equals the singular value times the
    /// combination's force and torque.
    #[test]
    fn combinations_have_the_effect_of_the_matrix() {
        let matrix = DMatrix::from_fn(6, 3, |i, j| (1.3 * i as f64 + 0.7 * (i * j) as f64 + 2.9).sin());
        let combinations = combinations(matrix.clone());
        assert_eq!(combinations.len(), 3);
        assert!(combinations.is_sorted_by(|one, next| one.size >= next.size), "{combinations:?}");
        for combination in combinations {
            let inputs = DVector::from_vec(combination.inputs.clone());
            let components = DVector::from_column_slice(&combination.components);
            assert!((&matrix * &inputs - combination.size * &components).amax() < 1e-12, "{combination:?}");
            assert!(
                (inputs.norm() - 1.0).abs() < 1e-12 && (components.norm() - 1.0).abs() < 1e-12,
                "{combination:?}"
            );
            assert!(inputs[inputs.iamax()] > 0.0, "{combination:?}");
        }
    }
}
