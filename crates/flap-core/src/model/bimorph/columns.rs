//! Signals of the bimorph model, and the columns computed from them.

use super::constants::Constants;
use super::dynamics::Bimorph;
use crate::model::Measure::{Peak, PeakToPeak, Supply};
use crate::model::OverWings::{Each, Sum};
use crate::model::readings::{efficiency, grams_force, hinge_strain, lag_degrees};
use crate::model::units::DEGREES;
use crate::model::{Derived, Model, SignalCycle, Unit};
use crate::piezo::supplied;

/// Share of the largest lift that a vehicle can hover with, the rest being needed for control; section IV.
const HOVER_SHARE: f64 = 0.8;

crate::signals! {
    /// Signals of the bimorph model.
    pub struct Signals {
        stroke: (Unit::DEG, "stroke angle", [Amplitude, PeakToPeak, Mean, Max, Min, First]) principal First,
        pitch: (Unit::DEG, "hinge angle of the wing", [Amplitude, PeakToPeak, Peak, Mean, Max, Min, First]) principal First,
        lift: (Unit::MN, "lift of the wing", [Mean, Max, Min]) principal Mean of_wings [Mean],
        drag: (Unit::MN, "drag of the wing along the stroke", [Mean, Magnitude]),
        power: (Unit::MW, "electrical power of both plates, current x voltage; its mean is that of power_drag, power_stroke_damping and power_dielectric", [Mean]) principal Mean,
        power_plate_1: (Unit::MW, "electrical power of plate 1", [Supply]),
        power_plate_2: (Unit::MW, "electrical power of plate 2", [Supply]),
        power_mechanical: (Unit::MW, "power of the plates' forces at the actuator's tip; its mean is that of power_drag and power_stroke_damping", [Mean]),
        power_drag: (Unit::MW, "power taken by the drag of the stroke, Eq. (8)", [Mean]),
        power_rotational: (Unit::MW, "power taken by the hinge's rotational drag, Eq. (9)", [Mean]),
        power_stroke_damping: (Unit::MW, "power taken by the damping of the stroke", [Mean]),
        power_hinge_damping: (Unit::MW, "power taken by the damping of the hinge", [Mean]),
        power_dielectric: (Unit::MW, "power taken by the dielectric loss of both plates", [Mean]),
        current_1: (Unit::MA, "current into plate 1", [Rms, Peak]),
        current_2: (Unit::MA, "current into plate 2", [Rms, Peak]),
        force_1: (Unit::MN, "force of plate 1 at the actuator's tip, Eq. (6)", [Peak]),
        force_2: (Unit::MN, "force of plate 2 at the actuator's tip, Eq. (6)", [Peak]),
        power_transduced: (Unit::MW, "electrical power of both plates without that of charging their capacitance", []),
    }
}

type Column = Derived<Bimorph, Constants<f64>, Signals>;

