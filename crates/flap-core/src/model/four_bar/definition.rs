//! Rows and single motions of the four-bar model.

use super::aerodynamics::{added_mass_lift, aerodynamics, load};
use super::columns::{self, S};
use super::constants::Constants;
use super::dynamics::FourBar;
use super::params::Params;
use super::rhs::{
    charging_current, current, driving_force, force, mass_matrix, stroke_damping, tip, transmission,
};
use super::wing;
use crate::aero::Wing;
use crate::drive::{Drive, DriveConstants, Wave};
use crate::model::stroke_and_pitch as states;
use crate::model::{Derived, Description, EnergyBalance, Imposed, Instant, Load, Model, Motions, Signal};
use crate::modes::Mode;
use crate::num::Lanes;
use crate::ode::Start;
use crate::parameter::Invalid;

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
    const LOADS: bool = true;
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

    fn wing(wing: &Wing) -> Vec<(&'static str, f64)> {
        wing::parameters(wing)
    }

    #[inline(always)]
    fn drive<R: Lanes>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Lanes>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> [R; S] {
        let Instant { input: drive, side, y, dy } = at;
        let y = states::state(&self.drive, drive, y);
        let [theta, phi, theta_dot, phi_dot] = y;
        let (sin, cos) = phi.sin_cos();
        let air = aerodynamics(c, side, &y, sin, cos);
        let added_mass = added_mass_lift(&c.air, sin, cos, &states::slope(&self.drive, drive, dy));
        let links = transmission(c, theta);
        let slider_rate = links.slope * theta_dot;
        let leakage = c.actuator.conductance * (drive.value - self.drive.mean_voltage(&c.drive));
        // A prescribed stroke says nothing about the actuator.
        let [force, current] = if self.drive.prescribes_stroke() {
            [theta.lit(f64::NAN); 2]
        } else {
            let current = current(&c.actuator, drive, slider_rate);
            [force(&c.actuator, drive, links.displacement), current + leakage]
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
            stroke_damping(&c.wing, &links) * theta_dot * theta_dot,
            c.wing.hinge_damping * phi_dot * phi_dot,
            -(air.stroke_moment * theta_dot + air.pitch_moment * phi_dot),
            -(air.rotation_stroke_moment * theta_dot + air.rotation_pitch_moment * phi_dot),
            current * drive.value,
            leakage * drive.value,
            current,
            tip(&c.actuator, links.displacement, force),
            swing * (current - charging_current(&c.actuator, drive)),
            driving_force(&c.actuator, swing) * slider_rate,
        ]
    }

    #[inline(always)]
    fn load<R: Lanes>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Load<R> {
        let Instant { input: drive, side, y, dy } = at;
        let y = states::state(&self.drive, drive, y);
        load(c, side, &y, &states::slope(&self.drive, drive, dy))
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
