//! Forces along the wing's normal from added mass, rotational circulation and rotational drag.
//!
//! The normal of the wing is cos ψ e_t − sin ψ e_z, with the axes e_t and e_z of [`crate::body::Shoulder`].
//! The force on a section of the wing is a sum of terms that contain powers of the chord and of the radius.
//! Integrals of the powers over the wing therefore replace sums over strips.

use core::f64::consts::{FRAC_PI_4, PI};

use crate::body::Sections;
use crate::num::Real;

/// Force along the normal of the wing, and the moments of this force.
#[derive(Clone, Copy, Debug)]
pub struct NormalLoad<R> {
    /// Force F (N).
    pub force: R,
    /// Moment ∫ r dF of the force about the axis along the chord (N·m), where r is the distance from the
    /// stroke axis.
    pub chord_moment: R,
    /// Moment −∫ d dF of the force about the axis along the span (N·m), where d is the distance behind the
    /// pitch axis.
    pub span_moment: R,
}

impl<R: Real> NormalLoad<R> {
    /// Returns a load with the sum of the forces and the sums of the moments of two loads.
    #[inline(always)]
    #[must_use]
    pub fn plus(&self, other: &NormalLoad<R>) -> NormalLoad<R> {
        NormalLoad {
            force: self.force + other.force,
            chord_moment: self.chord_moment + other.chord_moment,
            span_moment: self.span_moment + other.span_moment,
        }
    }
}

/// Integral ∫ c^n r^m dr over a wing as a function of n and m.
///
/// Here c is the chord, and r is the distance from the stroke axis.
pub type ChordIntegral<'a> = dyn Fn(i32, i32) -> f64 + 'a;

crate::per_lane! {
    /// Added mass of a wing. A section of the width Δr has the added mass π/4 ρc² Δr at the middle of its
    /// chord (Sedov 1965).
    pub struct AddedMass<R> {
        /// Total added mass f₀ = π/4 ρ ∫ c² dr (kg).
        pub f0: R,
        /// First moment of the added mass about the stroke axis, f₁ = π/4 ρ ∫ r c² dr (kg·m).
        pub f1: R,
        /// First moment of the added mass about the pitch axis, f₂ = π/4 ρ ∫ d c² dr (kg·m). d is the
        /// distance of the mid-chord behind the pitch axis.
        pub f2: R,
        /// Added inertia about the stroke axis, a₁₁ = π/4 ρ ∫ r² c² dr (kg·m²).
        pub a11: R,
        /// Product of inertia of the added mass, a₁₂ = π/4 ρ ∫ r d c² dr (kg·m²).
        pub a12: R,
        /// Added inertia about the pitch axis, a₂₂ = π/4 ρ ∫ d² c² dr (kg·m²). Some models add π/128 ρ ∫ c⁴
        /// dr for the rotation about the mid-chord.
        pub a22: R,
    }
}

impl AddedMass<f64> {
    /// No added mass.
    pub const NONE: AddedMass<f64> = AddedMass { f0: 0.0, f1: 0.0, f2: 0.0, a11: 0.0, a12: 0.0, a22: 0.0 };

    /// Returns the added mass in air of the given `density` (kg/m³). The added inertia about the pitch axis
    /// includes the rotation about the mid-chord. The pitch axis lies behind the leading edge at the distance
    /// `axis` times the chord.
    pub fn of(density: f64, axis: f64, integral: &ChordIntegral<'_>) -> AddedMass<f64> {
        let (mass, behind) = (FRAC_PI_4 * density, 0.5 - axis);
        AddedMass {
            f0: mass * integral(2, 0),
            f1: mass * integral(2, 1),
            f2: mass * behind * integral(3, 0),
            a11: mass * integral(2, 2),
            a12: mass * behind * integral(3, 1),
            a22: mass * (behind * behind + 1.0 / 32.0) * integral(4, 0),
        }
    }
}

impl<R: Real> AddedMass<R> {
    /// Returns the force and the moments of the added mass. A section has the normal acceleration r e₁ + e₀ −
    /// d e₂, with the radius r and the distance d behind the pitch axis.
    ///
    /// ```text
    /// F = −(f₁ e₁ + f₀ e₀ − f₂ e₂)     M_c = −(a₁₁ e₁ + f₁ e₀ − a₁₂ e₂)     M_s = a₁₂ e₁ + f₂ e₀ − a₂₂ e₂
    /// ```
    #[inline(always)]
    pub fn load(&self, [e_0, e_1, e_2]: [R; 3]) -> NormalLoad<R> {
        NormalLoad {
            force: self.f2 * e_2 - self.f1 * e_1 - self.f0 * e_0,
            chord_moment: self.a12 * e_2 - self.a11 * e_1 - self.f1 * e_0,
            span_moment: self.a12 * e_1 + self.f2 * e_0 - self.a22 * e_2,
        }
    }
}

