//! Simulates the flight of a vehicle over time, either with the coupled motion of wings and body, or with the
//! linear model about hover.
//!
//! The body is rigid. At each instant, the force and torque of the air on the wings accelerate the body. The
//! motion of the wings depends on the velocity and the angular rates of the body, but not on its
//! acceleration. The inertial forces of the wings on the body are neglected, because the wings are light.
//!
//! A feedback can change the inputs at the beginning of each wing beat. The feedback uses the mean states
//! over the previous beat.

use core::f64::consts::TAU;

use flap_core::ode::tableau::{A, B, C, E, STAGES};
use flap_core::parameter::{Invalid, Kind, Parameter};
use flap_core::simulate::{Simulator as _, SolverSettings, Unfinished};
use flap_core::vehicle::{MassProperties, MovingWings};
use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, UnitQuaternion, Vector3, Vector6};

use super::control::{COMPONENTS, ControlError, Input, VehicleRun, own_values};
use super::hover::{HoverError, HoverModel, STATES, WRENCH_TO_SI, body_at_rest, inertia, inverse_mass};

/// Number of states that a disturbance can change and that the feedback receives: three velocities, three
/// rates and three angles.
pub const FED_BACK: usize = 9;

/// Largest number of wing beats of a simulated flight.
const MOST_BEATS: f64 = 1e6;

/// Largest number of rows of a simulated flight. All rows are stored in memory.
const MOST_ROWS: f64 = 5e6;

/// Settings of a flight simulation.
#[derive(Clone, Debug)]
pub struct FlightRequest {
    /// Duration of the flight (s), which is rounded up to full wing beats.
    pub seconds: f64,
    /// Velocities (m/s), rates (rad/s) and angles (rad) of the body at the beginning of the flight, without
    /// the vibration during a wing beat.
    pub disturbance: [f64; FED_BACK],
    /// The inputs of the vehicle that the feedback changes. The record of the flight has one column for each
    /// input.
    pub inputs: Vec<Input>,
    /// Gains K of the feedback, in SI units: K x is subtracted from the initial inputs, where x contains the
    /// states. The matrix has one row for each input and [`FED_BACK`] columns.
    pub gains: Option<DMatrix<f64>>,
    /// True to simulate the linear model about hover, and false to simulate the coupled motion of wings and
    /// body.
    pub is_averaged: bool,
    /// Number of rows for each wing beat. If `None`, there is one row for each beat, with means over the
    /// beat.
    pub samples: Option<u32>,
}

/// A simulated flight.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightRecord {
    /// Names of the columns: time, states, inputs, force and torque.
    pub columns: Vec<String>,
    /// The rows of the flight record. A row with means over a beat has the time in the middle of the beat.
    pub rows: Vec<Vec<f64>>,
    /// The reason why the flight ended early. `None` if the flight has its full duration.
    pub end: Option<String>,
}

/// The reason why a flight cannot be simulated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FlightError {
    /// The settings of the flight are not allowed. The text describes the mistake and the allowed values.
    #[error("{0}")]
    Request(String),
    /// The linear model about hover or the settled motion of the wings cannot be computed.
    #[error(transparent)]
    Hover(#[from] HoverError),
}

