//! The bimorph model as a system of differential equations.

use super::constants::Constants;
use super::rhs::{Plate, derivative, plates, secant_stiffness};
use super::transmission::Law;
use crate::drive::{Drive, DriveConstants};
use crate::num::Real;
use crate::ode::Ode;

/// The model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bimorph {
    /// The drive voltage.
    pub drive: Drive,
    /// Law of the transmission ratio.
    pub law: Law,
}

impl Ode<4> for Bimorph {
    type Constants<R: Real> = Constants<R>;
    type Input<R: Real> = [Plate<R>; 2];

    /// The two plates at time `t`, driven in antiphase, (7).
    ///
    /// ```text
    /// V₁ = ½V_pp (1 − sin ωt)     V₂ = ½V_pp (1 + sin ωt)
    /// ```
    ///
    /// A bias between the plates moves them apart.
    #[inline(always)]
    fn input<R: Real>(&self, c: &Constants<R>, t: R) -> [Plate<R>; 2] {
        let DriveConstants { bias, amplitude, .. } = c.drive;
        let wave = self.drive.wave(&c.drive, t);
        let (first, second) = (bias + c.half_offset, bias - c.half_offset);
        plates(c, [wave.scaled(first, -amplitude), wave.scaled(second, amplitude)])
    }

    #[inline(always)]
    fn next_break<R: Real>(&self, c: &Constants<R>, t: R) -> R {
        self.drive.next_break(&c.drive, t)
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &Constants<R>, plates: &[Plate<R>; 2], _side: R, y: &[R; 4]) -> [R; 4] {
        derivative(c, self.law, plates, y)
    }
}

impl Bimorph {
    /// Mean voltages of the two plates (V) over a period.
    #[inline(always)]
    pub(super) fn mean_voltages<R: Real>(&self, c: &Constants<R>) -> [R; 2] {
        let DriveConstants { bias, amplitude, .. } = c.drive;
        let swing = amplitude * self.drive.mean();
        [bias + c.half_offset - swing, bias - c.half_offset + swing]
    }

    /// Natural frequencies (Hz) of small motions without drag: of the stroke and of the hinge.
    ///
    /// (1) contains no reaction of the hinge, so each is that of its own oscillator:
    ///
    /// ```text
    /// √((K_act(0) + K_t)/m_e)/2π     √(κ_wh/I_xx)/2π
    /// ```
    pub fn linear_modes(c: &Constants<f64>) -> [f64; 2] {
        let stiffness = secant_stiffness(c, 0.0) + c.k_t;
        [stiffness * c.inverse_m_e, c.kappa_wh * c.inverse_i_xx]
            .map(|square| square.sqrt() / (2.0 * core::f64::consts::PI))
    }
}
