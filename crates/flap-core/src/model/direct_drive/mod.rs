//! A unimorph piezoelectric actuator bolted straight to a wing that pitches on a flexure hinge.
//!
//! Ozaki and Hamaguchi, "Electro-aero-mechanical model of piezoelectric direct-driven flapping-wing
//! actuator", Applied Sciences 8, 1699 (2018). Lagrangian wing inertia, added mass in the mass matrix,
//! quasi-steady translational and rotational aerodynamics in moment form, current and power.

mod chord;
mod constants;
mod params;
mod rhs;

pub use chord::BLADES;
pub use constants::Constants;
pub use params::{AddedMass, CentreOfPressure, FlowDirection, LiftSign, Params};
pub use rhs::{AddedMassLoad, Aerodynamics, added_mass, aerodynamics, balance, current, lift, mean_velocity};

use super::Measure::{Amplitude, First, Magnitude, Max, Mean, Min, Peak, PeakToPeak, Rms, Supply};
use super::convert::{DEGREES, GRAVITY, efficiency, wrap_degrees};
use super::{Derived, Measure, Model, Signal, SignalCycle, on_stroke, on_stroke_rates};
use crate::drive::{Driven, Samples, Source, Waveform};
use crate::modes::{Mode, natural_frequencies};
use crate::num::Lanes;
use crate::ode::{Ode, Start};
use crate::parameter::{Invalid, Parameter, Preset};

/// The model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DirectDrive {
    /// What generates the drive voltage, or the stroke.
    pub source: Source,
    /// Which way the air flows over the wing while it reverses.
    pub flow: FlowDirection,
}

impl Ode<4> for DirectDrive {
    type Constants<R: Lanes> = Constants<R>;
    type Input<R: Lanes> = Driven<R>;

    #[inline(always)]
    fn input<R: Lanes>(&self, c: &Constants<R>, t: R) -> Driven<R> {
        self.source.at(&c.waveform, t).drive(c.drive_bias, c.drive_amplitude)
    }

    /// The paper takes one direction of flow for the whole wing: forces jump where it changes. Those of blade elements
    /// do not.
    const SWITCHES: bool = true;

    #[inline(always)]
    fn next_break<R: Lanes>(&self, c: &Constants<R>, t: R) -> R {
        self.source.next_break(&c.waveform, t)
    }

    #[inline(always)]
    fn rhs<R: Lanes>(&self, c: &Constants<R>, drive: &Driven<R>, side: R, y: &[R; 4]) -> [R; 4] {
        let prescribed = self.source.prescribes_stroke();
        let at = if prescribed { on_stroke(drive, y) } else { *y };
        let balance = balance(c, self.flow, side, &at);
        if prescribed {
            balance.prescribed(y, drive, c.waveform.rate)
        } else {
            balance.driven(y, c.gamma * drive.value)
        }
    }

    #[inline(always)]
    fn switch<R: Lanes>(&self, c: &Constants<R>, y: &[R; 4], dy: &[R; 4]) -> [R; 2] {
        match self.flow {
            FlowDirection::Uniform => mean_velocity(c, y, dy),
            // A function that never changes its sign.
            FlowDirection::Blade => [y[0].lit(1.0), y[0].lit(0.0)],
        }
    }
}

/// Positions in [`Model::SIGNALS`].
const STROKE: usize = 0;
const PITCH: usize = 1;
const LIFT: usize = 2;
const POWER: usize = 5;
const DRAG_POWER: usize = 6;
const ROTATION_POWER: usize = 7;
const TRANSDUCED_POWER: usize = 9;

