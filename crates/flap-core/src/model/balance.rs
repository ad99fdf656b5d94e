//! Equations of motion of stroke and pitch, coupled by a mass matrix: solved for both, or for the pitch alone.

use crate::drive::Driven;
use crate::num::Real;

/// Mass matrix and generalised forces at a state `[stroke, pitch, stroke rate, pitch rate]`, without the drive.
///
/// ```text
/// ⎡M₁₁ M₁₂⎤ ⎡stroke acceleration⎤ = ⎡Q₁ + drive moment⎤
/// ⎣M₁₂ M₂₂⎦ ⎣pitch acceleration ⎦   ⎣Q₂               ⎦
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Balance<R> {
    /// M₁₁, M₁₂, M₂₂ (kg·m²).
    pub mass: [R; 3],
    /// Q₁: moment about the stroke axis (N·m).
    pub stroke_moment: R,
    /// Q₂: moment about the pitch axis (N·m).
    pub pitch_moment: R,
}

impl<R: Real> Balance<R> {
    /// The derivative of the state `y` under a moment of the drive about the stroke axis (N·m).
    #[inline(always)]
    pub fn driven(&self, y: &[R; 4], drive_moment: R) -> [R; 4] {
        let [m11, m12, m22] = self.mass;
        let (q1, q2) = (self.stroke_moment + drive_moment, self.pitch_moment);
        let inverse_determinant = q1.lit(1.0) / (m11 * m22 - m12 * m12);
        let stroke = (m22 * q1 - m12 * q2) * inverse_determinant;
        let pitch = (m11 * q2 - m12 * q1) * inverse_determinant;
        [y[2], y[3], stroke, pitch]
    }

    /// The derivative of the state `y` where the stroke is prescribed: pitch from the second equation.
    ///
    /// The stroke's own states follow it; what they have strayed from it by integration errors is forgotten at the
    /// rate `forgetting` (1/s), so that it cannot add up.
    #[inline(always)]
    pub fn prescribed(&self, y: &[R; 4], stroke: &Driven<R>, forgetting: R) -> [R; 4] {
        let [_, m12, m22] = self.mass;
        [
            (stroke.value - y[0]).mul_add(forgetting, stroke.rate),
            y[3],
            (stroke.rate - y[2]).mul_add(forgetting, stroke.bend),
            (self.pitch_moment - m12 * stroke.bend) / m22,
        ]
    }
}

/// The state `y` with the prescribed stroke in place of its own.
#[inline(always)]
pub fn on_stroke<R: Real>(stroke: &Driven<R>, y: &[R; 4]) -> [R; 4] {
    [stroke.value, y[1], stroke.rate, y[3]]
}

/// The derivative `dy` of a state with a prescribed stroke in place of its own.
#[inline(always)]
pub fn on_stroke_rates<R: Real>(stroke: &Driven<R>, dy: &[R; 4]) -> [R; 4] {
    [stroke.rate, dy[1], stroke.bend, dy[3]]
}