/// Simulates a flight. At the beginning, the wings have the settled motion for `values`, the values of the
/// vehicle's parameters.
///
/// # Errors
/// Returns an error if the settings are not allowed, if mass properties are missing, or if parameters set a
/// motion of the body. A motion of the wings that is not periodic at the beginning is also an error. If the
/// simulation fails during the flight, the record ends early and contains the reason.
pub fn fly(
    vehicle_run: &VehicleRun<'_>,
    values: &[f64],
    request: &FlightRequest,
) -> Result<FlightRecord, FlightError> {
    let FlightRequest { seconds, disturbance, inputs, gains, is_averaged, samples } = request;
    let refused = |mistake: String| Err(FlightError::Request(mistake));
    if let Some(i) = disturbance.iter().position(|number| !number.is_finite()) {
        return refused(format!("the disturbance of {} is not finite", STATES[i].0));
    }
    if *samples == Some(0) {
        return refused("0 samples in a wing beat are too few: at least 1 is required".to_owned());
    }
    if let Some(gains) = gains {
        let (rows, columns) = gains.shape();
        if (rows, columns) != (inputs.len(), FED_BACK) || !gains.iter().all(|gain| gain.is_finite()) {
            return refused(format!(
                "the gains have {rows} rows and {columns} columns, but must be {} x {FED_BACK} finite numbers: one row \
                 for each input, one column for each velocity, rate and angle",
                inputs.len()
            ));
        }
    }
    let body = body_at_rest(vehicle_run.vehicle, values)?;
    let values = own_values(vehicle_run.vehicle, values, inputs);
    let point = DVector::from_iterator(inputs.len(), inputs.iter().map(|input| values[input.parameter]));
    let mut motion: Box<dyn Motion + '_> = if *is_averaged {
        Box::new(Averaged::new(vehicle_run, &values, inputs, disturbance)?)
    } else {
        Box::new(Coupled::new(vehicle_run, values, body, inputs, disturbance)?)
    };
    if !(*seconds > 0.0 && *seconds <= MOST_BEATS * motion.period()) {
        return refused(format!(
            "a flight of {seconds} s is impossible: the duration must be positive, with at most 1e6 wing beats"
        ));
    }
    let parts = samples.unwrap_or(1);
    let rows = (seconds / motion.period() * (1.0 - 1e-12)).ceil() * f64::from(parts);
    if rows > MOST_ROWS {
        return refused(format!(
            "{parts} samples in each wing beat are too many: a flight of {seconds} s has {rows} samples, and at most 5e6 are allowed"
        ));
    }
    let mut record = FlightRecord { columns: columns(inputs), rows: Vec::new(), end: None };
    let (mut time, mut now) = (0.0, point.clone());
    record.end = 'flight: loop {
        if time >= seconds * (1.0 - 1e-12) {
            break None;
        }
        let period = motion.period();
        let mut rows = Vec::new();
        for part in 0..parts {
            if (vehicle_run.interrupted)() {
                return Err(HoverError::from(ControlError::from(Unfinished::Interrupted)).into());
            }
            let [from, to] = [part, part + 1].map(|part| period * f64::from(part) / f64::from(parts));
            if samples.is_some() {
                rows.push(row(time + from, &motion.state(from), &now));
            }
            if let Err(reason) = motion.advance(from, to) {
                break 'flight Some(reason);
            }
        }
        let means = motion.end_beat();
        if samples.is_none() {
            rows.push(row(time + 0.5 * period, &means, &now));
        }
        record.rows.append(&mut rows);
        time += period;
        if let Some(gains) = gains {
            now = &point - gains * DVector::from_column_slice(&means.states[..FED_BACK]);
            let set = check_ranges(vehicle_run, inputs, &now).and_then(|()| motion.set_inputs(&now));
            if let Err(reason) = set {
                break Some(reason);
            }
        }
    };
    Ok(record)
}

/// Checks that each input value (SI) is in the allowed range of its parameter.
fn check_ranges(vehicle_run: &VehicleRun<'_>, inputs: &[Input], values: &DVector<f64>) -> Result<(), String> {
    for (input, &value) in inputs.iter().zip(values.iter()) {
        let parameter = &vehicle_run.vehicle.parameters()[input.parameter];
        if let Kind::Number(range) | Kind::Following(range, _) = parameter.kind
            && !range.contains(value)
        {
            return Err(format!("{} is {value}, but must be {}", parameter.name, range.describe()));
        }
    }
    Ok(())
}

/// Returns the names of the columns of a flight record.
fn columns(inputs: &[Input]) -> Vec<String> {
    let states = STATES.iter().map(|(name, unit)| format!("{name}_{}", unit.replace('/', "_")));
    let names = core::iter::once("time_s".to_owned()).chain(states);
    let names = names.chain(inputs.iter().map(|input| input.name.clone()));
    names.chain(COMPONENTS.iter().map(|&name| name.to_owned())).collect()
}

fn row(time: f64, at: &BodyState, inputs: &DVector<f64>) -> Vec<f64> {
    let wrench = at.wrench.iter().zip(WRENCH_TO_SI).map(|(component, unit)| component / unit);
    let states = at.states.iter().chain(inputs).copied();
    core::iter::once(time).chain(states).chain(wrench).collect()
}

/// The states of the body in the order of [`STATES`], with the force (N) and the torque (N·m) on the body.
struct BodyState {
    states: [f64; 12],
    wrench: [f64; 6],
}