impl Model<4, 10> for DirectDrive {
    const NAME: &'static str = "direct-drive";
    const DOC: &'static str =
        "unimorph bolted to the wing, passive pitch, blade-element aerodynamics (Ozaki and Hamaguchi 2018)";
    const PARAMETERS: &'static [Parameter] = Params::TABLE;
    const PRESETS: &'static [Preset] = Params::PRESETS;
    const STATES: [&'static str; 4] = ["stroke_rad", "pitch_rad", "stroke_rate_rad_s", "pitch_rate_rad_s"];

    const SIGNALS: [Signal; 10] = [
        Signal {
            name: "stroke",
            unit: "deg",
            suffix: "deg",
            factor: DEGREES,
            doc: "stroke angle",
            measures: &[Amplitude, PeakToPeak, Mean, Max, Min, First],
        },
        Signal {
            name: "pitch",
            unit: "deg",
            suffix: "deg",
            factor: DEGREES,
            doc: "pitch angle of the wing on its hinge",
            measures: &[Amplitude, Mean, Max, Min, First],
        },
        Signal {
            name: "lift",
            unit: "mN",
            suffix: "mn",
            factor: 1e3,
            doc: "lift of the wing, Eq. (35)",
            measures: &[Mean, Max, Min],
        },
        Signal {
            name: "lift_translational",
            unit: "mN",
            suffix: "mn",
            factor: 1e3,
            doc: "lift without the part of the added mass, Eq. (21)",
            measures: &[Mean],
        },
        Signal {
            name: "drag",
            unit: "mN",
            suffix: "mn",
            factor: 1e3,
            doc: "translational drag along the stroke, Eq. (21)",
            measures: &[Magnitude],
        },
        Signal {
            name: "power",
            unit: "mW",
            suffix: "mw",
            factor: 1e3,
            doc: "electrical power current x voltage, Eq. (40); its mean is that of what the air takes",
            measures: &[Mean, Supply],
        },
        Signal {
            name: "power_translational",
            unit: "mW",
            suffix: "mw",
            factor: 1e3,
            doc: "power taken by translational aerodynamics",
            measures: &[Mean],
        },
        Signal {
            name: "power_rotational",
            unit: "mW",
            suffix: "mw",
            factor: 1e3,
            doc: "power taken by rotational drag, Eq. (32)",
            measures: &[Mean],
        },
        Signal {
            name: "current",
            unit: "mA",
            suffix: "ma",
            factor: 1e3,
            doc: "current into the actuator, Eq. (39)",
            measures: &[Rms, Peak],
        },
        Signal {
            name: "power_transduced",
            unit: "mW",
            suffix: "mw",
            factor: 1e3,
            doc: "electrical power without that of charging the capacitance and of the constant part of the voltage",
            measures: &[],
        },
    ];

    const PRINCIPAL: &'static [(usize, Measure)] =
        &[(STROKE, First), (PITCH, First), (LIFT, Mean), (POWER, Mean)];

    const DERIVED: &'static [Derived] = &[
        Derived {
            name: "stroke_lag_deg",
            unit: "deg",
            doc: "phase by which the first harmonic of the stroke lags that of the drive voltage, in (-180, 180]",
        },
        Derived {
            name: "pitch_lag_deg",
            unit: "deg",
            doc: "phase by which the first harmonic of the pitch lags that of the stroke, in (-180, 180]",
        },
        Derived { name: "lift_mean_gf", unit: "gf", doc: "mean lift in grams-force" },
        Derived {
            name: "efficiency_gf_per_w",
            unit: "gf/W",
            doc: "mean lift over mean electrical power (power_mean_mw); empty where that is not more than zero",
        },
        Derived {
            name: "power_capacitive_mw",
            unit: "mW",
            doc: "C V_pp^2 f / 2, the power of charging the actuator's capacitance without recovery",
        },
        Derived {
            name: "energy_audit",
            unit: "",
            doc: "(electrical power by current x voltage - power_mean_mw) / power_mean_mw, zero but for the integration's error",
        },
        Derived {
            name: "strain_surface_max",
            unit: "",
            doc: "largest strain of the piezoelectric layer's outer face, from the bending of the actuator",
        },
        Derived {
            name: "field_max_v_per_um",
            unit: "V/um",
            doc: "largest electric field in the piezoelectric layer",
        },
        Derived {
            name: "mode_1_hz",
            unit: "Hz",
            doc: "lower natural frequency of small motions in still air, without aerodynamic damping",
        },
        Derived { name: "mode_2_hz", unit: "Hz", doc: "upper natural frequency of small motions" },
    ];

    fn variant(&self, values: &[f64]) -> DirectDrive {
        let params = Params::from_values(values);
        DirectDrive {
            source: self.source.of_point(params.drive_shape, params.stroke_mode),
            flow: params.flow_direction,
        }
    }

    fn start(&self, values: &[f64]) -> Result<Start<Constants<f64>, 4>, Invalid> {
        let params = Params::from_values(values);
        self.source.check(params.drive_rise)?;
        let constants = Constants::derive(&params)?;
        let rate = constants.waveform.rate;
        Ok(Start {
            constants,
            y: self.initial_state(&constants),
            span: 1.0 / params.drive_frequency,
            scale: [0.1, 0.3, 0.1 * rate, 0.3 * rate],
            tighten: 1.0,
        })
    }

