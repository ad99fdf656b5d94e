//! Functions for models with the states `[stroke, pitch, stroke rate, pitch rate]`, in which the stroke can
//! be prescribed.
//!
//! A mass matrix couples stroke and pitch. If the stroke is free, the equations of motion determine the
//! accelerations of stroke and pitch. If the stroke is prescribed, the equations of motion determine only the
//! acceleration of the pitch.

use super::experiment::Imposed;
use crate::drive::{Drive, DriveConstants, Wave};
use crate::num::Real;
use crate::ode::Start;
use crate::parameter::Invalid;

/// Names of the columns in trajectories that contain the states.
pub const NAMES: [&str; 4] = ["stroke_rad", "pitch_rad", "stroke_rate_rad_s", "pitch_rate_rad_s"];

/// Mass matrix and generalised forces at a state `[stroke, pitch, stroke rate, pitch rate]`, without the moment of the
/// drive.
///
/// ```text
/// ⎡M₁₁ M₁₂⎤ ⎡stroke acceleration⎤ = ⎡Q₁ + drive moment⎤
/// ⎣M₁₂ M₂₂⎦ ⎣pitch acceleration ⎦   ⎣Q₂               ⎦
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Balance<R> {
    /// Entries M₁₁, M₁₂ and M₂₂ of the mass matrix (kg·m²).
    pub mass: [R; 3],
    /// Generalised force Q₁: the moment about the stroke axis (N·m).
    pub stroke_moment: R,
    /// Generalised force Q₂: the moment about the pitch axis (N·m).
    pub pitch_moment: R,
}

impl<R: Real> Balance<R> {
    /// Returns the time derivative of the state `y` if the drive exerts the torque `drive_moment` (N·m) about
    /// the stroke axis.
    #[inline(always)]
    pub fn driven(&self, y: &[R; 4], drive_moment: R) -> [R; 4] {
        let [m11, m12, m22] = self.mass;
        let (q1, q2) = (self.stroke_moment + drive_moment, self.pitch_moment);
        let inverse_determinant = q1.lit(1.0) / (m11 * m22 - m12 * m12);
        let stroke = (m22 * q1 - m12 * q2) * inverse_determinant;
        let pitch = (m11 * q2 - m12 * q1) * inverse_determinant;
        [y[2], y[3], stroke, pitch]
    }

    /// Returns the time derivative of the state `y` if the stroke is prescribed. The pitch acceleration is
    /// computed from the second equation of motion.
    ///
    /// The state `y` also contains the stroke and the stroke rate. The integration keeps the stroke and the
    /// stroke rate in `y` close to the prescribed values. Integration errors in the stroke and the stroke
    /// rate decay at the rate `forgetting` (1/s), so the errors do not accumulate.
    #[inline(always)]
    pub fn prescribed(&self, y: &[R; 4], stroke: &Wave<R>, forgetting: R) -> [R; 4] {
        let [_, m12, m22] = self.mass;
        [
            (stroke.value - y[0]).mul_add(forgetting, stroke.rate),
            y[3],
            (stroke.rate - y[2]).mul_add(forgetting, stroke.bend),
            (self.pitch_moment - m12 * stroke.bend) / m22,
        ]
    }
}

/// Returns the state `y`. If the stroke is prescribed, the prescribed stroke and its rate replace the stroke
/// and its rate in `y`.
#[inline(always)]
pub fn state<R: Real>(drive: &Drive, wave: &Wave<R>, y: &[R; 4]) -> [R; 4] {
    if drive.prescribes_stroke() { [wave.value, y[1], wave.rate, y[3]] } else { *y }
}

/// Returns the time derivative `dy` of a state. If the stroke is prescribed, the derivatives of the
/// prescribed stroke replace the derivatives of the stroke and its rate in `dy`.
#[inline(always)]
pub fn slope<R: Real>(drive: &Drive, wave: &Wave<R>, dy: &[R; 4]) -> [R; 4] {
    if drive.prescribes_stroke() { [wave.rate, dy[1], wave.bend, dy[3]] } else { *dy }
}

/// Returns the result of [`Model::start`](super::Model::start) for a simulation that starts from rest.
///
/// If the stroke is prescribed, the initial stroke is the prescribed stroke at time zero. `sizes` contains
/// the typical sizes of stroke and pitch (rad).
pub fn start<C>(
    drive: &Drive,
    drive_constants: &DriveConstants<f64>,
    constants: C,
    sizes: [f64; 2],
) -> Start<C, 4> {
    let [stroke, pitch] = sizes;
    let rate = drive_constants.rate;
    let y = state(drive, &drive.at(drive_constants, 0.0), &[0.0; 4]);
    Start::new(constants, y, drive_constants.period(), [stroke, pitch, stroke * rate, pitch * rate])
}

/// Returns the state, the derivative of the state and the drive of a wing with imposed stroke and pitch, for
/// an implementation of [`ExperimentModel::placed`](super::ExperimentModel::placed).
///
/// `stroke` and `pitch` contain an angle (rad) and its first and second time derivatives (rad/s, rad/s²).
pub fn placed(stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<Wave<f64>, 4> {
    ([stroke[0], pitch[0], stroke[1], pitch[1]], [stroke[1], pitch[1], stroke[2], pitch[2]], stroke.into())
}

/// Returns an error that reports a mass matrix that is not positive definite.
///
/// The argument contains four names of parameters. The error message states that the first two parameters
/// contradict the last two parameters.
pub(crate) fn inertias_apart([a, b, c, d]: &[&str; 4]) -> Invalid {
    Invalid::new(format!(
        "the mass matrix is not positive definite: the wing's inertias contradict each other ({a} and {b} against {c} and \
         {d})"
    ))
}

/// Returns the state immediately after an impulse that gives a wing at rest the stroke rate `stroke_rate`
/// (rad/s), for [`ExperimentModel::struck`](super::ExperimentModel::struck).
///
/// With the mass matrix [M₁₁, M₁₂, M₂₂] (kg·m²), the impulse also causes the pitch rate `−(M₁₂/M₂₂) stroke rate`.
pub fn struck([_, m12, m22]: [f64; 3], stroke_rate: f64) -> [f64; 4] {
    [0.0, 0.0, stroke_rate, -(m12 / m22) * stroke_rate]
}