/// A simulated motion of a vehicle, which is computed wing beat by wing beat.
trait Motion {
    /// Returns the duration of the current wing beat (s).
    fn period(&self) -> f64;

    /// Integrates the motion between two times within the beat (s). The error value describes why the flight
    /// ends early.
    fn advance(&mut self, from: f64, to: f64) -> Result<(), String>;

    /// Returns the state at a time within the beat (s). The motion must be integrated up to this time.
    fn state(&mut self, time: f64) -> BodyState;

    /// Ends the wing beat and returns the means over the beat.
    fn end_beat(&mut self) -> BodyState;

    /// Sets the inputs (SI) for the next beat. The error value describes why the new inputs are impossible.
    fn set_inputs(&mut self, inputs: &DVector<f64>) -> Result<(), String>;
}

/// Number of integrated states of the body: velocities, rates, attitude as a quaternion, and position.
const BODY: usize = 13;

/// Number of integrals over a wing beat: integrals of the body's states, and of force and torque.
const INTEGRALS: usize = BODY + 6;

/// Typical sizes of the body's states, by which the absolute tolerance of the integration is multiplied.
const BODY_SCALE: [f64; BODY] = [0.1, 0.1, 0.1, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.01, 0.01, 0.01];

/// The coupled motion of wings and body.
///
/// ```text
/// m (v̇ + ω × v) = F − m g Rᵀ e_z     I ω̇ + ω × I ω = M     q̇ = ½ q (0, ω)     ẋ = R v
/// ```
struct Coupled<'a> {
    vehicle_run: &'a VehicleRun<'a>,
    values: Vec<f64>,
    inputs: &'a [Input],
    equations: Equations,
    /// The states of the wings, the states of the body, and the integrals since the beginning of the beat.
    y: Vec<f64>,
    integrator: Integrator<'a>,
    /// The yaw angles (rad) at the beginning of the beat and now. The angle does not jump after half a turn of
    /// the body.
    headings: [f64; 2],
}

/// Equations of the coupled motion of wings and body.
struct Equations {
    wings: MovingWings,
    /// Number of states of all wings.
    of_wings: usize,
    body: MassProperties,
    inertia: Matrix3<f64>,
    inverse: Matrix3<f64>,
}

impl<'a> Coupled<'a> {
    fn new(
        vehicle_run: &'a VehicleRun<'a>,
        values: Vec<f64>,
        body: MassProperties,
        inputs: &'a [Input],
        disturbance: &[f64; FED_BACK],
    ) -> Result<Coupled<'a>, HoverError> {
        let settled = vehicle_run.settled(&values, None)?.state;
        let wings = vehicle_run.vehicle.moving_wings(&values).map_err(ControlError::from)?;
        let of_wings = settled.len();
        let mut scale = wings.scale();
        scale.extend(BODY_SCALE);
        scale.resize(of_wings + BODY + INTEGRALS, f64::INFINITY);
        let integrator = Integrator { solver: vehicle_run.solver, scale, step: wings.period() / 200.0 };
        let inverse = inverse_mass(&body)?.fixed_view::<3, 3>(3, 3).into_owned();
        let equations = Equations { wings, of_wings, body, inertia: inertia(&body), inverse };
        let mut coupled =
            Coupled { vehicle_run, values, inputs, equations, y: Vec::new(), integrator, headings: [0.0; 2] };
        coupled.begin(&settled, &[0.0; FED_BACK]);
        let diverges = |_| ControlError::from(Unfinished::from(Invalid::new("the motion diverges")));
        let vibration = coupled.vibration().map_err(diverges)?;
        coupled.begin(&settled, &core::array::from_fn(|i| disturbance[i] - vibration[i]));
        Ok(coupled)
    }

    /// Sets the initial state: `wings` contains the states of the wings, and `body` contains the velocities,
    /// rates and angles of the body.
    fn begin(&mut self, wings: &[f64], body: &[f64; FED_BACK]) {
        let [roll, pitch, yaw] = [body[6], body[7], body[8]];
        let attitude = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        self.headings = [yaw; 2];
        self.y = wings.to_vec();
        self.y.extend(&body[..6]);
        self.y.extend([attitude.w, attitude.i, attitude.j, attitude.k]);
        self.y.resize(self.integrator.scale.len(), 0.0);
    }

    /// Returns the contribution of the body's vibration to the mean velocities, rates and angles over the
    /// first beat.
    ///
    /// The body begins at rest. The result is the mean over the beat, minus half of the value at the end of
    /// the beat. Without vibration, the change is linear in time, and the mean is half of the end value.
    fn vibration(&mut self) -> Result<[f64; FED_BACK], String> {
        let period = self.period();
        self.advance(0.0, period)?;
        let end = body_states(&self.y[self.equations.of_wings..], self.headings[1]);
        let mean = self.means(period);
        Ok(core::array::from_fn(|i| mean[i] - 0.5 * end[i]))
    }

    /// Returns the mean states over a wing beat. The mean angles are computed from the mean quaternion.
    fn means(&self, period: f64) -> [f64; 12] {
        let integrals = &self.y[self.equations.of_wings + BODY..];
        let means: Vec<f64> = integrals[..BODY].iter().map(|integral| integral / period).collect();
        let [begin, end] = self.headings;
        body_states(&means, f64::midpoint(begin, end))
    }
}

