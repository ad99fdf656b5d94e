//! Computes hover of a vehicle and the linear model near hover: state and input matrix, and modes of motion.
//!
//! The wings are treated as quasi-static: the mean force and torque depend only on the present inputs,
//! velocity and rates of the body. Torques must be given about the centre of mass. Velocities and rates are
//! in body axes: x forward, y to the left, z up. All numbers are in SI units.

use flap_core::body::BodyParameters;
use flap_core::parameter::Parameter;
use flap_core::simulate::Simulator as _;
use flap_core::vehicle::{MassProperties, Vehicle};
use nalgebra::{Complex, DMatrix, Matrix3, Matrix6, Vector6};

use super::control::{COMPONENTS, ControlError, Effectiveness, Input, VehicleRun};
use super::modes::{self, HoverMode};
use super::trim::{self, Target};

/// Names and units of the states: velocities, angular rates, small angles about the body axes, and positions.
pub const STATES: [(&str, &str); 12] = [
    ("velocity_forward", "m/s"),
    ("velocity_left", "m/s"),
    ("velocity_up", "m/s"),
    ("rate_roll", "rad/s"),
    ("rate_pitch", "rad/s"),
    ("rate_yaw", "rad/s"),
    ("angle_roll", "rad"),
    ("angle_pitch", "rad"),
    ("angle_yaw", "rad"),
    ("position_forward", "m"),
    ("position_left", "m"),
    ("position_up", "m"),
];

/// SI units of the three force components and the three torque components.
pub const WRENCH_UNITS: [&str; 6] = ["N", "N", "N", "N*m", "N*m", "N*m"];

/// Factors that convert the force and torque of a row, in mN and uN·m, to N and N·m.
pub const WRENCH_TO_SI: [f64; 6] = [1e-3, 1e-3, 1e-3, 1e-6, 1e-6, 1e-6];

/// Largest unbalanced force that is accepted as hover, as a fraction of the weight.
pub(crate) const TRIM_LIMIT: f64 = 1e-2;

/// The largest accepted unbalanced torque is the largest accepted unbalanced force times this length (m).
const TRIM_LEVER: f64 = 1e-3;

/// Returns the sizes by which unbalanced forces and torques are divided: the weight (N), and the weight times
/// 1 mm (N·m).
fn residual_sizes(body: &MassProperties) -> [f64; 6] {
    let weight = body.mass * body.gravity;
    core::array::from_fn(|i| if i < 3 { weight } else { weight * TRIM_LEVER })
}

/// Returns the largest unbalanced component of a wrench (N and N·m) at hover. Each component is divided by
/// its size in [`residual_sizes`].
pub(super) fn residual_share(body: &MassProperties, wrench: &[f64; 6]) -> f64 {
    let sizes = residual_sizes(body);
    let share = |i: usize| wrench[i] / sizes[i] - if i == 2 { 1.0 } else { 0.0 };
    (0..6).map(|i| share(i).abs()).fold(0.0, f64::max)
}

const NOT_POSITIVE: &str = "the inertia of the body is not positive definite: moments must be positive, and the square of \
    body_inertia_product must be smaller than body_inertia_roll times body_inertia_yaw";

