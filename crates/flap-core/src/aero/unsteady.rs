//! Forces along the wing's normal from added mass, rotational circulation and rotational drag.
//!
//! The normal is (cos ψ e_t − sin ψ e_z), with the axes of [`crate::body`]. The forces of a section depend only on
//! powers of chord and radius, so integrals over the wing replace sums over strips.

use core::f64::consts::{FRAC_PI_4, PI};

use crate::body::Sections;
use crate::num::Real;

/// Force along the normal of the wing, and the moments of this force.
#[derive(Clone, Copy, Debug)]
pub struct NormalLoad<R> {
    /// Force F (N).
    pub force: R,
    /// Moment about the chord's axis ∫ r dF (N·m).
    pub chord_moment: R,
    /// Moment about the span axis (N·m): minus the integral of dF times the distance behind the pitch axis.
    pub span_moment: R,
}

impl<R: Real> NormalLoad<R> {
    /// Returns the sum of two loads.
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
    /// Added mass of the sections of a wing, each π/4 ρc² Δr at the mid-chord (Sedov 1965).
    pub struct AddedMass<R> {
        /// f₀ = π/4 ρ ∫ c² dr (kg).
        pub f0: R,
        /// f₁ = π/4 ρ ∫ r c² dr (kg·m).
        pub f1: R,
        /// f₂ = π/4 ρ ∫ d c² dr (kg·m), with the distance d of the mid-chord behind the pitch axis.
        pub f2: R,
        /// a₁₁ = π/4 ρ ∫ r² c² dr (kg·m²).
        pub a11: R,
        /// a₁₂ = π/4 ρ ∫ r d c² dr (kg·m²).
        pub a12: R,
        /// a₂₂ = π/4 ρ ∫ d² c² dr, with or without π/128 ρ ∫ c⁴ dr of the rotation about the mid-chord (kg·m²).
        pub a22: R,
    }
}

impl AddedMass<f64> {
    /// No added mass.
    pub const NONE: AddedMass<f64> = AddedMass { f0: 0.0, f1: 0.0, f2: 0.0, a11: 0.0, a12: 0.0, a22: 0.0 };

    /// Returns the added mass in air of the given `density` (kg/m³), including the rotation about the mid-chord. The
    /// pitch axis is `axis` chords behind the leading edge.
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
    /// Returns the load of the added mass, given the normal acceleration r e₁ + e₀ − d e₂ of the sections.
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
    /// Rotational circulation κ c² ω of the sections of a wing, with κ = π (3/4 − x₀) times a factor (Kramer 1932; Sane and
    /// Dickinson 2002). The pitch axis is x₀ chords behind the leading edge.
    ///
    /// The force of the circulation, ρ u_C κ c² ω Δr, acts at a quarter of the chord. u_C is the velocity along the
    /// chord, as in potential flow. Sane and Dickinson multiply by the speed instead of u_C. At small attack angles,
    /// the speed equals u_C.
    pub struct Circulation<R> {
        /// Factors κρ ∫ c² r^m dr of the force, for m from 0 to 2 (kg/m, kg, kg·m).
        pub force: [R; 3],
        /// Factors κρ (1/4 − x₀) ∫ c³ r^m dr of the moment, for m from 0 to 1 (kg, kg·m).
        pub moment: [R; 2],
    }
}

impl Circulation<f64> {
    /// No rotational circulation.
    pub const NONE: Circulation<f64> = Circulation { force: [0.0; 3], moment: [0.0; 2] };

    /// Returns the circulation times `factor`, in air of the given `density` (kg/m³). The pitch axis is `axis` chords
    /// behind the leading edge.
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
    /// Returns the load of the circulation at a pitch rate ω relative to still air (rad/s).
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
    /// Normal force that the rotational drag exerts on the sections of a wing, without a moment about the span axis.
    pub struct RotationalForce<R> {
        /// Factor ½Cρ I ∫ c³ dr of the force (kg·m). I is the integral of z|z| over a chord of 1, with the distance z
        /// behind the pitch axis.
        pub force: R,
        /// Factor ½Cρ I ∫ r c³ dr of the moment about the chord's axis (kg·m²).
        pub moment: R,
    }
}

impl RotationalForce<f64> {
    /// No force of the rotational drag.
    pub const NONE: RotationalForce<f64> = RotationalForce { force: 0.0, moment: 0.0 };

    /// Returns the force for a drag coefficient, in air of the given density (kg/m³). The pitch axis is `axis` chords
    /// behind the leading edge.
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
    /// Returns the load of the rotational drag at a pitch rate ω relative to still air (rad/s). The load is
    /// proportional to ω|ω|.
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
