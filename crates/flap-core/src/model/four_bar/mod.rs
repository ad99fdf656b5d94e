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
pub use constants::{Actuator, Air, Constants, Drive, Wing};
pub use params::{AddedMassSign, Arms, MAX_STRIPS, Params, Quadrature};
pub use rhs::{
    Transmission, balance, charging_current, current, driving_force, force, mass_matrix, tip, transmission,
};

use super::convert::{GRAVITY, efficiency, wrap_degrees};
use super::{Derived, Measure, Model, Signal, SignalCycle, on_stroke, on_stroke_rates};
use crate::drive::{Driven, Samples, Source, Waveform};
use crate::modes::{Mode, natural_frequencies};
use crate::num::Lanes;
use crate::ode::{Ode, Start};
use crate::parameter::{Invalid, Parameter, Preset};
use columns::{DRIVE_POWER, DRIVING_POWER, LIFT, LOSSES, PITCH, POWER, S, STROKE, TRANSDUCED_POWER};

/// The model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FourBar {
    /// What generates the drive voltage, or the stroke.
    pub source: Source,
}

impl Ode<4> for FourBar {
    type Constants<R: Lanes> = Constants<R>;
    type Input<R: Lanes> = Driven<R>;

    #[inline(always)]
    fn input<R: Lanes>(&self, c: &Constants<R>, t: R) -> Driven<R> {
        self.source.at(&c.drive.waveform, t).drive(c.drive.bias, c.drive.amplitude)
    }

    /// The equations of motion hardly jump (see [`side_of`]), but the lift does, and a mean over a step that
    /// contains the jump is worth little. On 816 points of the 75 Hz system at rtol 1e-6, locating the jump costs
    /// 7 % more right-hand sides and brings the error of the mean lift, relative to its components, from 9e-4
    /// (median) and 2e-2 (largest) down to 7e-7 and 1e-5. Every point settles; otherwise a few in a thousand do not.
    const SWITCHES: bool = true;

    #[inline(always)]
    fn next_break<R: Lanes>(&self, c: &Constants<R>, t: R) -> R {
        self.source.next_break(&c.drive.waveform, t)
    }

