//! A unimorph that flaps a passively pitching wing through a slider-crank and a four-bar.
//!
//! Arabagi, Hines and Sitti, "A simulation and design tool for a passive rotation flapping wing mechanism",
//! IEEE/ASME Transactions on Mechatronics 18, 787 (2013). Quasi-static actuator in series with a spring, transmission
//! with the inertia of its links, Lagrangian wing inertia, quasi-steady aerodynamics by strips, lift by component.
//!
//! The paper prints neither the actuator's equations nor the sizes of wing and actuator: these are rebuilt and
//! assumed. Current and power are an extension.

mod aerodynamics;
mod columns;
mod composite;
mod constants;
mod params;
mod rhs;

pub use aerodynamics::{Aerodynamics, added_mass_lift, aerodynamics, coefficients, side_of};
pub use composite::Composite;
pub use constants::{Actuator, Air, Constants, Wing};
pub use params::{AddedMassSign, Arms, MAX_STRIPS, Params, Quadrature};
pub use rhs::{
    Transmission, balance, charging_current, current, driving_force, force, mass_matrix, tip, transmission,
};

use super::motions::Imposed;
use super::stroke_and_pitch as states;
use super::{Derived, Description, EnergyBalance, Model, Motions, Signal};
use crate::drive::{Drive, DriveConstants, Wave};
use crate::modes::{Mode, natural_frequencies};
use crate::num::Lanes;
use crate::ode::{Ode, Start};
use crate::parameter::Invalid;
use columns::S;

/// The model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FourBar {
    /// The drive voltage, or the prescribed stroke.
    pub drive: Drive,
}

impl Ode<4> for FourBar {
    type Constants<R: Lanes> = Constants<R>;
    type Input<R: Lanes> = Wave<R>;

    #[inline(always)]
    fn input<R: Lanes>(&self, c: &Constants<R>, t: R) -> Wave<R> {
        self.drive.at(&c.drive, t)
    }

    /// The equations of motion hardly jump (see [`side_of`]), but the lift does, and a mean over a step that
    /// contains the jump is worth little. On 816 points of the 75 Hz system at rtol 1e-6, locating the jump costs
    /// 7 % more right-hand sides and brings the error of the mean lift, relative to its components, from 9e-4
    /// (median) and 2e-2 (largest) down to 7e-7 and 1e-5. Every point settles; otherwise a few in a thousand do not.
    const SWITCHES: bool = true;

    #[inline(always)]
    fn next_break<R: Lanes>(&self, c: &Constants<R>, t: R) -> R {
        self.drive.next_break(&c.drive, t)
    }

    #[inline(always)]
    fn rhs<R: Lanes>(&self, c: &Constants<R>, drive: &Wave<R>, side: R, y: &[R; 4]) -> [R; 4] {
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
    fn switch<R: Lanes>(&self, _c: &Constants<R>, y: &[R; 4], _dy: &[R; 4]) -> [R; 2] {
        side_of(y[1], y[3])
    }
}

impl Model<4, S> for FourBar {
    const DESCRIPTION: Description = Description {
        name: "four-bar",
        doc: "unimorph, slider-crank and four-bar, passive pitch, strip aerodynamics (Arabagi, Hines and Sitti 2013)",
        parameters: Params::TABLE,
        presets: Params::PRESETS,
    };
    const STATES: [&'static str; 4] = states::NAMES;
    const SIGNALS: [Signal; S] = columns::SIGNALS;
    const DERIVED: &'static [Derived<FourBar, Constants<f64>, S>] = columns::DERIVED;
    const ENERGY: Option<EnergyBalance> = Some(columns::ENERGY);

    fn variant(&self, values: &[f64]) -> FourBar {
        let Params { waveform, stroke, .. } = Params::from_values(values);
        FourBar { drive: self.drive.of_point(waveform.drive_shape, stroke.stroke_mode) }
    }

    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let params = Params::from_values(values);
        self.drive.check(&params.waveform)?;
        let constants = Constants::derive(&params)?;
        Ok(states::start(&self.drive, &constants.drive, constants, [0.3, 0.5]))
    }

    #[inline(always)]
    fn drive<R: Lanes>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Lanes>(
        &self,
        c: &Constants<R>,
        drive: &Wave<R>,
        side: R,
        y: &[R; 4],
        dy: &[R; 4],
    ) -> [R; S] {
        let y = states::state(&self.drive, drive, y);
        let [theta, phi, theta_dot, phi_dot] = y;
        let (sin, cos) = phi.sin_cos();
        let air = aerodynamics(c, side, &y, sin, cos);
        let added_mass = added_mass_lift(&c.air, sin, cos, &states::slope(&self.drive, drive, dy));
        let links = transmission(c, theta);
        let slider_rate = links.slope * theta_dot;
        // A prescribed stroke says nothing about the actuator.
        let [force, current] = if self.drive.prescribes_stroke() {
            [theta.lit(f64::NAN); 2]
        } else {
            [force(&c.actuator, drive, links.displacement), current(&c.actuator, drive, slider_rate)]
        };
        let swing = drive.value - c.drive.bias;
        [
            theta,
            phi,
            air.lift + air.rotation_lift + added_mass,
            air.lift,
            air.rotation_lift,
            added_mass,
            air.drag,
            force * slider_rate,
            c.wing.stroke_damping * theta_dot * theta_dot,
            c.wing.hinge_damping * phi_dot * phi_dot,
            -(air.stroke_moment * theta_dot + air.pitch_moment * phi_dot),
            -(air.rotation_stroke_moment * theta_dot + air.rotation_pitch_moment * phi_dot),
            current * drive.value,
            current,
            tip(&c.actuator, links.displacement, force),
            swing * (current - charging_current(&c.actuator, drive)),
            driving_force(&c.actuator, swing) * slider_rate,
        ]
    }
}

impl Motions<4, S> for FourBar {
    fn drive_mut(&mut self) -> &mut Drive {
        &mut self.drive
    }

    fn drive_constants_mut(c: &mut Constants<f64>) -> &mut DriveConstants<f64> {
        &mut c.drive
    }

    fn modes(c: &Constants<f64>) -> [Mode; 2] {
        Mode::pair(["mode_1", "mode_2"], FourBar::linear_modes(c))
    }

    fn rest_voltage(c: &Constants<f64>) -> f64 {
        c.actuator.rest_voltage
    }

    fn struck(c: &Constants<f64>, stroke_rate: f64) -> [f64; 4] {
        states::struck(mass_matrix(c, transmission(c, 0.0).inertia, 0.0, 1.0), stroke_rate)
    }

    fn placed(_c: &Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<Wave<f64>, 4> {
        states::placed(stroke, pitch)
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
