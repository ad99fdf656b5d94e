//! The four-bar model as a system of differential equations.

use super::aerodynamics::side_of;
use super::constants::Constants;
use super::rhs::{balance, force, mass_matrix, transmission};
use crate::drive::{Drive, Wave};
use crate::model::stroke_and_pitch as states;
use crate::modes::natural_frequencies;
use crate::num::Real;
use crate::ode::Ode;

/// The model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FourBar {
    /// The drive voltage, or the prescribed stroke.
    pub drive: Drive,
}

impl Ode<4> for FourBar {
    type Constants<R: Real> = Constants<R>;
    type Input<R: Real> = Wave<R>;

    #[inline(always)]
    fn input<R: Real>(&self, c: &Constants<R>, t: R) -> Wave<R> {
        self.drive.at(&c.drive, t)
    }

    /// The equations of motion hardly jump (see [`side_of`]), but the lift does, and a mean over a step that
    /// contains the jump is worth little. On 816 points of the 75 Hz system at rtol 1e-6, locating the jump costs
    /// 7 % more right-hand sides and brings the error of the mean lift, relative to its components, from 9e-4
    /// (median) and 2e-2 (largest) down to 7e-7 and 1e-5. Every point settles; otherwise a few in a thousand do not.
    const SWITCHES: bool = true;

    #[inline(always)]
    fn next_break<R: Real>(&self, c: &Constants<R>, t: R) -> R {
        self.drive.next_break(&c.drive, t)
    }

    #[inline(always)]
    fn rhs<R: Real>(&self, c: &Constants<R>, drive: &Wave<R>, side: R, y: &[R; 4]) -> [R; 4] {
        let at = states::state(&self.drive, drive, y);
        let links = transmission(c, at[0]);
        let balance = balance(c, &links, side, &at);
        if self.drive.prescribes_stroke() {
            balance.prescribed(y, drive, c.drive.rate)
        } else {
            balance.driven(y, force(&c.actuator, drive, links.displacement) * links.slope)
        }
    }

    #[inline(always)]
    fn switch<R: Real>(&self, _c: &Constants<R>, y: &[R; 4], _dy: &[R; 4]) -> [R; 2] {
        side_of(y[1], y[3])
    }
}

impl FourBar {
    /// Natural frequencies (Hz) of small undamped motions about zero stroke and pitch, the lower first.
    ///
    /// Of M(0) and K = diag(k_eff δ′(0)², k_rot): the actuator unloaded there, at the voltage V_ref.
    pub fn linear_modes(c: &Constants<f64>) -> [f64; 2] {
        let links = transmission(c, 0.0);
        let stiffness = c.actuator.stiffness * links.slope * links.slope;
        let mass = mass_matrix(c, links.inertia, 0.0, 1.0);
        natural_frequencies(mass, [stiffness, c.wing.hinge_stiffness])
    }
}