impl Motion for Coupled<'_> {
    fn period(&self) -> f64 {
        self.equations.wings.period()
    }

    fn advance(&mut self, from: f64, to: f64) -> Result<(), String> {
        let attitude = self.equations.of_wings + 6..self.equations.of_wings + 10;
        let heading = &mut self.headings[1];
        self.integrator.advance(&self.equations, [from, to], &mut self.y, |y| {
            *heading = angles(&y[attitude.clone()], *heading)[2];
        })
    }

    fn state(&mut self, time: f64) -> BodyState {
        let mut slope = vec![0.0; self.y.len()];
        self.equations.derivative(time, &self.y, &mut slope);
        let states = body_states(&self.y[self.equations.of_wings..], self.headings[1]);
        let wrench = slope.len() - 6;
        BodyState { states, wrench: core::array::from_fn(|i| slope[wrench + i]) }
    }

    fn end_beat(&mut self) -> BodyState {
        let period = self.period();
        let states = self.means(period);
        self.headings[0] = self.headings[1];
        let wrench = self.y.len() - 6;
        let wrench = core::array::from_fn(|i| self.y[wrench + i] / period);
        // Rounding and errors of integration change the length of the quaternion.
        let begin = self.equations.of_wings;
        let attitude = UnitQuaternion::from_quaternion(quaternion(&self.y[begin + 6..]));
        self.y[begin + 6..begin + 10].copy_from_slice(&[attitude.w, attitude.i, attitude.j, attitude.k]);
        self.y[begin + BODY..].fill(0.0);
        BodyState { states, wrench }
    }

    fn set_inputs(&mut self, inputs: &DVector<f64>) -> Result<(), String> {
        for (input, &value) in self.inputs.iter().zip(inputs.iter()) {
            self.values[input.parameter] = value;
        }
        let wings = self.vehicle_run.vehicle.moving_wings(&self.values);
        self.equations.wings = wings.map_err(|error| error.to_string())?;
        Ok(())
    }
}

/// Returns the quaternion with the components w, x, y and z.
fn quaternion(numbers: &[f64]) -> Quaternion<f64> {
    Quaternion::new(numbers[0], numbers[1], numbers[2], numbers[3])
}

/// Returns the roll, pitch and yaw angles (rad) of an attitude with the components w, x, y and z. The yaw
/// angle differs by at most half a turn from `heading`.
fn angles(attitude: &[f64], heading: f64) -> [f64; 3] {
    let (roll, pitch, yaw) = UnitQuaternion::from_quaternion(quaternion(attitude)).euler_angles();
    [roll, pitch, yaw + TAU * ((heading - yaw) / TAU).round()]
}

/// Converts the integrated states of the body, with a quaternion, to the states in [`STATES`], with angles. The
/// yaw angle differs by at most half a turn from `heading`.
fn body_states(body: &[f64], heading: f64) -> [f64; 12] {
    let [roll, pitch, yaw] = angles(&body[6..10], heading);
    [body[0], body[1], body[2], body[3], body[4], body[5], roll, pitch, yaw, body[10], body[11], body[12]]
}

