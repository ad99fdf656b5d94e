//! Rows and single motions of the bimorph model.

use super::columns::{self, Signals};
use super::constants::Constants;
use super::dynamics::Bimorph;
use super::params::Params;
use super::rhs::{
    Plate, charging_power, currents, double_angle, leakage, lift_and_drag, load, plate_forces, plates,
    stroke_damping, tip_drag,
};
use super::transmission::{Law, Transmission, stroke};
use super::wing;
use crate::aero::Wing;
use crate::drive::{Drive, DriveConstants, Shape, StrokeMode, Wave, Waveform};
use crate::model::{Derived, Description, Imposed, Instant, Load, Model, Motions, Signal, SignalCycle};
use crate::modes::Mode;
use crate::num::Real;
use crate::ode::Start;
use crate::parameter::Invalid;

impl Model<4> for Bimorph {
    type Signals = Signals;

    const DESCRIPTION: Description = Description {
        name: "bimorph",
        doc: "bimorph on a transmission, passive hinge, lumped quasi-steady aerodynamics (Jafferis et al. 2016)",
        parameters: Params::TABLE,
        presets: Params::PRESETS,
    };
    const STATES: [&'static str; 4] = ["tip_m", "tip_rate_m_s", "pitch_rad", "pitch_rate_rad_s"];
    const SIGNALS_OF_SLOPES: bool = false;
    const DERIVED: &'static [Derived<Bimorph, Constants<f64>, Signals>] = columns::DERIVED;
    const LOADS: bool = true;

    fn variant(&self, values: &[f64]) -> Bimorph {
        let Params { waveform, transmission_growth, .. } = Params::from_values(values);
        Bimorph {
            drive: self.drive.of_point(waveform.drive_shape, StrokeMode::Free),
            law: if transmission_growth == 0.0 { Law::Constant } else { Law::Square },
        }
    }

    fn with_all_terms(&self) -> Bimorph {
        Bimorph { law: Law::Square, ..self.clone() }
    }

    /// Starts at rest. The scales are those of the direct-drive model, so that tolerances and residuals mean the
    /// same: strokes of 0.1 rad, hinge angles of 0.3 rad, times the drive's angular frequency for the rates.
    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let params = Params::from_values(values);
        self.drive.check(&params.waveform)?;
        let constants = Constants::derive(&params)?;
        let DriveConstants { rate, .. } = constants.drive;
        let tip = 0.1 / params.transmission_ratio;
        let scale = [tip, tip * rate, 0.3, 0.3 * rate];
        Ok(Start::new(constants, [0.0; 4], constants.drive.period(), scale))
    }

    fn wing(wing: &Wing) -> Vec<(&'static str, f64)> {
        wing::parameters(wing)
    }

    #[inline(always)]
    fn drive<R: Real>(c: &Constants<R>) -> &DriveConstants<R> {
        &c.drive
    }

