//! What is measured of the bimorph model, and the columns that come of it.

use super::Bimorph;
use super::constants::Constants;
use super::rhs::secant_stiffness;
use crate::model::Measure::{Amplitude, First, Magnitude, Max, Mean, Min, Peak, PeakToPeak, Rms, Supply};
use crate::model::convert::{DEGREES, GRAVITY, efficiency, wrap_degrees};
use crate::model::{Derived, Measure, Signal, SignalCycle};

/// Number of signals.
pub(super) const S: usize = 15;

/// Share of the largest lift that a vehicle can hover with, the rest being needed for control; section IV.
const HOVER_SHARE: f64 = 0.8;

/// Positions in [`SIGNALS`].
const STROKE: usize = 0;
const PITCH: usize = 1;
const LIFT: usize = 2;
const POWER: usize = 4;
const PLATE_POWERS: [usize; 2] = [5, 6];
const MECHANICAL_POWER: usize = 7;
const DRAG_POWER: usize = 8;
const TRANSDUCED_POWER: usize = 14;

const fn signal(
    name: &'static str,
    (unit, suffix, factor): (&'static str, &'static str, f64),
    doc: &'static str,
    measures: &'static [Measure],
) -> Signal {
    Signal { name, unit, suffix, factor, doc, measures }
}

const ANGLE: (&str, &str, f64) = ("deg", "deg", DEGREES);
const FORCE: (&str, &str, f64) = ("mN", "mn", 1e3);
const POWER_UNIT: (&str, &str, f64) = ("mW", "mw", 1e3);
const CURRENT: (&str, &str, f64) = ("mA", "ma", 1e3);

#[rustfmt::skip]
pub(super) const SIGNALS: [Signal; S] = [
    signal("stroke", ANGLE, "stroke angle", &[Amplitude, PeakToPeak, Mean, Max, Min, First]),
    signal("pitch", ANGLE, "hinge angle of the wing", &[Amplitude, Peak, Mean, Max, Min, First]),
    signal("lift", FORCE, "lift of the wing", &[Mean, Max, Min]),
    signal("drag", FORCE, "drag of the wing along the stroke", &[Mean, Magnitude]),
    signal("power", POWER_UNIT, "electrical power of both plates, current x voltage; its mean is that of power_drag", &[Mean]),
    signal("power_plate_1", POWER_UNIT, "electrical power of plate 1", &[Supply]),
    signal("power_plate_2", POWER_UNIT, "electrical power of plate 2", &[Supply]),
    signal("power_mechanical", POWER_UNIT, "power of the plates' forces at the actuator's tip; its mean is that of power_drag", &[Mean]),
    signal("power_drag", POWER_UNIT, "power taken by the drag of the stroke, Eq. (8)", &[Mean]),
    signal("power_rotational", POWER_UNIT, "power taken by the hinge's rotational drag, Eq. (9)", &[Mean]),
    signal("current_1", CURRENT, "current into plate 1", &[Rms, Peak]),
    signal("current_2", CURRENT, "current into plate 2", &[Rms, Peak]),
    signal("force_1", FORCE, "force of plate 1 at the actuator's tip, Eq. (6)", &[Peak]),
    signal("force_2", FORCE, "force of plate 2 at the actuator's tip, Eq. (6)", &[Peak]),
    signal("power_transduced", POWER_UNIT, "electrical power of both plates without that of charging their capacitance", &[]),
];

pub(super) const PRINCIPAL: &[(usize, Measure)] =
    &[(STROKE, First), (PITCH, First), (LIFT, Mean), (POWER, Mean)];

const fn derived(name: &'static str, unit: &'static str, doc: &'static str) -> Derived {
    Derived { name, unit, doc }
}

