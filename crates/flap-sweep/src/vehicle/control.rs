//! Control effectiveness of a vehicle: the change of mean force and torque with each input.

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

/// Words for drive parameters, each with the names in different models.
pub const WORDS: [(&str, &[&str]); 6] = [
    ("amplitude", &["drive_voltage_pp"]),
    ("bias", &["drive_offset", "drive_bias"]),
    ("frequency", &["drive_frequency"]),
    ("second_harmonic", &["drive_second_harmonic"]),
    ("second_phase", &["drive_second_phase"]),
    ("third_harmonic", &["drive_third_harmonic"]),
];

/// Last part of the names of inputs that are differences between wings.
const DIFFERENCE: &str = "_difference";

/// Input of a vehicle: one of its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Name as the user gives it: a parameter, or a word such as `bias_difference`.
    pub name: String,
    /// Index in the vehicle's parameter table.
    pub parameter: usize,
    /// Unit for display, such as `V` or `deg`; may be empty.
    pub unit: &'static str,
    /// Factor from the display unit to SI.
    pub factor: f64,
}

impl Input {
    /// Returns the input called `name`: a parameter of the vehicle, or one of [`WORDS`].
    ///
    /// A word without the name of a wing applies to all wings. After the name of a wing, a word applies to this wing
    /// (`left_bias`), and before `_difference` to the left-right difference.
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

    /// Returns the default inputs of a vehicle: amplitude, bias and, if the drive has harmonics, the second harmonic.
    ///
    /// Each word for an input applies to all wings and, if there are wings on both sides, also to the difference.
    /// `values` are values of the vehicle's parameters. Inputs without a value are left out.
    pub fn usual(vehicle: &Vehicle, values: &[f64]) -> Vec<Input> {
        let parameters = vehicle.parameters();
        let shape = Parameter::index(parameters, "drive_shape");
        let shape = shape.and_then(|shape| text::option(&parameters[shape], values[shape]));
        let words = ["amplitude", "bias", "second_harmonic"];
        let words = if shape == Some("harmonics") { &words[..] } else { &words[..2] };
        let names = words.iter().flat_map(|word| [(*word).to_owned(), format!("{word}{DIFFERENCE}")]);
        let inputs = names.filter_map(|name| Input::of(vehicle, &name).ok());
        inputs.filter(|input| input.unset(vehicle, values).is_none()).collect()
    }

    /// Returns all names of inputs, for suggestions.
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

    /// Returns the parameter that the input changes, if this parameter has no value and follows other parameters.
    fn unset<'v>(&self, vehicle: &'v Vehicle, values: &[f64]) -> Option<&'v str> {
        let parameters = vehicle.parameters();
        let name = parameters[self.parameter].name;
        let index = match name.strip_prefix("difference_") {
            Some(of_all_wings) => Parameter::index(parameters, of_all_wings)?,
            None => self.parameter,
        };
        standing(parameters, values, index).is_nan().then_some(parameters[index].name)
    }

    /// Returns the change of the input along which its derivatives are computed, in SI units.
    ///
    /// A parameter that can only grow has a one-sided difference. At rest, this difference would be the square of the
    /// change.
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

    /// Returns the size (SI) of the input's parameter, to which relative changes refer.
    pub(super) fn size(&self, vehicle: &Vehicle, values: &[f64]) -> Result<f64, ControlError> {
        let size = derivative::size(vehicle, values, self.parameter);
        size.map(f64::abs).ok_or_else(|| ControlError::NoSize(self.name.clone()))
    }
}

/// Returns the index of the parameter that a name represents.
fn index(vehicle: &Vehicle, name: &str) -> Option<usize> {
    names(vehicle, name).iter().find_map(|name| Parameter::index(vehicle.parameters(), name))
}

/// Returns the parameters that a name may represent.
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

/// Components of force and torque: columns of rows.
pub const COMPONENTS: [&str; 6] = [FORCES[0], FORCES[1], FORCES[2], TORQUES[0], TORQUES[1], TORQUES[2]];

/// Effect below which an input is left out, relative to the largest effect of an input. A smaller effect counts as no
/// effect.
pub(super) const IDLE: f64 = 1e-9;

/// Reason why a control effectiveness or a trim cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ControlError {
    /// The motion of a wing has no derivatives.
    #[error("the vehicle does not settle on an orbit of one drive period: it is {}{}", status.name(), because(reason.as_deref()))]
    NotPeriodic {
        /// Status of the row of the motion.
        status: Status,
        /// Reason of an invalid row.
        reason: Option<String>,
    },
    /// A parameter that an input changes has no value.
    #[error("the input `{input}` changes `{parameter}`, which is not set: set `{parameter}` to a value")]
    Unset {
        /// Input.
        input: String,
        /// Parameter, which follows other parameters.
        parameter: String,
    },
    /// An input has the value zero and no typical size.
    #[error("`{0}` is zero and has no typical size: set it to another value")]
    NoSize(String),
    /// A derivative is missing.
    #[error("the derivative of {of} with respect to `{by}` is missing: {}", reason.name())]
    NoSlope {
        /// Component.
        of: &'static str,
        /// Input.
        by: String,
        /// Reason.
        reason: NoSlope,
    },
    /// The trim has more targets than inputs.
    #[error("{targets} targets need at least {targets} inputs with an effect, not only [{inputs}]")]
    FewInputs {
        /// Number of targets.
        targets: usize,
        /// Names of the inputs.
        inputs: String,
    },
    /// Further iterations do not reduce the distance from the targets. The error contains the nearest values.
    #[error("the targets are not reached: {0}")]
    NotReached(String),
    /// The motion cannot be computed.
    #[error(transparent)]
    Unfinished(#[from] Unfinished),
}