#[rustfmt::skip]
pub(super) const DERIVED: &[Column] = &[
    Column::new("stroke_lag_deg", "deg", "phase by which the first harmonic of the stroke lags the drive -sin(wt), the sense of F_1 - F_2, in (-180, 180]",
        |_, _, cycle| lag_degrees(cycle.stroke.phase(), DRIVE_PHASE)).over_wings(Each),
    Column::new("pitch_lag_deg", "deg", "phase by which the first harmonic of the hinge angle lags that of the stroke, in (-180, 180]",
        |_, _, cycle| lag_degrees(cycle.pitch.phase(), cycle.stroke.phase())).over_wings(Each),
    Column::new("stroke_pp_deg_per_v", "deg/V", "stroke_pp_deg over drive_voltage_pp, the ordinate of Fig. 4a and 5",
        |_, c, cycle| cycle.stroke.measure(PeakToPeak) * DEGREES / (2.0 * c.drive.amplitude)),
    Column::new("tip_pp_um", "um", "displacement of the actuator's tip, largest minus smallest",
        |_, c, cycle| tip_pp(c, cycle) * 1e6).over_wings(Each),
    Column::new("tip_peak_um", "um", "largest displacement of the actuator's tip from rest",
        |_, c, cycle| tip_peak(c, cycle) * 1e6).over_wings(Each),
    Column::new("lift_mean_gf", "gf", "mean lift of the wing in grams-force",
        |_, _, cycle| grams_force(cycle.lift.mean)),
    Column::new("vehicle_lift_mgf", "mgf", "mean lift of a vehicle's two wings in milligrams-force",
        |_, _, cycle| vehicle_lift(cycle)),
    Column::new("payload_mg", "mg", "80 % of vehicle_lift_mgf, the rest being left for control, less vehicle_mass; Table II",
        |_, c, cycle| HOVER_SHARE * vehicle_lift(cycle) - c.vehicle_mass * 1e6),
    Column::new("power_supply_mw", "mW", "mean power of the supply: the positive part of each plate's power, summed, less charge_recovery times what it takes back",
        |_, c, cycle| supplied(positive_power(cycle), cycle.power.mean, c.charge_recovery) * 1e3).over_wings(Sum),
    Column::new("power_capacitive_mw", "mW", "C_act V_pp^2 f / 4: the paper's P, per actuator",
        |model, c, _| capacitive_power(model, c) * 1e3).over_wings(Sum),
    Column::new("efficiency_gf_per_w", "gf/W", "mean lift over mean electrical power (power_mean_mw); empty where that is not more than zero",
        |_, _, cycle| efficiency(grams_force(cycle.lift.mean), cycle.power.mean)),
    Column::new("efficiency_capacitive_gf_per_w", "gf/W", "mean lift over power_capacitive_mw: the paper's lift-to-power ratio, in mg/mW too",
        |model, c, cycle| grams_force(cycle.lift.mean) / capacitive_power(model, c)),
    Column::new("energy_audit", "", "(electrical power by current x voltage - power_mean_mw) / power_mean_mw, zero but for the integration's error",
        |_, _, cycle| Bimorph::energy_audit(cycle)),
    Column::new("strain_mid_max", "", "largest strain of the plates' mid-planes, Eq. (5)",
        |_, c, cycle| tip_peak(c, cycle) * c.strain_per_tip).over_wings(Each),
    Column::new("strain_surface_max", "", "largest strain of the plates' outer faces, which Table II quotes",
        |_, c, cycle| tip_peak(c, cycle) * c.strain_per_tip * c.surface_strain_ratio).over_wings(Each),
    Column::new("hinge_strain_max", "", "largest strain of the hinge's faces, bent to an arc; empty without hinge_thickness and hinge_length",
        |_, c, cycle| hinge_strain(c.hinge_strain, cycle.pitch.measure(Peak))).over_wings(Each),
    Column::new("field_max_v_per_um", "V/um", "largest electric field in the plates",
        |model, c, _| voltage_max(model, c) * c.field_per_volt * 1e-6).over_wings(Each),
    Column::new("mode_stroke_hz", "Hz", "natural frequency of small strokes, without drag",
        |_, c, _| Bimorph::linear_modes(c)[0]),
    Column::new("mode_hinge_hz", "Hz", "natural frequency of small hinge angles, without drag",
        |_, c, _| Bimorph::linear_modes(c)[1]),
];

/// Phase of the drive (rad): F₁ − F₂ goes as −sin ωt, which has the phase π/2 against the cosine.
const DRIVE_PHASE: f64 = core::f64::consts::FRAC_PI_2;

/// Largest displacement of the actuator's tip (m).
fn tip_peak(c: &Constants<f64>, cycle: &Signals<SignalCycle>) -> f64 {
    c.tip(cycle.stroke.measure(Peak))
}

/// Displacement of the actuator's tip, largest minus smallest (m).
fn tip_pp(c: &Constants<f64>, cycle: &Signals<SignalCycle>) -> f64 {
    if c.ratio_growth == 0.0 {
        return cycle.stroke.measure(PeakToPeak) / c.ratio;
    }
    c.tip(cycle.stroke.max) - c.tip(cycle.stroke.min)
}

/// Mean of the positive part of each plate's power (W), summed.
fn positive_power(cycle: &Signals<SignalCycle>) -> f64 {
    [cycle.power_plate_1, cycle.power_plate_2].iter().map(|plate| plate.measure(Supply)).sum()
}

/// Mean lift of two wings in milligrams-force.
fn vehicle_lift(cycle: &Signals<SignalCycle>) -> f64 {
    2e3 * grams_force(cycle.lift.mean)
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
