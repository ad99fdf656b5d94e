//! Signals of the bimorph model, and the columns computed from them.

use super::constants::Constants;
use super::dynamics::Bimorph;
use crate::model::Measure::{Amplitude, First, Magnitude, Max, Mean, Min, Peak, PeakToPeak, Rms, Supply};
use crate::model::readings::{efficiency, grams_force, hinge_strain, lag_degrees};
use crate::model::units::DEGREES;
use crate::model::{Derived, EnergyBalance, Principal, Signal, SignalCycle, Unit, position};
use crate::piezo::supplied;

/// Number of signals.
pub const S: usize = 18;

/// Share of the largest lift that a vehicle can hover with, the rest being needed for control; section IV.
const HOVER_SHARE: f64 = 0.8;

const STROKE: usize = position(&SIGNALS, "stroke");
const PITCH: usize = position(&SIGNALS, "pitch");
const LIFT: usize = position(&SIGNALS, "lift");
const POWER: usize = position(&SIGNALS, "power");
const PLATE_POWERS: [usize; 2] = [position(&SIGNALS, "power_plate_1"), position(&SIGNALS, "power_plate_2")];
const MECHANICAL_POWER: usize = position(&SIGNALS, "power_mechanical");
const DRAG_POWER: usize = position(&SIGNALS, "power_drag");
const DAMPING_POWER: usize = position(&SIGNALS, "power_stroke_damping");
const DIELECTRIC_POWER: usize = position(&SIGNALS, "power_dielectric");
const TRANSDUCED_POWER: usize = position(&SIGNALS, "power_transduced");

#[rustfmt::skip]
pub(super) const SIGNALS: [Signal; S] = [
    Signal::new("stroke", Unit::DEG, "stroke angle", &[Amplitude, PeakToPeak, Mean, Max, Min, First]).principal(Principal::First),
    Signal::new("pitch", Unit::DEG, "hinge angle of the wing", &[Amplitude, PeakToPeak, Peak, Mean, Max, Min, First]).principal(Principal::First),
    Signal::new("lift", Unit::MN, "lift of the wing", &[Mean, Max, Min]).principal(Principal::Mean),
    Signal::new("drag", Unit::MN, "drag of the wing along the stroke", &[Mean, Magnitude]),
    Signal::new("power", Unit::MW, "electrical power of both plates, current x voltage; its mean is that of power_drag, power_stroke_damping and power_dielectric", &[Mean]).principal(Principal::Mean),
    Signal::new("power_plate_1", Unit::MW, "electrical power of plate 1", &[Supply]),
    Signal::new("power_plate_2", Unit::MW, "electrical power of plate 2", &[Supply]),
    Signal::new("power_mechanical", Unit::MW, "power of the plates' forces at the actuator's tip; its mean is that of power_drag and power_stroke_damping", &[Mean]),
    Signal::new("power_drag", Unit::MW, "power taken by the drag of the stroke, Eq. (8)", &[Mean]),
    Signal::new("power_rotational", Unit::MW, "power taken by the hinge's rotational drag, Eq. (9)", &[Mean]),
    Signal::new("power_stroke_damping", Unit::MW, "power taken by the damping of the stroke", &[Mean]),
    Signal::new("power_hinge_damping", Unit::MW, "power taken by the damping of the hinge", &[Mean]),
    Signal::new("power_dielectric", Unit::MW, "power taken by the dielectric loss of both plates", &[Mean]),
    Signal::new("current_1", Unit::MA, "current into plate 1", &[Rms, Peak]),
    Signal::new("current_2", Unit::MA, "current into plate 2", &[Rms, Peak]),
    Signal::new("force_1", Unit::MN, "force of plate 1 at the actuator's tip, Eq. (6)", &[Peak]),
    Signal::new("force_2", Unit::MN, "force of plate 2 at the actuator's tip, Eq. (6)", &[Peak]),
    Signal::new("power_transduced", Unit::MW, "electrical power of both plates without that of charging their capacitance", &[]),
];

/// ⟨V₁i₁ + V₂i₂⟩ − ⟨dielectric loss⟩ = ⟨(F₁ − F₂) ẋ⟩ = ⟨power of the stroke's drag and damping⟩: (1) has no other loss.
pub(super) const ENERGY: EnergyBalance = EnergyBalance {
    powers: &[
        (POWER, &[DRAG_POWER, DAMPING_POWER, DIELECTRIC_POWER]),
        (MECHANICAL_POWER, &[DRAG_POWER, DAMPING_POWER]),
    ],
    audit: [POWER, TRANSDUCED_POWER],
};

type Column = Derived<Bimorph, Constants<f64>, S>;

