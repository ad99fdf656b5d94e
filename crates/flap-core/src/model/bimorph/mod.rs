//! A bimorph piezoelectric actuator that drives a wing through a transmission; the wing pitches on a hinge.
//!
//! Jafferis, Graule and Wood, "Non-linear resonance modeling and system design improvements for
//! underactuated flapping-wing vehicles", ICRA 2016. Two plates with field- and strain-dependent force and
//! stiffness, a lumped mass, quasi-steady aerodynamics of the whole wing, a passive hinge.

mod actuator;
mod columns;
mod constants;
mod params;
mod rhs;

pub use actuator::{Actuator, taper_gain};
pub use constants::Constants;
pub use params::{ActuatorStiffness, CentreOfPressure, FieldTransition, Params};
pub use rhs::{
    Plate, charges, charging_power, currents, derivative, drag_coefficient, elastic_force, hinge_drag,
    lift_and_drag, plate, plate_forces, secant_stiffness, stiffening, tip_drag,
};

use super::{Derived, Measure, Model, Signal, SignalCycle};
use crate::drive::{Driven, Samples, Shape, Source, StrokeMode, Waveform};
use crate::modes::Mode;
use crate::num::Lanes;
use crate::ode::{Ode, Start};
use crate::parameter::{Invalid, Parameter, Preset};

/// The model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bimorph {
    /// What generates the drive voltage.
    pub source: Source,
}

impl Ode<4> for Bimorph {
    type Constants<R: Lanes> = Constants<R>;
    type Input<R: Lanes> = [Plate<R>; 2];

    /// The two plates at time `t`, driven in antiphase, (7).
    ///
    /// ```text
    /// V₁ = ½V_pp (1 − sin ωt)     V₂ = ½V_pp (1 + sin ωt)
    /// ```
    #[inline(always)]
    fn input<R: Lanes>(&self, c: &Constants<R>, t: R) -> [Plate<R>; 2] {
        let half = c.half_voltage;
        let wave = self.source.at(&c.waveform, t);
        [plate(c, wave.drive(half, -half)), plate(c, wave.drive(half, half))]
    }

    #[inline(always)]
    fn next_break<R: Lanes>(&self, c: &Constants<R>, t: R) -> R {
        self.source.next_break(&c.waveform, t)
    }

    #[inline(always)]
    fn rhs<R: Lanes>(&self, c: &Constants<R>, plates: &[Plate<R>; 2], _side: R, y: &[R; 4]) -> [R; 4] {
        derivative(c, plates, y)
    }
}

impl Model<4, { columns::S }> for Bimorph {
    const NAME: &'static str = "bimorph";
    const DOC: &'static str =
        "bimorph on a transmission, passive hinge, lumped quasi-steady aerodynamics (Jafferis et al. 2016)";
    const PARAMETERS: &'static [Parameter] = Params::TABLE;
    const PRESETS: &'static [Preset] = Params::PRESETS;
    const STATES: [&'static str; 4] = ["tip_m", "tip_rate_m_s", "pitch_rad", "pitch_rate_rad_s"];
    const SIGNALS: [Signal; columns::S] = columns::SIGNALS;
    const PRINCIPAL: &'static [(usize, Measure)] = columns::PRINCIPAL;
    const DERIVED: &'static [Derived] = columns::DERIVED;

    fn variant(&self, values: &[f64]) -> Bimorph {
        let params = Params::from_values(values);
        Bimorph { source: self.source.of_point(params.drive_shape, StrokeMode::Free) }
    }

    /// Starts at rest. The scales are those of the direct-drive model, so that tolerances and residuals mean the
    /// same: strokes of 0.1 rad, hinge angles of 0.3 rad, times the drive's angular frequency for the rates.
    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let params = Params::from_values(values);
        self.source.check(params.drive_rise)?;
        let constants = Constants::derive(&params)?;
        let rate = constants.waveform.rate;
        let tip = 0.1 / params.transmission_ratio;
        Ok(Start {
            constants,
            y: [0.0; 4],
            span: 1.0 / params.drive_frequency,
            scale: [tip, tip * rate, 0.3, 0.3 * rate],
            tighten: 1.0,
        })
    }

