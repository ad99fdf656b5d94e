//! Forces on the strips of a wing in oblique flow: the flow has a component along the stroke axis.

use super::harmonics::Harmonics;
use crate::body::Sections;
use crate::num::Real;

crate::per_lane! {
    /// A strip of a wing in oblique flow.
    pub struct ObliqueStrip<R> {
        /// Factor ½ρcΔr of the forces on the strip (kg/m).
        pub weight: R,
        /// Distance r from the stroke axis to the point at which the velocity of the strip is computed (m).
        pub radius: R,
        /// Lever arm of the forces on the strip about the stroke axis (m).
        pub lever: R,
        /// Chordwise distance d between the pitch axis and the point at which the velocity of the strip is
        /// computed (m). The distance is positive if the point is behind the pitch axis.
        pub behind: R,
        /// Chord c of the strip (m). The position of the centre of pressure is measured in chords.
        pub chord: R,
    }
}

impl ObliqueStrip<f64> {
    /// A strip without area.
    pub(crate) const NONE: ObliqueStrip<f64> =
        ObliqueStrip { weight: 0.0, radius: 0.0, lever: 0.0, behind: 0.0, chord: 0.0 };
}

/// Velocity of a strip relative to still air. One component is along the normal of the wing, and the other
/// component is along the chord, towards the leading edge.
///
/// ```text
/// u_N = u cos ψ − w sin ψ     u_C = u sin ψ + w cos ψ
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Flow<R> {
    /// Component u_N of the strip's velocity along the normal of the wing (m/s).
    pub normal: R,
    /// Component u_C of the strip's velocity along the chord, towards the leading edge (m/s).
    pub chordwise: R,
    /// Speed of the strip U = √(u_N² + u_C²) (m/s).
    pub speed: R,
}

impl<R: Real> Flow<R> {
    /// Returns the velocity of a strip relative to still air, given the motion of the wing's sections. The
    /// last argument contains the sine and the cosine of the wing pitch.
    #[inline(always)]
    pub fn past(sections: &Sections<R>, strip: &ObliqueStrip<R>, [sin, cos]: [R; 2]) -> Flow<R> {
        let ObliqueStrip { radius, behind, .. } = *strip;
        let u = radius * sections.stroke_rate + sections.along - behind * sections.sweep_rate;
        let w = sections.up + radius * sections.tilt_rate;
        Flow { normal: u * cos - w * sin, chordwise: u * sin + w * cos, speed: (u * u + w * w).sqrt() }
    }

    /// Returns 1/U² (s²/m²) for the speed U of the strip, or zero if U is zero.
    #[inline(always)]
    fn inverse_square(&self) -> R {
        let (square, zero, one) = (self.speed * self.speed, self.speed.lit(0.0), self.speed.lit(1.0));
        let flows = zero.lt(square);
        R::select(flows, one / R::select(flows, square, one), zero)
    }

    /// Returns the acute angle between the chord and the velocity of the strip (rad): B = atan2(|u_N|,
    /// |u_C|).
    #[inline(always)]
    pub fn folded_attack(&self) -> R {
        self.normal.abs().angle_over(self.chordwise.abs())
    }

    /// Returns the angle between the velocity of the strip and the direction from the trailing to the leading
    /// edge (rad). The angle is from 0 to π: A = atan2(|u_N|, u_C).
    #[inline(always)]
    pub fn attack(&self) -> R {
        let folded = self.folded_attack();
        let reversed = folded.lit(core::f64::consts::PI) - folded;
        R::select(self.chordwise.lt(folded.lit(0.0)), reversed, folded)
    }

    /// Returns the forces on the strip along the normal and along the chord, divided by ½ρcΔr (m²/s²). The
    /// lift coefficient is C_L = b_L sin 2ψ, and the drag coefficient is C_D = b₁ + b₂ cos 2ψ. Here tan ψ is
    /// u_C/u_N. The argument `harmonics` contains terms that the function adds to C_D and b_L.
    ///
    /// ```text
    /// C_D = b₁ + b₂ (u_N² − u_C²)/U²     F_N = U u_N (C_D + 2 b_L u_C²/U²)     F_C = U u_C (2 b_L u_N²/U² − C_D)
    /// ```
    #[inline(always)]
    pub fn harmonic_forces(&self, [b_1, b_2, b_l]: [R; 3], harmonics: &Harmonics<R>) -> [R; 2] {
        let Flow { normal, chordwise, speed } = *self;
        let inverse = self.inverse_square();
        let (along_normal, along_chord) = (normal * normal * inverse, chordwise * chordwise * inverse);
        let cos_2psi = along_normal - along_chord;
        let c_d = b_1 + b_2 * cos_2psi + harmonics.drag(-cos_2psi);
        let b_l = b_l + harmonics.lift(-cos_2psi);
        [
            speed * normal * (c_d + b_l * along_chord * 2.0),
            speed * chordwise * (b_l * along_normal * 2.0 - c_d),
        ]
    }
}