impl Equations {
    /// Computes the time derivatives of the states and the integrals.
    fn derivative(&self, t: f64, y: &[f64], slope: &mut [f64]) {
        let (wings, rest) = y.split_at(self.of_wings);
        let (of_wings, of_rest) = slope.split_at_mut(self.of_wings);
        let motion: [f64; 6] = core::array::from_fn(|i| rest[i]);
        let wrench = self.wings.derivative(t, wings, &motion, of_wings);
        let [velocity, rate] = [&rest[..3], &rest[3..6]].map(Vector3::from_column_slice);
        let [force, torque] = [&wrench[..3], &wrench[3..]].map(Vector3::from_column_slice);
        let attitude = quaternion(&rest[6..10]);
        let turned = UnitQuaternion::from_quaternion(attitude);
        let weight = turned.inverse_transform_vector(&Vector3::new(0.0, 0.0, -self.body.gravity));
        let acceleration = force / self.body.mass + weight - rate.cross(&velocity);
        let angular = self.inverse * (torque - rate.cross(&(self.inertia * rate)));
        let turn = attitude * Quaternion::from_imag(rate * 0.5);
        let travel = turned * velocity;
        of_rest[..3].copy_from_slice(acceleration.as_slice());
        of_rest[3..6].copy_from_slice(angular.as_slice());
        of_rest[6..10].copy_from_slice(&[turn.w, turn.i, turn.j, turn.k]);
        of_rest[10..BODY].copy_from_slice(travel.as_slice());
        of_rest[BODY..2 * BODY].copy_from_slice(&rest[..BODY]);
        of_rest[2 * BODY..].copy_from_slice(&wrench);
    }
}

/// The Dormand-Prince 5(4) method with step-size control, for any number of states.
///
/// [`flap_core::ode::solve`] requires the number of states at compile time. The number of states of a flight
/// depends on the number of wings.
struct Integrator<'a> {
    /// The relative and the absolute tolerance, and the largest number of steps of one integration.
    solver: &'a SolverSettings,
    /// Typical size of each state. For integrals the size is infinite, so that their errors do not limit the
    /// step size.
    scale: Vec<f64>,
    /// Length of the next step (s).
    step: f64,
}

impl Integrator<'_> {
    /// Integrates `y` between two times (s). After each step, `after` is called with the new states. The error
    /// value describes why the integration failed.
    fn advance(
        &mut self,
        equations: &Equations,
        [from, to]: [f64; 2],
        y: &mut Vec<f64>,
        mut after: impl FnMut(&[f64]),
    ) -> Result<(), String> {
        let SolverSettings { rtol, atol, .. } = *self.solver;
        let counted = self.scale.iter().filter(|scale| scale.is_finite()).count() as f64;
        let mut k = vec![vec![0.0; y.len()]; STAGES];
        let mut next = vec![0.0; y.len()];
        let mut t = from;
        equations.derivative(t, y, &mut k[0]);
        for _ in 0..self.solver.max_steps {
            let is_last = t + self.step * (1.0 + 1e-9) >= to;
            let h = if is_last { to - t } else { self.step };
            for stage in 1..STAGES {
                for (i, next) in next.iter_mut().enumerate() {
                    let sum: f64 = (0..stage).map(|j| A[stage][j] * k[j][i]).sum();
                    *next = h.mul_add(sum, y[i]);
                }
                // The last stage has the weights of the new state.
                debug_assert!(stage + 1 < STAGES || A[stage][..] == B[..6]);
                equations.derivative(C[stage].mul_add(h, t), &next, &mut k[stage]);
            }
            let square = |i: usize| {
                let error: f64 = (0..STAGES).map(|j| E[j] * k[j][i]).sum();
                let size = rtol * y[i].abs().max(next[i].abs()) + atol * self.scale[i];
                (h * error / size).powi(2)
            };
            let error = ((0..y.len()).map(square).sum::<f64>() / counted).sqrt();
            if !(error.is_finite() && h > 0.0) {
                return Err("the motion diverges".to_owned());
            }
            let factor = (0.9 * error.powf(-0.2)).clamp(0.2, 5.0);
            if error > 1.0 {
                self.step = h * factor.min(1.0);
                if t + self.step <= t {
                    return Err("the motion needs steps that are too small".to_owned());
                }
                continue;
            }
            core::mem::swap(y, &mut next);
            after(y);
            k.swap(0, STAGES - 1);
            if is_last {
                // The last step may be short.
                self.step = self.step.max(h * factor);
                return Ok(());
            }
            t += h;
            self.step = h * factor;
        }
        Err("the motion needs more than max_steps steps in a drive period".to_owned())
    }
}