    fn chirped(&self, c: &Constants<f64>, frequency: f64, rate: f64) -> (DirectDrive, Constants<f64>) {
        (
            DirectDrive { source: self.source.chirped(), flow: self.flow },
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
        drive: &Driven<R>,
        side: R,
        y: &[R; 4],
        dy: &[R; 4],
    ) -> [R; 10] {
        let prescribed = self.source.prescribes_stroke();
        let (y, dy) = if prescribed { (&on_stroke(drive, y), &on_stroke_rates(drive, dy)) } else { (y, dy) };
        let [phi, psi, phi_dot, psi_dot] = *y;
        let (sin, cos) = psi.sin_cos();
        let air = aerodynamics(c, self.flow, side, y, sin, cos);
        let added = added_mass(c, sin, cos, dy);
        // A prescribed stroke knows nothing of what the actuator does.
        let current = if prescribed { phi.lit(f64::NAN) } else { current(c, drive, phi_dot) };
        [
            phi,
            psi,
            lift(c, &air, &added, sin),
            air.lift,
            air.drag,
            current * drive.value,
            -(air.stroke_moment * phi_dot + air.pitch_moment * psi_dot),
            -(air.rotation_moment * psi_dot),
            current,
            (drive.value - c.drive_bias) * (current - c.c_p * drive.rate),
        ]
    }

    fn imposed(&self, c: &Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> ([f64; 4], [f64; 10]) {
        let y = [stroke[0], pitch[0], stroke[1], pitch[1]];
        let dy = [stroke[1], pitch[1], stroke[2], pitch[2]];
        let [velocity, _] = mean_velocity(c, &y, &dy);
        let side = 1.0_f64.copysign(velocity);
        let [value, rate, bend] = stroke;
        let prescribed = DirectDrive { source: Source::PRESCRIBED, ..self.clone() };
        (y, prescribed.signals(c, &Driven { value, rate, bend }, side, &y, &dy))
    }

    fn sampled(&self, samples: Samples) -> DirectDrive {
        DirectDrive { source: self.source.sampled(samples), ..self.clone() }
    }

    /// ⟨Vj⟩ = −⟨M_tr,y φ̇ + (M_tr,x′ + M_rot) ψ̇⟩: but for the air, everything is given back within a period.
    fn on_orbit(&self, cycle: &mut [SignalCycle; 10]) {
        // A prescribed stroke has no electrical power.
        if !cycle[POWER].mean.is_nan() {
            cycle[POWER].mean = cycle[DRAG_POWER].mean + cycle[ROTATION_POWER].mean;
        }
    }

    fn audit(&self, cycle: &[SignalCycle; 10]) -> f64 {
        cycle[POWER].audit(&cycle[TRANSDUCED_POWER])
    }

    fn derived(&self, c: &Constants<f64>, cycle: &[SignalCycle; 10]) -> Vec<f64> {
        // The drive's sine has the phase −π/2 against the cosine.
        let drive_phase = -core::f64::consts::FRAC_PI_2;
        let lift_gf = cycle[LIFT].mean / GRAVITY * 1e3;
        let power = cycle[POWER].mean;
        let frequency = c.waveform.rate / (2.0 * core::f64::consts::PI);
        let [low, high] = if self.source.prescribes_stroke() {
            [f64::NAN; 2]
        } else {
            self.source.range(&c.waveform).map(|wave| c.drive_bias + c.drive_amplitude * wave)
        };
        let voltage_pp = high - low;
        let [mode_1, mode_2] = DirectDrive::linear_modes(c);
        let field_max = high.max(-low) / c.piezo_thickness;
        vec![
            wrap_degrees(drive_phase - cycle[STROKE].phase()),
            wrap_degrees(cycle[STROKE].phase() - cycle[PITCH].phase()),
            lift_gf,
            efficiency(lift_gf, power),
            0.5 * c.c_p * voltage_pp * voltage_pp * frequency * 1e3,
            self.audit(cycle),
            cycle[STROKE].measure(Peak) * c.strain_per_stroke.abs(),
            field_max * 1e-6,
            mode_1,
            mode_2,
        ]
    }

    fn modes(&self, c: &Constants<f64>) -> [Mode; 2] {
        let [lower, upper] = DirectDrive::linear_modes(c);
        [Mode { name: "mode_1", frequency: lower }, Mode { name: "mode_2", frequency: upper }]
    }

    /// At 0 V: `[φ̇, ψ̇] = M(0)⁻¹ [ΓI, 0]`.
    fn released(&self, c: &Constants<f64>, stroke_rate: f64) -> (DirectDrive, Constants<f64>, [f64; 4]) {
        let [_, [m12, m22]] = DirectDrive::mass_at_rest(c);
        let waveform = Waveform { rate: 0.0, ..c.waveform };
        let still = Constants { drive_bias: 0.0, drive_amplitude: 0.0, waveform, ..*c };
        (
            DirectDrive { source: Source::SINE, ..self.clone() },
            still,
            [0.0, 0.0, stroke_rate, -(m12 / m22) * stroke_rate],
        )
    }
}

impl DirectDrive {
    /// At rest; where the stroke is prescribed, on it.
    fn initial_state(&self, c: &Constants<f64>) -> [f64; 4] {
        let rest = [0.0; 4];
        if self.source.prescribes_stroke() { on_stroke(&self.input(c, 0.0), &rest) } else { rest }
    }

    /// Natural frequencies (Hz) of small motions about ψ = 0 with the added mass of still air, the lower first.
    pub fn linear_modes(c: &Constants<f64>) -> [f64; 2] {
        natural_frequencies(DirectDrive::mass_at_rest(c), [c.k_phi, c.k_w])
    }

    /// The mass matrix (kg·m²) at ψ = 0, with the added mass.
    fn mass_at_rest(c: &Constants<f64>) -> [[f64; 2]; 2] {
        let coupling = c.m12 - c.a12;
        [[c.m11 + c.a11, coupling], [coupling, c.m22 + c.a22]]
    }
}
