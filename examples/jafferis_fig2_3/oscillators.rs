//! The equations of the three oscillators of Fig. 2, for flap's integrator.
//!
//! Stroke x and pitch ψ are in radians. The unit of time is 1/ω₀, where ω₀ is the undamped resonance. A force
//! F sin ωt drives each oscillator.

use flap_core::num::Real;
use flap_core::ode::Ode;

use super::coefficients::FIG_3;

// What a run keeps fixed. The macro makes a struct of numbers `R`: scalars, or one number per SIMD lane.
flap_core::per_lane! {
    /// The drive and the damping of an oscillator.
    pub struct Drive<R> {
        /// Amplitude F of the force.
        pub force: R,
        /// Frequency ω divided by the undamped resonance.
        pub frequency: R,
        /// Damping coefficient of the stroke.
        pub damping: R,
    }
}

/// An oscillator with `N` states.
pub(crate) trait Oscillator<const N: usize>: Sync {
    /// Returns the time derivatives of the states at a given force.
    fn rates<R: Real>(&self, c: &Drive<R>, force: R, y: &[R; N]) -> [R; N];
}

/// The differential equations of an oscillator that is driven by a sinusoidal force.
pub(crate) struct Forced<O>(pub(crate) O);

impl<O: Oscillator<N>, const N: usize> Ode<N> for Forced<O> {
    type Constants<R: Real> = Drive<R>;
    type Input<R: Real> = R;

    /// Returns the force at time `t`. Only the time determines the force, so the force is computed separately
    /// from the rates of the states.
    #[inline(always)]
    fn input<R: Real>(&self, c: &Drive<R>, t: R) -> R {
        c.force * (c.frequency * t).sin()
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &Drive<R>, force: &R, _side: R, y: &[R; N]) -> [R; N] {
        self.0.rates(c, *force, y)
    }
}

/// Oscillator (i): the damping is proportional to the speed.
///
/// ```text
/// ẍ + x + d ẋ = F sin ωt
/// ```
pub(crate) struct Linear;

impl Oscillator<2> for Linear {
    #[inline(always)]
    fn rates<R: Real>(&self, c: &Drive<R>, force: R, y: &[R; 2]) -> [R; 2] {
        let [x, x_dot] = *y;
        [x_dot, force - x - c.damping * x_dot]
    }
}

/// Oscillator (ii): the damping is the drag of a wing whose pitch is constant.
///
/// ```text
/// ẍ + x + d C_D |ẋ|ẋ = F sin ωt
/// ```
pub(crate) struct HeldWing {
    /// Drag coefficient C_D.
    pub(crate) drag: f64,
}

impl HeldWing {
    /// Returns a wing with the constant pitch `degrees`.
    pub(crate) fn at(degrees: f64) -> HeldWing {
        HeldWing { drag: FIG_3.drag((2.0 * degrees).to_radians().cos()) }
    }
}

impl Oscillator<2> for HeldWing {
    #[inline(always)]
    fn rates<R: Real>(&self, c: &Drive<R>, force: R, y: &[R; 2]) -> [R; 2] {
        let [x, x_dot] = *y;
        [x_dot, force - x - c.damping * self.drag * x_dot.abs() * x_dot]
    }
}

/// Oscillator (iii): the damping is the drag of a wing that rotates about its hinge, as in Eqs. (1) and (2).
///
/// ```text
/// ẍ + x + d C_D(ψ) |ẋ|ẋ = F sin ωt
/// ψ̈ + k ψ + c |ψ̇|ψ̇ = m (C_D cos ψ + C_L sin ψ) |ẋ|ẋ + j ẍ cos ψ + ½ ẋ² sin 2ψ
/// ```
pub(crate) struct TurningWing {
    /// Stiffness k of the hinge divided by the wing's inertia.
    pub(crate) stiffness: f64,
    /// Damping coefficient c of the hinge.
    pub(crate) damping: f64,
    /// Coefficient m of the aerodynamic moment about the hinge.
    pub(crate) moment: f64,
    /// Coupling inertia j divided by the wing's inertia.
    pub(crate) coupling: f64,
}

/// The wing of Table I: the fields are rounded numbers that are computed from the parameters in the table.
pub(crate) const TABLE_I: TurningWing =
    TurningWing { stiffness: 2.15, damping: 0.32, moment: 1.1, coupling: 0.66 };

/// The damping coefficient of the stroke for a drag coefficient of 1, computed from Table I.
pub(crate) const DAMPING: f64 = 0.67;

impl Oscillator<4> for TurningWing {
    #[inline(always)]
    fn rates<R: Real>(&self, c: &Drive<R>, force: R, y: &[R; 4]) -> [R; 4] {
        let [x, psi, x_dot, psi_dot] = *y;
        let (sin, cos) = psi.sin_cos();
        let pressure = x_dot.abs() * x_dot;
        let drag = FIG_3.drag(cos * cos * 2.0 - 1.0);
        let x_ddot = force - x - c.damping * drag * pressure;
        let psi_ddot = FIG_3.normal(sin, cos) * pressure * self.moment
            + x_ddot * cos * self.coupling
            + x_dot * x_dot * sin * cos
            - psi * self.stiffness
            - psi_dot.abs() * psi_dot * self.damping;
        [x_dot, psi_dot, x_ddot, psi_ddot]
    }
}
