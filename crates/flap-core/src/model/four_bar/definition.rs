//! Rows and single motions of the four-bar model.

use super::aerodynamics::{added_mass_lift, aerodynamics, load};
use super::columns::{self, Signals};
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
use crate::model::{Derived, Description, Imposed, Instant, Load, Model, Motions, Signal, SignalCycle};
use crate::modes::Mode;
use crate::num::Real;
use crate::ode::Start;
use crate::parameter::Invalid;

impl Model<4> for FourBar {
    type Signals = Signals;

    const DESCRIPTION: Description = Description {
        name: "four-bar",
        doc: "unimorph, slider-crank and four-bar, passive pitch, strip aerodynamics (Arabagi, Hines and Sitti 2013)",
        parameters: Params::TABLE,
        presets: Params::PRESETS,
    };
    const STATES: [&'static str; 4] = states::NAMES;
    const DERIVED: &'static [Derived<FourBar, Constants<f64>, Signals>] = columns::DERIVED;
    const LOADS: bool = true;

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
    fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Signals<R> {
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
        Signals {
            stroke: theta,
            pitch: phi,
            lift: air.lift + air.rotation_lift + added_mass,
            lift_translational: air.lift,
            lift_rotational: air.rotation_lift,
            lift_added_mass: added_mass,
            drag: air.drag,
            power_drive: force * slider_rate,
            power_stroke_damping: stroke_damping(&c.wing, &links) * theta_dot * theta_dot,
            power_hinge_damping: c.wing.hinge_damping * phi_dot * phi_dot,
            power_translational: -(air.stroke_moment * theta_dot + air.pitch_moment * phi_dot),
            power_rotational: -(air.rotation_stroke_moment * theta_dot + air.rotation_pitch_moment * phi_dot),
            power: current * drive.value,
            power_dielectric: leakage * drive.value,
            current,
            tip: tip(&c.actuator, links.displacement, force),
            power_transduced: swing * (current - charging_current(&c.actuator, drive)),
            power_driving: driving_force(&c.actuator, swing) * slider_rate,
        }
    }

    /// ⟨Vi⟩ − ⟨dielectric loss⟩ = ⟨F δ̇⟩ = the power that damping and air take: actuator, springs and inertia give back
    /// everything within a period.
    fn balance_energy(cycle: &mut Signals<SignalCycle>) {
        let (stroke, hinge) = (cycle.power_stroke_damping, cycle.power_hinge_damping);
        let (translation, rotation) = (cycle.power_translational, cycle.power_rotational);
        cycle.power_drive.balance(&[stroke, hinge, translation, rotation]);
        cycle.power.balance(&[stroke, hinge, translation, rotation, cycle.power_dielectric]);
    }

    fn energy_audit(cycle: &Signals<SignalCycle>) -> f64 {
        cycle.power_drive.audit(&cycle.power_driving)
    }

    #[inline(always)]
    fn load<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, Wave<R>, 4>) -> Load<R> {
        let Instant { input: drive, side, y, dy } = at;
        let y = states::state(&self.drive, drive, y);
        load(c, side, &y, &states::slope(&self.drive, drive, dy))
    }
}

impl Motions<4> for FourBar {
    const FREE_SIGNALS: &'static [Signal] = &[Signals::SIGNALS.stroke, Signals::SIGNALS.pitch];

    fn drive_mut(&mut self) -> &mut Drive {
        &mut self.drive
    }

    fn drive_constants_mut(c: &mut Constants<f64>) -> &mut DriveConstants<f64> {
        &mut c.drive
    }

    fn modes(c: &Constants<f64>) -> Vec<Mode> {
        Mode::of(["mode_1", "mode_2"], FourBar::linear_modes(c))
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