/// Sums of the forces on all strips of a wing. F_N acts against the direction of the wing's normal, and F_C
/// acts along the chord towards the leading edge.
#[derive(Clone, Copy, Debug)]
pub struct ObliqueForces<R> {
    /// Sum of the normal force F_N, over all strips (N).
    pub normal: R,
    /// Sum of the force F_C along the chord, over all strips (N).
    pub chordwise: R,
    /// Sum of the normal force F_N times the lever arm of F_N about the stroke axis, over all strips (N·m).
    pub normal_moment: R,
    /// Sum of the chordwise force F_C times the lever arm of F_C about the stroke axis, over all strips
    /// (N·m).
    pub chordwise_moment: R,
    /// Sum of the normal force F_N times the distance of the centre of pressure behind the pitch axis, over
    /// all strips (N·m).
    pub pitch_moment: R,
}

impl<R: Real> ObliqueForces<R> {
    /// Returns sums that are all zero, of the same number type as `number`.
    #[inline(always)]
    pub(crate) fn none(number: R) -> ObliqueForces<R> {
        let zero = number.lit(0.0);
        ObliqueForces {
            normal: zero,
            chordwise: zero,
            normal_moment: zero,
            chordwise_moment: zero,
            pitch_moment: zero,
        }
    }

    /// Adds the forces on one strip to the sums. The function `law`, an argument of [`oblique_forces`],
    /// computes the forces on one strip.
    #[inline(always)]
    pub(crate) fn add(&mut self, strip: &ObliqueStrip<R>, ([normal, chordwise], pressure): ([R; 2], R)) {
        let ObliqueStrip { weight, lever, chord, .. } = *strip;
        let (normal, chordwise) = (weight * normal, weight * chordwise);
        self.normal = self.normal + normal;
        self.chordwise = self.chordwise + chordwise;
        self.normal_moment = self.normal_moment + lever * normal;
        self.chordwise_moment = self.chordwise_moment + lever * chordwise;
        self.pitch_moment = self.pitch_moment + chord * pressure * normal;
    }

    /// Returns the lift F_N sin ψ + F_C cos ψ and the drag F_N cos ψ − F_C sin ψ (N).
    #[inline(always)]
    pub fn lift_and_drag(&self, [sin, cos]: [R; 2]) -> [R; 2] {
        [self.normal * sin + self.chordwise * cos, self.normal * cos - self.chordwise * sin]
    }

    /// Returns the moments of lift and drag about the shoulder (N·m).
    #[inline(always)]
    pub fn moments(&self, [sin, cos]: [R; 2]) -> [R; 2] {
        [
            self.normal_moment * sin + self.chordwise_moment * cos,
            self.normal_moment * cos - self.chordwise_moment * sin,
        ]
    }
}

/// Returns the sums of the forces on all strips of a wing. `pitch` contains the sine and the cosine of the
/// wing pitch.
///
/// The function `law` returns the forces on one strip along the normal and along the chord, divided by ½ρcΔr
/// of the strip (m²/s²). `law` also returns the distance of the centre of pressure behind the pitch axis, in
/// chords.
#[inline(always)]
pub fn oblique_forces<R: Real>(
    strips: impl Iterator<Item = ObliqueStrip<R>>,
    sections: &Sections<R>,
    pitch: [R; 2],
    law: impl Fn(&ObliqueStrip<R>, &Flow<R>) -> ([R; 2], R),
) -> ObliqueForces<R> {
    let mut sums = ObliqueForces::none(pitch[0]);
    for strip in strips {
        let flow = Flow::past(sections, &strip, pitch);
        sums.add(&strip, law(&strip, &flow));
    }
    sums
}