/// The reason why the linear model about hover cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HoverError {
    /// Some mass properties of the vehicle are not set.
    #[error("the hover model requires {}: set {}", .0.join(", "), if .0.len() == 1 { "it" } else { "them" })]
    Missing(Vec<&'static str>),
    /// No rigid body can have these mass properties. The text describes the condition that the mass
    /// properties violate.
    #[error("{0}")]
    Impossible(String),
    /// The model has no parameters for the velocity and the rates of the body.
    #[error("the model has no parameters for the motion of the body, such as body_velocity_forward")]
    NoBodyMotion,
    /// A parameter sets a velocity or rate of the body, but the body must be at rest.
    #[error("`{0}` is not zero, but the hover model requires a body at rest")]
    Moving(&'static str),
    /// A motion or a derivative cannot be computed.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// The search finds no values of the inputs at which the vehicle hovers.
    #[error("the vehicle does not reach hover: {0}")]
    Trim(ControlError),
    /// The computation of the eigenvalues does not converge, or the state matrix contains values that are not
    /// finite.
    #[error("the eigenvalues of the hover model cannot be computed")]
    Eigenvalues,
}

/// Checks that all mass properties are set, and that a rigid body can have these moments of inertia.
fn check(body: &MassProperties) -> Result<(), HoverError> {
    let [roll, pitch, yaw] = body.inertia;
    let named = [
        ("total_mass", body.mass),
        ("body_inertia_roll", roll),
        ("body_inertia_pitch", pitch),
        ("body_inertia_yaw", yaw),
        ("body_inertia_product", body.product),
        ("gravity", body.gravity),
    ];
    let missing: Vec<&'static str> =
        named.iter().filter(|(_, value)| value.is_nan()).map(|(name, _)| *name).collect();
    if !missing.is_empty() {
        return Err(HoverError::Missing(missing));
    }
    let impossible = |condition: String| Err(HoverError::Impossible(condition));
    if body.mass <= 0.0 {
        return impossible(format!("total_mass is {} kg, but must be positive", body.mass));
    }
    let mean = f64::midpoint(roll, yaw);
    let half = f64::midpoint(roll, -yaw).hypot(body.product);
    let principal = [mean + half, pitch, mean - half];
    if principal.iter().any(|moment| *moment <= 0.0) {
        return impossible(NOT_POSITIVE.to_owned());
    }
    let largest = principal.iter().copied().fold(0.0, f64::max);
    // A flat body reaches the limit, so rounding must not reject it.
    if largest > 0.5 * principal.iter().sum::<f64>() * (1.0 + 1e-12) {
        let [x, y, z] = principal;
        return impossible(format!(
            "no body has the principal moments of inertia {x:.4e}, {y:.4e} and {z:.4e} kg*m^2: each moment is at most \
             the sum of the other two"
        ));
    }
    Ok(())
}

/// Checks that the parameters set no velocity and no rates of the body.
fn at_rest(vehicle: &Vehicle, values: &[f64]) -> Result<(), HoverError> {
    let index = |name: &str| Parameter::index(vehicle.parameters(), name);
    let is_moving = |name: &&str| index(name).is_some_and(|index| values[index] != 0.0);
    BodyParameters::MOTION.into_iter().find(is_moving).map_or(Ok(()), |name| Err(HoverError::Moving(name)))
}

/// Returns the mass properties of a vehicle whose body is at rest.
///
/// # Errors
/// Returns an error if mass properties are missing or impossible, or if a velocity or rate of the body is not
/// zero.
pub(super) fn body_at_rest(vehicle: &Vehicle, values: &[f64]) -> Result<MassProperties, HoverError> {
    let body = vehicle.mass_properties(values);
    check(&body)?;
    at_rest(vehicle, values)?;
    Ok(body)
}

/// Returns the damping matrix: the derivatives of force (N) and torque (N·m) with respect to velocity (m/s)
/// and rates (rad/s) of the body.
///
/// The motion starts from the state `begin`, which should be a state of the settled motion.
///
/// # Errors
/// Returns an error if the model has no parameters for the body's motion. A motion that is not periodic, and
/// a missing derivative, are also errors.
pub fn damping(
    vehicle_run: &VehicleRun<'_>,
    values: &[f64],
    begin: &[f64],
) -> Result<Matrix6<f64>, HoverError> {
    let motions = BodyParameters::MOTION.into_iter().map(|name| Input::of(vehicle_run.vehicle, name));
    let motions: Vec<Input> = motions.collect::<Result<_, _>>().map_err(|_| HoverError::NoBodyMotion)?;
    let found = vehicle_run.effectiveness(values, &motions, Some(begin))?;
    Ok(Matrix6::from_fn(|i, j| found.matrix[(i, j)] * WRENCH_TO_SI[i]))
}

/// Returns the targets of a trim to hover: the upward force must equal the weight, and all torques must be
/// zero. Returns `None` if the mass is not set, or if the weight is too large.
pub fn targets(body: &MassProperties) -> Option<Vec<Target>> {
    let weight = body.mass * body.gravity;
    let torques = (3..6).map(|component| Target { component, value: 0.0 });
    let lift = Target { component: 2, value: weight / WRENCH_TO_SI[2] };
    weight.is_finite().then(|| core::iter::once(lift).chain(torques).collect())
}

/// Returns the reason why a body has no weight to which flap can trim.
pub fn no_weight(body: &MassProperties) -> HoverError {
    if body.mass.is_nan() {
        return HoverError::Missing(vec!["total_mass"]);
    }
    HoverError::Impossible(format!("total_mass is {:e} kg: the weight is not finite", body.mass))
}

/// Searches values of the inputs at which the vehicle hovers, beginning at `values`. Returns the control
/// effectiveness at hover. Inputs without effect are left out and keep their values.
///
/// # Errors
/// Returns an error if the mass is not set, if the mass properties are impossible, or if the search finds no
/// hover. A velocity or rate of the body that is not zero is also an error. The moments of inertia need not
/// be set.
pub fn trim(
    vehicle_run: &VehicleRun<'_>,
    values: &[f64],
    inputs: &[Input],
) -> Result<Effectiveness, HoverError> {
    let body = vehicle_run.vehicle.mass_properties(values);
    let targets = targets(&body).ok_or_else(|| no_weight(&body))?;
    if body.inertia.iter().all(|moment| !moment.is_nan()) {
        check(&body)?;
    }
    at_rest(vehicle_run.vehicle, values)?;
    let found = vehicle_run.effectiveness(values, inputs, None)?.without_idle(vehicle_run, values);
    match trim::to_targets(vehicle_run, values, &found.inputs, &targets) {
        Ok(found) => Ok(found.at),
        Err(error @ (ControlError::FewInputs { .. } | ControlError::NotReached(_))) => {
            Err(HoverError::Trim(error))
        }
        Err(error) => Err(error.into()),
    }
}

/// The linear model x' = A x + B s of small deviations x from hover, with the input changes s. The outputs
/// are the states x.
#[derive(Clone, Debug, PartialEq)]
pub struct HoverModel {
    /// Mass properties of the vehicle.
    pub body: MassProperties,
    /// The damping matrix: derivatives of force and torque (rows) with respect to velocity and rates of the
    /// body (columns). The units of the four blocks of the damping matrix are N·s/m, N·s, N·s and N·m·s.
    pub damping: Matrix6<f64>,
    /// The control matrix: derivatives of force (N) and torque (N·m) with respect to the inputs (SI). The
    /// matrix has six rows and one column for each input.
    pub control: DMatrix<f64>,
    /// Mean force (N) and torque (N·m) at the operating point.
    pub wrench: [f64; 6],
    /// State matrix A, with 9 × 9 entries, or 12 × 12 entries if positions are states. [`STATES`] lists the
    /// states.
    pub a: DMatrix<f64>,
    /// Input matrix B, with one column for each input.
    pub b: DMatrix<f64>,
    /// The modes, in descending order of the real part of their eigenvalues.
    pub modes: Vec<HoverMode>,
}

impl HoverModel {
    /// Returns the linear model about an operating point, computed from the damping matrix and the control
    /// matrix.
    ///
    /// The fields of [`HoverModel`] describe the arguments. If `has_position` is true, the states include
    /// positions.
    ///
    /// # Errors
    /// Returns an error if mass properties are missing or impossible, or if the eigenvalues cannot be computed.
    pub fn new(
        body: MassProperties,
        damping: Matrix6<f64>,
        control: DMatrix<f64>,
        wrench: [f64; 6],
        has_position: bool,
    ) -> Result<HoverModel, HoverError> {
        check(&body)?;
        let inverse = inverse_mass(&body)?;
        let states = if has_position { 12 } else { 9 };
        let mut a = DMatrix::zeros(states, states);
        a.view_mut((0, 0), (6, 6)).copy_from(&(inverse * damping));
        // A lowered nose accelerates forward, and a lifted left side accelerates to the right.
        a[(0, 7)] = body.gravity;
        a[(1, 6)] = -body.gravity;
        for i in 0..3 {
            a[(6 + i, 3 + i)] = 1.0;
            if has_position {
                a[(9 + i, i)] = 1.0;
            }
        }
        let mut b = DMatrix::zeros(states, control.ncols());
        b.view_mut((0, 0), (6, control.ncols())).copy_from(&(inverse * &control));
        let modes = modes::modes(&a).ok_or(HoverError::Eigenvalues)?;
        Ok(HoverModel { body, damping, control, wrench, a, b, modes })
    }

    /// Computes the linear model at an operating point. `values` contains the vehicle's parameter values, and
    /// `at` is the control effectiveness at this operating point.
    ///
    /// # Errors
    /// Returns an error if mass properties are missing or impossible, or if a derivative is missing. A
    /// velocity or rate of the body that is not zero is also an error.
    pub fn at(
        vehicle_run: &VehicleRun<'_>,
        values: &[f64],
        at: &Effectiveness,
        has_position: bool,
    ) -> Result<HoverModel, HoverError> {
        let body = body_at_rest(vehicle_run.vehicle, values)?;
        let damping = damping(vehicle_run, values, &at.row.state)?;
        let control = DMatrix::from_fn(6, at.inputs.len(), |i, j| {
            at.matrix[(i, j)] * WRENCH_TO_SI[i] / at.inputs[j].factor
        });
        let wrench = core::array::from_fn(|i| at.wrench[i] * WRENCH_TO_SI[i]);
        HoverModel::new(body, damping, control, wrench, has_position)
    }

    /// Returns the names and units of the states. The outputs have the names and units of the states.
    pub fn states(&self) -> &'static [(&'static str, &'static str)] {
        &STATES[..self.a.nrows()]
    }

    /// Returns all eigenvalues in descending order of the real part. The two eigenvalues of a complex pair
    /// are neighbours in the list.
    pub fn eigenvalues(&self) -> Vec<Complex<f64>> {
        let each = self.modes.iter().flat_map(|mode| {
            let pair = (mode.eigenvalue.im > 0.0).then(|| mode.eigenvalue.conj());
            core::iter::once(mode.eigenvalue).chain(pair)
        });
        each.collect()
    }

    /// Returns the mode with the largest real part of its eigenvalue. Modes of heading and position are left
    /// out, because their eigenvalues are always zero.
    pub fn fastest_growing(&self) -> Option<&HoverMode> {
        self.modes.iter().find(|mode| !mode.is_displacement())
    }

    /// Returns the unbalanced force (N) and torque (N·m) at the operating point: the mean force minus the
    /// weight, and the mean torque.
    pub fn residual(&self) -> [f64; 6] {
        let mut residual = self.wrench;
        residual[2] -= self.body.mass * self.body.gravity;
        residual
    }

    /// Returns the largest unbalanced force (N) and torque (N·m) that is accepted as hover, for each
    /// component.
    pub fn residual_limits(&self) -> [f64; 6] {
        residual_sizes(&self.body).map(|size| TRIM_LIMIT * size)
    }

    /// Returns warnings for the user if the linear model may be inaccurate. `frequency` is the drive
    /// frequency (Hz), and `floquet_max` is the largest magnitude of the Floquet multipliers.
    ///
    /// If `floquet_max` is NaN, flap does not check that the wings settle faster than the body moves.
    pub fn warnings(&self, frequency: f64, floquet_max: f64) -> Vec<String> {
        let limits = self.residual_limits();
        let mut warnings = Vec::new();
        for (i, residual) in self.residual().into_iter().enumerate() {
            if residual.abs() > limits[i] {
                let of = if i < 3 { "the weight" } else { "the weight times 1 mm" };
                warnings.push(format!(
                    "the point is no hover: the residual of {} is {residual:.3e} {}, more than 1 % of {of}",
                    component(i),
                    WRENCH_UNITS[i]
                ));
            }
        }
        let [fast, slow] = [0.5 * frequency, -frequency * floquet_max.ln() / 3.0];
        for mode in &self.modes {
            let (name, size) = (mode.name(), mode.eigenvalue.norm());
            if size > fast {
                warnings.push(format!(
                    "the mode \"{name}\" is fast: |eigenvalue| = {size:.4} 1/s exceeds half the drive frequency, \
                     {fast:.4} 1/s, so quasi-static wings are doubtful"
                ));
            }
            if size > slow {
                warnings.push(format!(
                    "the wings settle slowly for the mode \"{name}\": |eigenvalue| = {size:.4} 1/s exceeds a third of \
                     the wings' decay rate, {slow:.4} 1/s, so quasi-static wings are doubtful"
                ));
            }
        }
        warnings
    }
}

