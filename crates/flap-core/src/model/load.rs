//! The load of the air on a wing: aerodynamic force and moment at the shoulder of the wing.

use crate::aero::NormalLoad;
use crate::num::Real;

/// Aerodynamic force and moment on a wing at one instant, as components along axes that move with the wing.
///
/// The shoulder of a wing is the intersection of its span axis and its stroke axis. All moments are moments
/// about the shoulder.
#[derive(Clone, Copy, Debug)]
pub struct Load<R> {
    /// Stroke angle (rad).
    pub stroke: R,
    /// Force along the stroke axis (N), positive upwards: ∫ dL.
    pub lift: R,
    /// Force in the stroke plane, perpendicular to the span (N): ∫ dD. A positive force acts in the direction
    /// in which the stroke angle decreases.
    pub drag: R,
    /// Moment of the lift (N·m): ∫ r dL, with the distance r from the stroke axis along the span.
    pub lift_moment: R,
    /// Moment of the drag about the stroke axis (N·m): ∫ r dD.
    pub drag_moment: R,
    /// Moment about the span axis (N·m). A positive moment moves the trailing edge in the direction in which
    /// the stroke angle decreases.
    pub span_moment: R,
}

impl<R: Real> Load<R> {
    /// Returns a load whose components are all NaN, with the number type of `number`.
    pub(crate) fn unknown(number: R) -> Load<R> {
        let unknown = number.lit(f64::NAN);
        Load {
            stroke: unknown,
            lift: unknown,
            drag: unknown,
            lift_moment: unknown,
            drag_moment: unknown,
            span_moment: unknown,
        }
    }

    /// Returns the sum of this load and the load `normal` along the wing's normal. The last argument contains
    /// the sine and the cosine of the pitch.
    #[inline(always)]
    #[must_use]
    pub fn with_normal(&self, normal: &NormalLoad<R>, [sin, cos]: [R; 2]) -> Load<R> {
        Load {
            stroke: self.stroke,
            lift: self.lift - normal.force * sin,
            drag: self.drag - normal.force * cos,
            lift_moment: self.lift_moment - normal.chord_moment * sin,
            drag_moment: self.drag_moment - normal.chord_moment * cos,
            span_moment: self.span_moment + normal.span_moment,
        }
    }

    /// Returns the force (N) and the moment (N·m) at the shoulder, in axes x, y and z that do not move with the wing.
    ///
    /// At zero stroke, the wing moves along the x axis when the stroke increases. The y axis points along the
    /// span at zero stroke. The z axis points upwards along the stroke axis. For a left wing, the axes form a
    /// right-handed system.
    ///
    /// ```text
    /// span e_s = (sin φ, cos φ, 0)     motion e_t = (cos φ, −sin φ, 0)
    /// F = L e_z − D e_t     M = M_L e_t + M_D e_z + M_s e_s
    /// ```
    #[inline(always)]
    pub fn at_shoulder(&self) -> [R; 6] {
        let (sin, cos) = self.stroke.sin_cos();
        [
            -(self.drag * cos),
            self.drag * sin,
            self.lift,
            self.lift_moment * cos + self.span_moment * sin,
            self.span_moment * cos - self.lift_moment * sin,
            self.drag_moment,
        ]
    }
}