/// Number of states of the linear model.
const N: usize = STATES.len();

/// A flight that is simulated with the linear model about hover. Force and torque in this model are means
/// over a wing beat.
struct Averaged {
    hover: HoverModel,
    /// Values of the inputs at the operating point (SI).
    point: DVector<f64>,
    /// Current inputs minus the inputs at the operating point (SI).
    change: DVector<f64>,
    /// Accelerations of the body that the unbalanced force and torque at the operating point cause.
    residual: DVector<f64>,
    /// The 12 states, the integrals of the states since the beginning of the beat, and the constant 1.
    y: DVector<f64>,
    /// Drive frequency (Hz).
    frequency: f64,
    /// Position of the drive frequency in the list of inputs, if the drive frequency is an input.
    frequency_input: Option<usize>,
}

impl Averaged {
    fn new(
        vehicle_run: &VehicleRun<'_>,
        values: &[f64],
        inputs: &[Input],
        disturbance: &[f64; FED_BACK],
    ) -> Result<Averaged, HoverError> {
        let at = vehicle_run.effectiveness(values, inputs, None)?;
        let hover = HoverModel::at(vehicle_run, values, &at, true)?;
        let residual = inverse_mass(&hover.body)? * Vector6::from(hover.residual());
        let mut y = DVector::zeros(2 * N + 1);
        y.rows_mut(0, FED_BACK).copy_from_slice(disturbance);
        y[2 * N] = 1.0;
        let frequency = Parameter::index(vehicle_run.vehicle.parameters(), "drive_frequency");
        Ok(Averaged {
            hover,
            point: DVector::from_iterator(inputs.len(), inputs.iter().map(|input| values[input.parameter])),
            change: DVector::zeros(inputs.len()),
            residual: residual.resize_vertically(N, 0.0),
            y,
            frequency: frequency.map_or(f64::NAN, |index| values[index]),
            frequency_input: inputs.iter().position(|input| Some(input.parameter) == frequency),
        })
    }

    /// Returns the state of the body, with the force and torque that the linear model gives for this state.
    /// The first 12 elements of `states` are the state.
    fn body(&self, states: &[f64]) -> BodyState {
        let hover = &self.hover;
        let wrench = hover.damping * Vector6::from_column_slice(&states[..6]) + &hover.control * &self.change;
        BodyState {
            states: core::array::from_fn(|i| states[i]),
            wrench: core::array::from_fn(|i| hover.wrench[i] + wrench[i]),
        }
    }
}

impl Motion for Averaged {
    fn period(&self) -> f64 {
        1.0 / self.frequency
    }

    /// Computes the states at the time `to` by a matrix exponential. The matrix also contains the integrals
    /// of the states and a constant.
    fn advance(&mut self, from: f64, to: f64) -> Result<(), String> {
        let hover = &self.hover;
        let mut matrix = DMatrix::zeros(2 * N + 1, 2 * N + 1);
        matrix.view_mut((0, 0), (N, N)).copy_from(&hover.a);
        matrix.view_mut((0, 2 * N), (N, 1)).copy_from(&(&hover.b * &self.change + &self.residual));
        matrix.view_mut((N, 0), (N, N)).fill_with_identity();
        self.y = (matrix * (to - from)).exp() * &self.y;
        if self.y.iter().all(|number| number.is_finite()) {
            Ok(())
        } else {
            Err("the motion diverges".to_owned())
        }
    }

    fn state(&mut self, _time: f64) -> BodyState {
        self.body(self.y.as_slice())
    }

    fn end_beat(&mut self) -> BodyState {
        let means = self.y.rows(N, N) / self.period();
        self.y.rows_mut(N, N).fill(0.0);
        self.body(means.as_slice())
    }

    fn set_inputs(&mut self, inputs: &DVector<f64>) -> Result<(), String> {
        self.change = inputs - &self.point;
        if let Some(input) = self.frequency_input {
            self.frequency = inputs[input];
        }
        Ok(())
    }
}