    fn chirped(&self, c: &Constants<f64>, frequency: f64, rate: f64) -> (Bimorph, Constants<f64>) {
        (
            Bimorph { source: self.source.chirped() },
            Constants { waveform: Waveform::chirp(frequency, rate), ..*c },
        )
    }

    #[inline(always)]
    fn drive_phase<R: Lanes>(&self, c: &Constants<R>, t: R) -> R {
        c.waveform.phase(t)
    }

    #[inline(always)]
    fn signals<R: Lanes>(
        &self,
        c: &Constants<R>,
        plates: &[Plate<R>; 2],
        _side: R,
        y: &[R; 4],
        _dy: &[R; 4],
    ) -> [R; columns::S] {
        let [x, x_dot, psi, psi_dot] = *y;
        let (sin, cos) = psi.sin_cos();
        let (sin_2psi, cos_2psi) = rhs::double_angle(sin, cos);
        let [lift, drag] = lift_and_drag(c, x_dot, sin_2psi, cos_2psi);
        let [f_1, f_2] = plate_forces(c, plates, x);
        let [i_1, i_2] = currents(c, plates, x, x_dot);
        let power_1 = plates[0].voltage.value * i_1;
        let power_2 = plates[1].voltage.value * i_2;
        [
            c.ratio * x,
            psi,
            lift,
            drag,
            power_1 + power_2,
            power_1,
            power_2,
            (f_1 - f_2) * x_dot,
            tip_drag(c, cos_2psi) * x_dot * x_dot * x_dot.abs(),
            c.c_c * psi_dot * psi_dot * psi_dot.abs(),
            i_1,
            i_2,
            f_1,
            f_2,
            power_1 + power_2 - charging_power(c, plates),
        ]
    }

    /// Currents follow the edges of the force's transition, (6), which the drive crosses in a fraction of a step.
    #[inline(always)]
    fn parts(&self) -> u32 {
        if self.source.shape == Shape::Square { 6 } else { 2 }
    }

    fn imposed(
        &self,
        c: &Constants<f64>,
        stroke: [f64; 3],
        pitch: [f64; 3],
    ) -> ([f64; 4], [f64; columns::S]) {
        let [x, x_dot, x_ddot] = stroke.map(|stroke| stroke / c.ratio);
        let y = [x, x_dot, pitch[0], pitch[1]];
        let dy = [x_dot, x_ddot, pitch[1], pitch[2]];
        let unknown = plate(c, Driven::with_rate(f64::NAN, f64::NAN));
        (y, self.signals(c, &[unknown; 2], 1.0, &y, &dy))
    }

    fn sampled(&self, samples: Samples) -> Bimorph {
        Bimorph { source: self.source.sampled(samples) }
    }

    fn on_orbit(&self, cycle: &mut [SignalCycle; columns::S]) {
        columns::on_orbit(cycle);
    }

    fn audit(&self, cycle: &[SignalCycle; columns::S]) -> f64 {
        columns::audit(cycle)
    }

    fn derived(&self, c: &Constants<f64>, cycle: &[SignalCycle; columns::S]) -> Vec<f64> {
        columns::values(c, self.source.range(&c.waveform), cycle)
    }

    fn modes(&self, c: &Constants<f64>) -> [Mode; 2] {
        let [stroke, hinge] = Bimorph::linear_modes(c);
        [Mode { name: "mode_stroke", frequency: stroke }, Mode { name: "mode_hinge", frequency: hinge }]
    }

    /// With ½V_pp on both plates: ψ̇ = I_xz T ẋ/I_xx, by (2).
    fn released(&self, c: &Constants<f64>, stroke_rate: f64) -> (Bimorph, Constants<f64>, [f64; 4]) {
        let tip_rate = stroke_rate / c.ratio;
        let waveform = Waveform { rate: 0.0, ..c.waveform };
        let state = [0.0, tip_rate, 0.0, c.coupling * tip_rate * c.inverse_i_xx];
        (Bimorph { source: Source::SINE }, Constants { waveform, ..*c }, state)
    }
}