/// Returns the name of a force or torque component without its unit, such as `force_up`.
pub fn component(i: usize) -> &'static str {
    COMPONENTS[i].rsplit_once('_').map_or(COMPONENTS[i], |(name, _)| name)
}

/// Returns the inertia matrix of the body (kg·m²).
pub(super) fn inertia(body: &MassProperties) -> Matrix3<f64> {
    let mut inertia = Matrix3::from_diagonal(&body.inertia.into());
    (inertia[(0, 2)], inertia[(2, 0)]) = (-body.product, -body.product);
    inertia
}

/// Returns the inverse of the 6 × 6 matrix that contains the mass and the inertia matrix of the body.
pub(super) fn inverse_mass(body: &MassProperties) -> Result<Matrix6<f64>, HoverError> {
    let of_inertia = inertia(body).try_inverse();
    let of_inertia = of_inertia.ok_or_else(|| HoverError::Impossible(NOT_POSITIVE.to_owned()))?;
    let mut inverse = Matrix6::from_diagonal(&Vector6::repeat(1.0 / body.mass));
    inverse.fixed_view_mut::<3, 3>(3, 3).copy_from(&of_inertia);
    Ok(inverse)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::*;

    /// Mass properties of a body of 100 mg.
    const BODY: MassProperties =
        MassProperties { mass: 1e-4, inertia: [2e-9, 3e-9, 4e-9], product: 0.0, gravity: 10.0 };

    /// Mean force (N) and torque (N·m) at which the body hovers.
    const HOVER: [f64; 6] = [0.0, 0.0, 1e-3, 0.0, 0.0, 0.0];

    fn model(damping: &Matrix6<f64>) -> HoverModel {
        HoverModel::new(BODY, *damping, DMatrix::zeros(6, 0), HOVER, false).expect("a model")
    }

    /// Returns a damping matrix with the given entries (row, column, value).
    fn damping(entries: &[(usize, usize, f64)]) -> Matrix6<f64> {
        let mut damping = Matrix6::zeros();
        for &(i, j, value) in entries {
            damping[(i, j)] = value;
        }
        damping
    }

    #[test]
    fn gravity_pulls_towards_the_lowered_side() {
        let model = model(&Matrix6::zeros());
        // The nose is lowered, and the left side is lifted.
        assert_eq!((model.a[(0, 7)], model.a[(1, 6)]), (10.0, -10.0));
        assert_eq!((model.a[(6, 3)], model.a[(7, 4)], model.a[(8, 5)]), (1.0, 1.0, 1.0));
        assert_eq!(model.a.iter().filter(|entry| **entry != 0.0).count(), 5);
    }

    #[test]
    fn forces_and_torques_become_accelerations() {
        let control = DMatrix::from_fn(6, 1, |i, _| [1e-4, 0.0, 3e-4, 2e-9, 6e-9, 4e-9][i]);
        let tilted = MassProperties { product: 1e-9, ..BODY };
        let model = HoverModel::new(tilted, Matrix6::zeros(), control, HOVER, true).expect("a model");
        // I_B = [2 0 −1; 0 3 0; −1 0 4] × 1e-9, so its inverse has the determinant 7 in the plane of x and z.
        let expected = [1.0, 0.0, 3.0, (4.0 * 2.0 + 4.0) / 7.0, 2.0, (2.0 + 2.0 * 4.0) / 7.0];
        for (i, expected) in expected.into_iter().enumerate() {
            assert!((model.b[(i, 0)] - expected).abs() < 1e-12, "{i}: {}", model.b[(i, 0)]);
        }
        assert_eq!(model.b.shape(), (12, 1));
        assert_eq!((model.a[(9, 0)], model.a[(10, 1)], model.a[(11, 2)]), (1.0, 1.0, 1.0));
    }

    #[test]
    fn times_and_names_of_uncoupled_motions() {
        // Vertical motion decays at 2 1/s, and yaw at 5 1/s. Other motions have no damping.
        let model = model(&damping(&[(2, 2, -2e-4), (5, 5, -2e-8)]));
        let found: Vec<(f64, String)> =
            model.modes.iter().map(|mode| (mode.eigenvalue.re, mode.name())).collect();
        assert_eq!(found.len(), 9);
        assert!(
            found[..7].iter().all(|(real, name)| *real == 0.0 && name.ends_with("(neutral)")),
            "{found:?}"
        );
        assert_eq!(found[7].1, "vertical velocity (longitudinal subsidence)");
        assert_eq!(found[8].1, "yaw (lateral subsidence)");
        let half = model.modes[7].time_to_half().expect("it decays");
        assert!((half - 0.346_573_590_279_972_6).abs() < 1e-12, "{half}");
        assert_eq!((model.modes[7].time_to_double(), model.modes[7].period()), (None, None));
    }

    #[test]
    fn a_torque_against_velocity_makes_an_oscillation_grow() {
        // λ³ = g M_u / I_y = −10 · 2.4e-6 / 3e-9 = −8000: one real root −20, and 10 ± 17.32 i.
        let model = model(&damping(&[(4, 0, -2.4e-6)]));
        let first = &model.modes[0];
        assert!((first.eigenvalue - Complex::new(10.0, 300.0_f64.sqrt())).norm() < 1e-9, "{first:?}");
        assert_eq!(first.name(), "pitch and forward velocity (longitudinal oscillation)");
        // Each of the three states has a third.
        for state in [0, 4, 7] {
            assert!((first.participation[state] - 1.0 / 3.0).abs() < 1e-9, "{first:?}");
        }
        assert!((first.time_to_double().expect("it grows") - 0.069_314_718_055_994_53).abs() < 1e-12);
        assert!((first.period().expect("it oscillates") - TAU / 300.0_f64.sqrt()).abs() < 1e-9);
        let last = model.modes.last().expect("modes");
        assert!((last.eigenvalue.re + 20.0).abs() < 1e-9);
        assert_eq!(last.name(), "pitch and forward velocity (longitudinal subsidence)");
        assert_eq!(model.eigenvalues().len(), 9);
        assert_eq!(model.eigenvalues()[1], model.eigenvalues()[0].conj());
    }

    #[test]
    fn a_torque_along_velocity_makes_a_motion_diverge() {
        let model = model(&damping(&[(3, 1, -1.6e-6)]));
        // λ³ = −g L_v / I_x = 10 · 1.6e-6 / 2e-9 = 8000.
        assert!((model.modes[0].eigenvalue.re - 20.0).abs() < 1e-9);
        assert_eq!(model.modes[0].name(), "roll and sideways velocity (lateral divergence)");
    }

    #[test]
    fn the_fastest_growing_mode_can_decay() {
        let decays =
            [(0, 0, -4e-4), (1, 1, -6e-4), (2, 2, -7e-4), (3, 3, -1e-8), (4, 4, -9e-9), (5, 5, -3.2e-8)];
        let restoring = [(4, 0, -1.3125e-9), (3, 1, 4e-9)];
        let model = model(&damping(&[&decays[..], &restoring].concat()));
        // λ (λ + 4) (λ + 3) − g M_u / I_y = λ³ + 7 λ² + 12 λ + 4.375 has the roots −0.5, −1.90 and −4.60.
        // λ (λ + 6) (λ + 5) + g L_v / I_x = λ³ + 11 λ² + 30 λ + 20 has the roots −1, −2.76 and −7.24.
        let fastest = model.fastest_growing().expect("a mode");
        assert!((fastest.eigenvalue - Complex::new(-0.5, 0.0)).norm() < 1e-9, "{fastest:?}");
        // The heading has the eigenvalue zero.
        assert_eq!(model.modes[0].eigenvalue.re, 0.0);
        assert!((model.modes[2].eigenvalue.re + 1.0).abs() < 1e-9, "{:?}", model.modes[2]);
    }

    #[test]
    fn the_residual_refers_to_the_weight_and_a_lever_of_1_mm() {
        // The weight is 1e-3 N.
        for (wrench, expected) in [
            (HOVER, 0.0),
            ([0.0, 2e-5, 1e-3, 0.0, 0.0, 0.0], 0.02),
            ([0.0, 0.0, 1e-3, 0.0, 3e-8, 0.0], 0.03),
            ([-1e-5, 0.0, 0.96e-3, 0.0, 0.0, -2e-8], 0.04),
        ] {
            let found = residual_share(&BODY, &wrench);
            assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
        }
    }

    #[test]
    fn missing_and_impossible_mass_properties() {
        let of = |body: MassProperties| check(&body).map_err(|error| error.to_string());
        let unset = MassProperties { mass: f64::NAN, inertia: [2e-9, 3e-9, f64::NAN], ..BODY };
        assert_eq!(
            of(unset),
            Err("the hover model requires total_mass, body_inertia_yaw: set them".to_owned())
        );
        let with = |inertia| of(MassProperties { inertia, ..BODY });
        let positive = "the inertia of the body is not positive definite";
        assert!(of(MassProperties { product: 3e-9, ..BODY }).unwrap_err().starts_with(positive));
        assert!(with([-2e-9, 3e-9, 4e-9]).unwrap_err().starts_with(positive));
        let message = with([2e-9, 3e-9, 6e-9]).unwrap_err();
        assert!(message.contains("moments of inertia 6.0000e-9, 3.0000e-9 and 2.0000e-9 kg"), "{message}");
        assert_eq!(with([2e-9, 3e-9, 5e-9]), Ok(()));
        let message = of(MassProperties { mass: 0.0, ..BODY }).unwrap_err();
        assert_eq!(message, "total_mass is 0 kg, but must be positive");
        let damping = Matrix6::from_element(f64::NAN);
        let failed = HoverModel::new(BODY, damping, DMatrix::zeros(6, 0), HOVER, false);
        assert_eq!(failed, Err(HoverError::Eigenvalues));
    }

    #[test]
    fn warnings_begin_at_their_limits() {
        let model = model(&damping(&[(2, 2, -5e-3), (5, 5, -2e-8)]));
        // The fastest mode has 50 1/s, and exp(−1.5) per period is a decay of 0.5 f per second.
        let multiplier = (-1.5_f64).exp();
        assert!(model.warnings(100.1, multiplier).is_empty());
        assert_eq!(
            model.warnings(99.9, 1e-3),
            [
                "the mode \"vertical velocity (longitudinal subsidence)\" is fast: |eigenvalue| = 50.0000 1/s exceeds half \
                 the drive frequency, 49.9500 1/s, so quasi-static wings are doubtful"
            ]
        );
        assert_eq!(
            model.warnings(120.0, (-1.2_f64).exp()),
            [
                "the wings settle slowly for the mode \"vertical velocity (longitudinal subsidence)\": |eigenvalue| = 50.0000 \
                 1/s exceeds a third of the wings' decay rate, 48.0000 1/s, so quasi-static wings are doubtful"
            ]
        );
        assert!(model.warnings(120.0, f64::NAN).is_empty());

        let of = |wrench| {
            let model = HoverModel { wrench, ..model.clone() };
            model.warnings(120.0, multiplier)
        };
        assert!(of([0.0, 0.0, 1.009e-3, 0.0, 0.0, 0.0]).is_empty());
        assert!(of([0.0, 0.0, 1e-3, 0.0, -0.99e-8, 0.0]).is_empty());
        assert_eq!(
            of([0.0, 0.0, 0.98e-3, 0.0, 1.1e-8, 0.0]),
            [
                "the point is no hover: the residual of force_up is -2.000e-5 N, more than 1 % of the weight",
                "the point is no hover: the residual of torque_pitch is 1.100e-8 N*m, more than 1 % of the weight times 1 mm",
            ]
        );
    }
}