/// Returns a reason as the end of a message, such as ` (reason)`; empty without a reason.
pub(crate) fn because(reason: Option<&str>) -> String {
    reason.map(|reason| format!(" ({reason})")).unwrap_or_default()
}

/// A vehicle with the settings of its runs. The operating point is an argument of each method.
pub struct VehicleRun<'f> {
    /// Vehicle.
    pub vehicle: &'f Vehicle,
    /// Settings of the integration.
    pub solver: &'f SolverSettings,
    /// Callback that ends the computation early.
    pub interrupted: Interrupt<'f>,
}

/// Change of a vehicle's mean force and torque with its inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Effectiveness {
    /// Inputs, in the order of the columns.
    pub inputs: Vec<Input>,
    /// Values of the inputs, each in the unit of the input.
    pub values: Vec<f64>,
    /// Mean force (mN) and torque (uN·m), see [`COMPONENTS`].
    pub wrench: [f64; 6],
    /// 6 × inputs matrix: the change of each component, in mN or uN·m, per unit of each input.
    pub matrix: DMatrix<f64>,
    /// Row at the operating point.
    pub row: Row,
}

/// A combination of inputs, and the resulting combination of force and torque.
#[derive(Clone, Debug, PartialEq)]
pub struct InputCombination {
    /// Singular value: force (mN) and torque (uN·m, which is mN at 1 mm) per unit of the combination.
    pub size: f64,
    /// Components of force and torque as a unit vector.
    pub components: [f64; 6],
    /// Inputs as a unit vector.
    pub inputs: Vec<f64>,
}

impl VehicleRun<'_> {
    /// Returns the row at the given values of the vehicle's parameters. If `begin` is given, the motion starts from the
    /// state `begin`.
    pub fn row(&self, values: &[f64], begin: Option<&[f64]>) -> Row {
        let run = PointRun::new(Backend::best(), self.solver, values).until(self.interrupted);
        self.vehicle.run_point(&run, begin)
    }

    /// Returns the row of a periodic motion. [`VehicleRun::row`] has the same arguments.
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

    /// Returns mean force (mN) and torque (uN·m) of a row with measures.
    pub fn wrench(&self, row: &Row) -> [f64; 6] {
        places(self.vehicle).map(|place| row.measures[place])
    }

    /// Returns the control effectiveness of `inputs` at these values, from exact derivatives of the settled orbit.
    ///
    /// In the four-bar model, derivatives with respect to the motion of the body are central differences.
    /// An unset parameter of one wing has the value of all wings.
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

    /// Returns the derivatives of the components, if all derivatives are known. `ahead` is the point after a change of
    /// the input.
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

    /// Returns the step (m/s, rad/s) for differences with respect to an input that is a motion of the body.
    fn motion_step(&self, input: &Input) -> Option<f64> {
        let name = self.vehicle.parameters()[input.parameter].name;
        let component = BodyParameters::MOTION.iter().position(|component| *component == name)?;
        Some(if component < 3 { VELOCITY_STEP } else { RATE_STEP })
    }

    /// Returns the central differences of the components with respect to an input.
    ///
    /// These differences replace exact derivatives in the four-bar model, in which the lift jumps at one strip
    /// after the other.
    fn differences(
        &self,
        values: &[f64],
        input: &Input,
        step: f64,
        row: &Row,
    ) -> Result<[f64; 6], ControlError> {
        let side = |by: f64| {
            let mut values = values.to_vec();
            values[input.parameter] += by;
            self.settled(&values, Some(&row.state)).map(|row| self.wrench(&row))
        };
        let (ahead, behind) = (side(step)?, side(-step)?);
        Ok(core::array::from_fn(|i| (ahead[i] - behind[i]) / (2.0 * step)))
    }
}

/// Change of a velocity of the body for computing differences (m/s).
const VELOCITY_STEP: f64 = 0.01;

/// Change of a rate of the body for computing differences (rad/s).
const RATE_STEP: f64 = 1.0;

/// Returns the indices of force and torque among the measures of a vehicle's rows.
pub(crate) fn places(vehicle: &Vehicle) -> [usize; 6] {
    let columns = vehicle.columns();
    COMPONENTS.map(|name| columns.iter().position(|column| column.name == name).unwrap_or_default())
}

/// Returns the values, in which each unset parameter of one wing has the value of all wings.
pub(super) fn own_values(vehicle: &Vehicle, values: &[f64], inputs: &[Input]) -> Vec<f64> {
    let mut filled = values.to_vec();
    for input in inputs {
        filled[input.parameter] = standing(vehicle.parameters(), values, input.parameter);
    }
    filled
}

impl Effectiveness {
    /// Returns the vehicle's values with the values of the inputs.
    pub fn applied(&self, values: &[f64]) -> Vec<f64> {
        let mut values = values.to_vec();
        for (input, value) in self.inputs.iter().zip(&self.values) {
            values[input.parameter] = value * input.factor;
        }
        values
    }

    /// Returns the control effectiveness without inputs that have a negligible effect, unless no input would be left.
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

    /// Returns the combinations of inputs that produce force and torque, beginning with the strongest combination.
    ///
    /// The combinations and their effects are the singular value decomposition of the matrix.
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

    /// The matrix times the inputs of a combination is its size times its force and torque.
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