#[rustfmt::skip]
pub(super) const DERIVED: &[Column] = &[
    Column::new("stroke_lag_deg", "deg", "phase by which the first harmonic of the stroke lags the drive -sin(wt), the sense of F_1 - F_2, in (-180, 180]",
        |_, _, cycle| lag_degrees(cycle[STROKE].phase(), DRIVE_PHASE)),
    Column::new("pitch_lag_deg", "deg", "phase by which the first harmonic of the hinge angle lags that of the stroke, in (-180, 180]",
        |_, _, cycle| lag_degrees(cycle[PITCH].phase(), cycle[STROKE].phase())),
    Column::new("stroke_pp_deg_per_v", "deg/V", "stroke_pp_deg over drive_voltage_pp, the ordinate of Fig. 4a and 5",
        |_, c, cycle| cycle[STROKE].measure(PeakToPeak) * DEGREES / (2.0 * c.drive.amplitude)),
    Column::new("tip_pp_um", "um", "displacement of the actuator's tip, largest minus smallest",
        |_, c, cycle| tip_pp(c, cycle) * 1e6),
    Column::new("tip_peak_um", "um", "largest displacement of the actuator's tip from rest",
        |_, c, cycle| tip_peak(c, cycle) * 1e6),
    Column::new("lift_mean_gf", "gf", "mean lift of the wing in grams-force",
        |_, _, cycle| grams_force(cycle[LIFT].mean)),
    Column::new("vehicle_lift_mgf", "mgf", "mean lift of a vehicle's two wings in milligrams-force",
        |_, _, cycle| vehicle_lift(cycle)),
    Column::new("payload_mg", "mg", "80 % of vehicle_lift_mgf, the rest being left for control, less vehicle_mass; Table II",
        |_, c, cycle| HOVER_SHARE * vehicle_lift(cycle) - c.vehicle_mass * 1e6),
    Column::new("power_supply_mw", "mW", "mean power of the supply: the positive part of each plate's power, summed, less charge_recovery times what it takes back",
        |_, c, cycle| supplied(positive_power(cycle), cycle[POWER].mean, c.charge_recovery) * 1e3),
    Column::new("power_capacitive_mw", "mW", "C_act V_pp^2 f / 4: the paper's P, per actuator",
        |model, c, _| capacitive_power(model, c) * 1e3),
    Column::new("efficiency_gf_per_w", "gf/W", "mean lift over mean electrical power (power_mean_mw); empty where that is not more than zero",
        |_, _, cycle| efficiency(grams_force(cycle[LIFT].mean), cycle[POWER].mean)),
    Column::new("efficiency_capacitive_gf_per_w", "gf/W", "mean lift over power_capacitive_mw: the paper's lift-to-power ratio, in mg/mW too",
        |model, c, cycle| grams_force(cycle[LIFT].mean) / capacitive_power(model, c)),
    Column::new("energy_audit", "", "(electrical power by current x voltage - power_mean_mw) / power_mean_mw, zero but for the integration's error",
        |_, _, cycle| ENERGY.audit(cycle)),
    Column::new("strain_mid_max", "", "largest strain of the plates' mid-planes, Eq. (5)",
        |_, c, cycle| tip_peak(c, cycle) * c.strain_per_tip),
    Column::new("strain_surface_max", "", "largest strain of the plates' outer faces, which Table II quotes",
        |_, c, cycle| tip_peak(c, cycle) * c.strain_per_tip * c.surface_strain_ratio),
    Column::new("hinge_strain_max", "", "largest strain of the hinge's faces, bent to an arc; empty without hinge_thickness and hinge_length",
        |_, c, cycle| hinge_strain(c.hinge_strain, cycle[PITCH].measure(Peak))),
    Column::new("field_max_v_per_um", "V/um", "largest electric field in the plates",
        |model, c, _| voltage_max(model, c) * c.field_per_volt * 1e-6),
    Column::new("mode_stroke_hz", "Hz", "natural frequency of small strokes, without drag",
        |_, c, _| Bimorph::linear_modes(c)[0]),
    Column::new("mode_hinge_hz", "Hz", "natural frequency of small hinge angles, without drag",
        |_, c, _| Bimorph::linear_modes(c)[1]),
];

/// Phase of the drive (rad): F₁ − F₂ goes as −sin ωt, which has the phase π/2 against the cosine.
const DRIVE_PHASE: f64 = core::f64::consts::FRAC_PI_2;

/// Largest displacement of the actuator's tip (m).
fn tip_peak(c: &Constants<f64>, cycle: &[SignalCycle; S]) -> f64 {
    c.tip(cycle[STROKE].measure(Peak))
}

/// Displacement of the actuator's tip, largest minus smallest (m).
fn tip_pp(c: &Constants<f64>, cycle: &[SignalCycle; S]) -> f64 {
    if c.ratio_growth == 0.0 {
        return cycle[STROKE].measure(PeakToPeak) / c.ratio;
    }
    c.tip(cycle[STROKE].max) - c.tip(cycle[STROKE].min)
}

/// Mean of the positive part of each plate's power (W), summed.
fn positive_power(cycle: &[SignalCycle; S]) -> f64 {
    PLATE_POWERS.iter().map(|&plate| cycle[plate].measure(Supply)).sum()
}

/// Mean lift of two wings in milligrams-force.
fn vehicle_lift(cycle: &[SignalCycle; S]) -> f64 {
    2e3 * grams_force(cycle[LIFT].mean)
}

/// Power (W) of charging two plates, which see ½V_pp (1 ± wave).
fn capacitive_power(model: &Bimorph, c: &Constants<f64>) -> f64 {
    let [low, high] = model.drive.range(&c.drive);
    let voltage_pp = c.drive.amplitude * (high - low);
    c.c_p * voltage_pp * voltage_pp * c.drive.rate / (2.0 * core::f64::consts::PI)
}

/// Largest voltage (V) on a plate.
fn voltage_max(model: &Bimorph, c: &Constants<f64>) -> f64 {
    let [low, high] = model.drive.range(&c.drive);
    let (bias, offset) = (c.drive.amplitude, c.half_offset);
    let plates = [
        bias * (1.0 - low) + offset,
        bias * (1.0 - high) + offset,
        bias * (1.0 + low) - offset,
        bias * (1.0 + high) - offset,
    ];
    plates.into_iter().map(f64::abs).fold(0.0, f64::max)
}