    #[inline(always)]
    fn rhs<R: Lanes>(&self, c: &Constants<R>, drive: &Driven<R>, side: R, y: &[R; 4]) -> [R; 4] {
        let prescribed = self.source.prescribes_stroke();
        let at = if prescribed { on_stroke(drive, y) } else { *y };
        let links = transmission(c, at[0]);
        let balance = balance(c, &links, side, &at);
        if prescribed {
            balance.prescribed(y, drive, c.drive.waveform.rate)
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
    const NAME: &'static str = "four-bar";
    const DOC: &'static str = "unimorph, slider-crank and four-bar, passive pitch, strip aerodynamics (Arabagi, Hines and Sitti 2013)";
    const PARAMETERS: &'static [Parameter] = Params::TABLE;
    const PRESETS: &'static [Preset] = Params::PRESETS;
    const STATES: [&'static str; 4] = ["stroke_rad", "pitch_rad", "stroke_rate_rad_s", "pitch_rate_rad_s"];

    const SIGNALS: [Signal; S] = columns::SIGNALS;
    const PRINCIPAL: &'static [(usize, Measure)] = columns::PRINCIPAL;
    const DERIVED: &'static [Derived] = columns::DERIVED;

    fn variant(&self, values: &[f64]) -> FourBar {
        let params = Params::from_values(values);
        FourBar { source: self.source.of_point(params.drive_shape, params.stroke_mode) }
    }

    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let params = Params::from_values(values);
        self.source.check(params.drive_rise)?;
        let constants = Constants::derive(&params)?;
        let rate = constants.drive.waveform.rate;
        Ok(Start {
            constants,
            y: self.initial_state(&constants),
            span: 1.0 / params.drive_frequency,
            scale: [0.3, 0.5, 0.3 * rate, 0.5 * rate],
            tighten: 1.0,
        })
    }

    fn chirped(&self, c: &Constants<f64>, frequency: f64, rate: f64) -> (FourBar, Constants<f64>) {
        let drive = Drive { waveform: Waveform::chirp(frequency, rate), ..c.drive };
        (FourBar { source: self.source.chirped() }, Constants { drive, ..*c })
    }

    #[inline(always)]
    fn drive_phase<R: Lanes>(&self, c: &Constants<R>, t: R) -> R {
        c.drive.waveform.phase(t)
    }

    #[inline(always)]
    fn signals<R: Lanes>(
        &self,
        c: &Constants<R>,
        drive: &Driven<R>,
        side: R,
        y: &[R; 4],
        dy: &[R; 4],
    ) -> [R; S] {
        let prescribed = self.source.prescribes_stroke();
        let (y, dy) = if prescribed { (&on_stroke(drive, y), &on_stroke_rates(drive, dy)) } else { (y, dy) };
        let [theta, phi, theta_dot, phi_dot] = *y;
        let (sin, cos) = phi.sin_cos();
        let air = aerodynamics(c, side, y, sin, cos);
        let added_mass = added_mass_lift(&c.air, sin, cos, dy);
        let links = transmission(c, theta);
        let slider_rate = links.slope * theta_dot;
        // A prescribed stroke knows nothing of what the actuator does.
        let [force, current] = if prescribed {
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

    fn imposed(&self, c: &Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> ([f64; 4], [f64; S]) {
        let y = [stroke[0], pitch[0], stroke[1], pitch[1]];
        let dy = [stroke[1], pitch[1], stroke[2], pitch[2]];
        let [direction, _] = side_of(pitch[0], pitch[1]);
        let side = 1.0_f64.copysign(direction);
        let [value, rate, bend] = stroke;
        let prescribed = FourBar { source: Source::PRESCRIBED };
        (y, prescribed.signals(c, &Driven { value, rate, bend }, side, &y, &dy))
    }

    fn sampled(&self, samples: Samples) -> FourBar {
        FourBar { source: self.source.sampled(samples) }
    }

    /// ⟨Vi⟩ = ⟨F δ̇⟩ = what damping and air take: actuator, springs and inertia give back everything within a period.
    fn on_orbit(&self, cycle: &mut [SignalCycle; S]) {
        // A prescribed stroke has no electrical power.
        if !cycle[POWER].mean.is_nan() {
            let losses = cycle[LOSSES].iter().map(|loss| loss.mean).sum();
            cycle[DRIVE_POWER].mean = losses;
            cycle[POWER].mean = losses;
        }
    }

    fn audit(&self, cycle: &[SignalCycle; S]) -> f64 {
        cycle[DRIVE_POWER].audit(&cycle[DRIVING_POWER])
    }

    fn derived(&self, c: &Constants<f64>, cycle: &[SignalCycle; S]) -> Vec<f64> {
        // The drive's sine has the phase −π/2 against the cosine.
        let drive_phase = -core::f64::consts::FRAC_PI_2;
        let lift_gf = cycle[LIFT].mean / GRAVITY * 1e3;
        let power = cycle[POWER].mean;
        let frequency = c.drive.waveform.rate / (2.0 * core::f64::consts::PI);
        let [low, high] = if self.source.prescribes_stroke() {
            [f64::NAN; 2]
        } else {
            self.source.range(&c.drive.waveform).map(|wave| c.drive.bias + c.drive.amplitude * wave)
        };
        let voltage_pp = high - low;
        let [mode_1, mode_2] = FourBar::linear_modes(c);
        let field_max = high.max(-low) / c.actuator.piezo_thickness;
        vec![
            wrap_degrees(drive_phase - cycle[STROKE].phase()),
            wrap_degrees(cycle[STROKE].phase() - cycle[PITCH].phase()),
            lift_gf,
            efficiency(lift_gf, power),
            0.5 * c.actuator.capacitance * voltage_pp * voltage_pp * frequency * 1e3,
            self.audit(cycle),
            cycle[POWER].audit(&cycle[TRANSDUCED_POWER]),
            field_max * 1e-6,
            mode_1,
            mode_2,
        ]
    }

    fn modes(&self, c: &Constants<f64>) -> [Mode; 2] {
        let [lower, upper] = FourBar::linear_modes(c);
        [Mode { name: "mode_1", frequency: lower }, Mode { name: "mode_2", frequency: upper }]
    }

    /// At the voltage V_ref: φ̇ = −(M₁₂/M₂₂) θ̇.
    fn released(&self, c: &Constants<f64>, stroke_rate: f64) -> (FourBar, Constants<f64>, [f64; 4]) {
        let [_, m12, m22] = mass_matrix(c, transmission(c, 0.0).inertia, 0.0, 1.0);
        let waveform = Waveform { rate: 0.0, ..c.drive.waveform };
        let drive = Drive { bias: c.actuator.rest_voltage, amplitude: 0.0, waveform };
        let state = [0.0, 0.0, stroke_rate, -(m12 / m22) * stroke_rate];
        (FourBar { source: Source::SINE }, Constants { drive, ..*c }, state)
    }
}

impl FourBar {
    /// At rest; where the stroke is prescribed, on it.
    fn initial_state(&self, c: &Constants<f64>) -> [f64; 4] {
        let rest = [0.0; 4];
        if self.source.prescribes_stroke() { on_stroke(&self.input(c, 0.0), &rest) } else { rest }
    }

    /// Natural frequencies (Hz) of small undamped motions about zero stroke and pitch, the lower first.
    ///
    /// Of M(0) and K = diag(k_eff δ′(0)², k_rot): the actuator unloaded there, at the voltage V_ref.
    pub fn linear_modes(c: &Constants<f64>) -> [f64; 2] {
        let links = transmission(c, 0.0);
        let [m11, m12, m22] = mass_matrix(c, links.inertia, 0.0, 1.0);
        let stiffness = c.actuator.stiffness * links.slope * links.slope;
        natural_frequencies([[m11, m12], [m12, m22]], [stiffness, c.wing.hinge_stiffness])
    }
}