    #[inline(always)]
    fn signals<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, [Plate<R>; 2], 4>) -> Signals<R> {
        let Instant { input: plates, y, .. } = at;
        let [x, x_dot, psi, psi_dot] = *y;
        let (sin, cos) = psi.sin_cos();
        let (sin_2psi, cos_2psi) = double_angle(sin, cos);
        let transmission = Transmission::at(c, self.law, x);
        let rate = transmission.times(x_dot);
        let [lift, drag] = lift_and_drag(c, rate, sin_2psi, cos_2psi);
        let [f_1, f_2] = plate_forces(c, plates, x);
        let [i_1, i_2] = currents(c, plates, x, x_dot);
        let [leak_1, leak_2] = leakage(c, plates, self.mean_voltages(c));
        let (i_1, i_2) = (i_1 + leak_1, i_2 + leak_2);
        let [v_1, v_2] = [plates[0].voltage.value, plates[1].voltage.value];
        let (power_1, power_2) = (v_1 * i_1, v_2 * i_2);
        Signals {
            stroke: stroke(c, self.law, x),
            pitch: psi,
            lift,
            drag,
            power: power_1 + power_2,
            power_plate_1: power_1,
            power_plate_2: power_2,
            power_mechanical: (f_1 - f_2) * x_dot,
            power_drag: tip_drag(c, cos_2psi) * rate * rate * rate.abs(),
            power_rotational: c.c_c * psi_dot * psi_dot * psi_dot.abs(),
            power_stroke_damping: stroke_damping(c, &transmission, x_dot, rate) * x_dot,
            power_hinge_damping: c.hinge_damping * psi_dot * psi_dot,
            power_dielectric: v_1 * leak_1 + v_2 * leak_2,
            current_1: i_1,
            current_2: i_2,
            force_1: f_1,
            force_2: f_2,
            power_transduced: power_1 + power_2 - charging_power(c, plates),
        }
    }

    /// ⟨V₁i₁ + V₂i₂⟩ − ⟨dielectric loss⟩ = ⟨(F₁ − F₂) ẋ⟩ = ⟨power of the stroke's drag and damping⟩: (1) has no other loss.
    fn balance_energy(cycle: &mut Signals<SignalCycle>) {
        let (drag, damping) = (cycle.power_drag, cycle.power_stroke_damping);
        cycle.power.balance(&[drag, damping, cycle.power_dielectric]);
        cycle.power_mechanical.balance(&[drag, damping]);
    }

    fn energy_audit(cycle: &Signals<SignalCycle>) -> f64 {
        cycle.power.audit(&cycle.power_transduced)
    }

    #[inline(always)]
    fn load<R: Real>(&self, c: &Constants<R>, at: Instant<'_, R, [Plate<R>; 2], 4>) -> Load<R> {
        let [x, x_dot, psi, psi_dot] = *at.y;
        let rate = Transmission::at(c, self.law, x).times(x_dot);
        load(c, stroke(c, self.law, x), x_dot, rate, [psi, psi_dot])
    }

    /// Currents follow the edges of the force's transition, (6), which the drive crosses in a fraction of a step.
    #[inline(always)]
    fn parts(&self) -> u32 {
        if self.drive.waveform == Waveform::Shape(Shape::Square) { 6 } else { 2 }
    }
}

impl Motions<4> for Bimorph {
    const FREE_SIGNALS: &'static [Signal] = &[Signals::SIGNALS.stroke, Signals::SIGNALS.pitch];

    fn drive_mut(&mut self) -> &mut Drive {
        &mut self.drive
    }

    fn drive_constants_mut(c: &mut Constants<f64>) -> &mut DriveConstants<f64> {
        &mut c.drive
    }

    fn modes(c: &Constants<f64>) -> Vec<Mode> {
        Mode::of(["mode_stroke", "mode_hinge"], Bimorph::linear_modes(c))
    }

    /// ½V_pp on both plates.
    fn rest_voltage(c: &Constants<f64>) -> f64 {
        c.drive.bias
    }

    /// ψ̇ = I_xz T ẋ/I_xx, by (2).
    fn struck(c: &Constants<f64>, stroke_rate: f64) -> [f64; 4] {
        let tip_rate = stroke_rate / c.ratio;
        [0.0, tip_rate, 0.0, c.coupling * tip_rate * c.inverse_i_xx]
    }

    fn placed(c: &Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<[Plate<f64>; 2], 4> {
        let x = c.tip(stroke[0]);
        // φ = T (x + τ x³/3), differentiated twice.
        let (ratio, slope) = (c.ratio * (1.0 + c.ratio_growth * x * x), 2.0 * c.ratio * c.ratio_growth * x);
        let x_dot = stroke[1] / ratio;
        let x_ddot = (stroke[2] - slope * x_dot * x_dot) / ratio;
        let unknown = plates(c, [Wave::with_rate(f64::NAN, f64::NAN); 2]);
        ([x, x_dot, pitch[0], pitch[1]], [x_dot, x_ddot, pitch[1], pitch[2]], unknown)
    }
}