#[rustfmt::skip]
pub(super) const DERIVED: &[Derived] = &[
    derived("stroke_lag_deg", "deg", "phase by which the first harmonic of the stroke lags the drive -sin(wt), the sense of F_1 - F_2, in (-180, 180]"),
    derived("pitch_lag_deg", "deg", "phase by which the first harmonic of the hinge angle lags that of the stroke, in (-180, 180]"),
    derived("stroke_pp_deg_per_v", "deg/V", "stroke_pp_deg over drive_voltage_pp, the ordinate of Fig. 4a and 5"),
    derived("tip_pp_um", "um", "displacement of the actuator's tip, largest minus smallest"),
    derived("tip_peak_um", "um", "largest displacement of the actuator's tip from rest"),
    derived("lift_mean_gf", "gf", "mean lift of the wing in grams-force"),
    derived("vehicle_lift_mgf", "mgf", "mean lift of a vehicle's two wings in milligrams-force"),
    derived("payload_mg", "mg", "80 % of vehicle_lift_mgf, the rest being left for control, less vehicle_mass; Table II"),
    derived("power_supply_mw", "mW", "mean of the positive part of each plate's power, summed: no recovery"),
    derived("power_capacitive_mw", "mW", "C_act V_pp^2 f / 4: the paper's P, per actuator"),
    derived("efficiency_gf_per_w", "gf/W", "mean lift over mean electrical power (power_mean_mw); empty where that is not more than zero"),
    derived("efficiency_capacitive_gf_per_w", "gf/W", "mean lift over power_capacitive_mw: the paper's lift-to-power ratio, in mg/mW too"),
    derived("energy_audit", "", "(electrical power by current x voltage - power_mean_mw) / power_mean_mw, zero but for the integration's error"),
    derived("strain_mid_max", "", "largest strain of the plates' mid-planes, Eq. (5)"),
    derived("strain_surface_max", "", "largest strain of the plates' outer faces, which Table II quotes"),
    derived("field_max_v_per_um", "V/um", "largest electric field in the plates"),
    derived("mode_stroke_hz", "Hz", "natural frequency of small strokes, without drag"),
    derived("mode_hinge_hz", "Hz", "natural frequency of small hinge angles, without drag"),
];

/// ⟨V₁i₁ + V₂i₂⟩ = ⟨(F₁ − F₂) ẋ⟩ = ⟨power of the stroke's drag⟩: (1) has no other loss.
pub(super) fn on_orbit(cycle: &mut [SignalCycle; S]) {
    for power in [POWER, MECHANICAL_POWER] {
        cycle[power].mean = cycle[DRAG_POWER].mean;
    }
}

/// By current times voltage against the drag's.
pub(super) fn audit(cycle: &[SignalCycle; S]) -> f64 {
    cycle[POWER].audit(&cycle[TRANSDUCED_POWER])
}

/// The values of [`DERIVED`], for a wave that goes from `low` to `high`.
pub(super) fn values(c: &Constants<f64>, [low, high]: [f64; 2], cycle: &[SignalCycle; S]) -> Vec<f64> {
    // F₁ − F₂ goes as −sin ωt, which has the phase π/2 against the cosine.
    let drive_phase = core::f64::consts::FRAC_PI_2;
    let stroke = &cycle[STROKE];
    // The plates see ½V_pp (1 ± wave).
    let voltage_pp = c.half_voltage * (high - low);
    let voltage_max = c.half_voltage * (1.0 + high.max(-low));
    let tip_peak = stroke.measure(Peak) / c.ratio;
    let stroke_pp = stroke.measure(PeakToPeak);
    let lift_gf = cycle[LIFT].mean / GRAVITY * 1e3;
    let vehicle_lift = 2e3 * lift_gf;
    let power = cycle[POWER].mean;
    let supply: f64 = PLATE_POWERS.iter().map(|&plate| cycle[plate].measure(Supply)).sum();
    let capacitive = c.c_p * voltage_pp * voltage_pp * c.waveform.rate / (2.0 * core::f64::consts::PI);
    let [mode_stroke, mode_hinge] = Bimorph::linear_modes(c);
    vec![
        wrap_degrees(drive_phase - stroke.phase()),
        wrap_degrees(stroke.phase() - cycle[PITCH].phase()),
        stroke_pp * DEGREES / (2.0 * c.half_voltage),
        stroke_pp / c.ratio * 1e6,
        tip_peak * 1e6,
        lift_gf,
        vehicle_lift,
        HOVER_SHARE * vehicle_lift - c.vehicle_mass * 1e6,
        supply * 1e3,
        capacitive * 1e3,
        efficiency(lift_gf, power),
        lift_gf / capacitive,
        audit(cycle),
        tip_peak * c.strain_per_tip,
        tip_peak * c.strain_per_tip * c.surface_strain_ratio,
        voltage_max * c.field_per_volt * 1e-6,
        mode_stroke,
        mode_hinge,
    ]
}

impl Bimorph {
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