crate::per_lane! {
    /// Rotational circulation κ c² ω of the sections of a wing at the pitch rate ω (Kramer 1932; Sane and
    /// Dickinson 2002). κ is π (3/4 − x₀) times a factor, and the pitch axis lies behind the leading edge at
    /// the distance x₀ times the chord.
    ///
    /// The force of the circulation, ρ u_C κ c² ω Δr, acts at a quarter of the chord. As in potential flow,
    /// the force is proportional to u_C, the component of the section's velocity along the chord. The formula
    /// of Sane and Dickinson contains the speed of the section instead of u_C. At small attack angles, the
    /// speed and u_C are almost equal.
    pub struct Circulation<R> {
        /// Factors of the force: κρ ∫ c² r^m dr for m = 0, 1 and 2 (kg/m, kg, kg·m).
        pub force: [R; 3],
        /// Factors of the moment about the span axis: κρ (1/4 − x₀) ∫ c³ r^m dr for m = 0 and 1 (kg, kg·m).
        pub moment: [R; 2],
    }
}

impl Circulation<f64> {
    /// No rotational circulation.
    pub const NONE: Circulation<f64> = Circulation { force: [0.0; 3], moment: [0.0; 2] };

    /// Returns the rotational circulation in air of the given `density` (kg/m³). The theoretical circulation
    /// is multiplied by `factor`. The pitch axis lies behind the leading edge at the distance `axis` times
    /// the chord.
    pub fn of(factor: f64, density: f64, axis: f64, integral: &ChordIntegral<'_>) -> Circulation<f64> {
        if factor == 0.0 {
            return Circulation::NONE;
        }
        let kappa = factor * PI * (0.75 - axis) * density;
        Circulation {
            force: [0, 1, 2].map(|m| kappa * integral(2, m)),
            moment: [0, 1].map(|m| kappa * (0.25 - axis) * integral(3, m)),
        }
    }
}

impl<R: Real> Circulation<R> {
    /// Returns the force and the moments of the rotational circulation, given the pitch rate ω relative to
    /// still air (rad/s).
    ///
    /// ```text
    /// u_C = r P + Q     P = (φ̇ − Ω_z) sin ψ + Ω_t cos ψ     Q = a sin ψ + V_z cos ψ
    /// ```
    #[inline(always)]
    pub fn load(&self, sections: &Sections<R>, pitch_rate: R, [sin, cos]: [R; 2]) -> NormalLoad<R> {
        let p = (sections.stroke_rate * sin + sections.tilt_rate * cos) * pitch_rate;
        let q = (sections.along * sin + sections.up * cos) * pitch_rate;
        let ([k_0, k_1, k_2], [m_0, m_1]) = (self.force, self.moment);
        NormalLoad {
            force: p * k_1 + q * k_0,
            chord_moment: p * k_2 + q * k_1,
            span_moment: -(p * m_1 + q * m_0),
        }
    }
}

crate::per_lane! {
    /// Normal force of the rotational drag on a wing, and the moment of this force about the axis along the
    /// chord. The moment about the axis along the span is not included.
    pub struct RotationalForce<R> {
        /// Factor of the force: ½Cρ I ∫ c³ dr (kg·m), where C is the drag coefficient. The number I is the
        /// integral of z|z| over a chord of length 1, where z is the distance behind the pitch axis.
        pub force: R,
        /// Factor of the moment about the axis along the chord: ½Cρ I ∫ r c³ dr (kg·m²).
        pub moment: R,
    }
}

impl RotationalForce<f64> {
    /// No rotational drag.
    pub const NONE: RotationalForce<f64> = RotationalForce { force: 0.0, moment: 0.0 };

    /// Returns the factors of the rotational drag for a drag `coefficient`, in air of the given `density`
    /// (kg/m³). The pitch axis lies behind the leading edge at the distance `axis` times the chord.
    pub fn of(
        coefficient: f64,
        density: f64,
        axis: f64,
        integral: &ChordIntegral<'_>,
    ) -> RotationalForce<f64> {
        if coefficient == 0.0 {
            return RotationalForce::NONE;
        }
        let cube = |z: f64| z.abs() * z.abs() * z.abs();
        let dynamic = 0.5 * coefficient * density * (cube(1.0 - axis) - cube(axis)) / 3.0;
        RotationalForce { force: dynamic * integral(3, 0), moment: dynamic * integral(3, 1) }
    }
}

impl<R: Real> RotationalForce<R> {
    /// Returns the force and the moments of the rotational drag, given the pitch rate ω relative to still air
    /// (rad/s). The force is proportional to ω|ω|.
    #[inline(always)]
    pub fn load(&self, pitch_rate: R) -> NormalLoad<R> {
        let square = pitch_rate * pitch_rate.abs();
        NormalLoad {
            force: self.force * square,
            chord_moment: self.moment * square,
            span_moment: square.lit(0.0),
        }
    }
}
