//! The direct-drive model as a system of differential equations.

use super::constants::Constants;
use super::params::FlowDirection;
use super::rhs::{balance, mean_velocity};
use crate::drive::{Drive, Wave};
use crate::model::stroke_and_pitch as states;
use crate::modes::natural_frequencies;
use crate::num::Real;
use crate::ode::Ode;

/// The model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DirectDrive {
    /// The drive voltage, or the prescribed stroke.
    pub drive: Drive,
    /// Direction of the air's flow over the wing while it reverses.
    pub flow: FlowDirection,
}

impl Ode<4> for DirectDrive {
    type Constants<R: Real> = Constants<R>;
    type Input<R: Real> = Wave<R>;

    #[inline(always)]
    fn input<R: Real>(&self, c: &Constants<R>, t: R) -> Wave<R> {
        self.drive.at(&c.drive, t)
    }

    /// The paper takes one direction of flow for the whole wing: forces jump where it changes. Those of blade elements
    /// do not.
    const SWITCHES: bool = true;

    #[inline(always)]
    fn next_break<R: Real>(&self, c: &Constants<R>, t: R) -> R {
        self.drive.next_break(&c.drive, t)
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &Constants<R>, drive: &Wave<R>, side: R, y: &[R; 4]) -> [R; 4] {
        let balance = balance(c, self.flow, side, &states::state(&self.drive, drive, y));
        if self.drive.prescribes_stroke() {
            balance.prescribed(y, drive, c.drive.rate)
        } else {
            balance.driven(y, c.gamma * drive.value)
        }
    }

    #[inline(always)]
    fn switch<R: Real>(&self, c: &Constants<R>, y: &[R; 4], dy: &[R; 4]) -> [R; 2] {
        match self.flow {
            FlowDirection::Uniform => mean_velocity(c, y, dy),
            // A function that never changes its sign.
            FlowDirection::Blade => [y[0].lit(1.0), y[0].lit(0.0)],
        }
    }
}

impl DirectDrive {
    /// Natural frequencies (Hz) of small motions about ψ = 0 with the added mass of still air, the lower first.
    pub fn linear_modes(c: &Constants<f64>) -> [f64; 2] {
        natural_frequencies(DirectDrive::mass_at_rest(c), [c.k_phi, c.k_w])
    }

    /// The mass matrix [M₁₁, M₁₂, M₂₂] (kg·m²) at ψ = 0, with the added mass.
    pub(super) fn mass_at_rest(c: &Constants<f64>) -> [f64; 3] {
        [c.m11 + c.a11, c.m12 - c.a12, c.m22 + c.a22]
    }
}
