//! Signals of the direct-drive model, and the columns computed from them.

use super::constants::Constants;
use super::dynamics::DirectDrive;
use crate::model::Measure::{Amplitude, First, Magnitude, Max, Mean, Min, Peak, PeakToPeak, Rms, Supply};
use crate::model::readings::{SINE_PHASE, charging, efficiency, grams_force, hinge_strain, lag_degrees};
use crate::model::{Derived, EnergyBalance, Principal, Signal, Unit, position};
use crate::piezo::supplied;

/// Number of signals.
pub const S: usize = 13;

const STROKE: usize = position(&SIGNALS, "stroke");
const PITCH: usize = position(&SIGNALS, "pitch");
const LIFT: usize = position(&SIGNALS, "lift");
const POWER: usize = position(&SIGNALS, "power");
const DRAG_POWER: usize = position(&SIGNALS, "power_translational");
const ROTATION_POWER: usize = position(&SIGNALS, "power_rotational");
const TRANSDUCED_POWER: usize = position(&SIGNALS, "power_transduced");

#[rustfmt::skip]
pub(super) const SIGNALS: [Signal; S] = [
    Signal::new("stroke", Unit::DEG, "stroke angle", &[Amplitude, PeakToPeak, Mean, Max, Min, First]).principal(Principal::First),
    Signal::new("pitch", Unit::DEG, "pitch angle of the wing on its hinge", &[Amplitude, PeakToPeak, Peak, Mean, Max, Min, First]).principal(Principal::First),
    Signal::new("lift", Unit::MN, "lift of the wing, Eq. (35)", &[Mean, Max, Min]).principal(Principal::Mean),
    Signal::new("lift_translational", Unit::MN, "lift without the part of the added mass, Eq. (21)", &[Mean]),
    Signal::new("drag", Unit::MN, "translational drag along the stroke, Eq. (21)", &[Magnitude]),
    Signal::new("power", Unit::MW, "electrical power current x voltage, Eq. (40); its mean is that of what the air, damping and dielectric take", &[Mean]).principal(Principal::Mean).needs(&[Supply]),
    Signal::new("power_translational", Unit::MW, "power taken by translational aerodynamics", &[Mean]),
    Signal::new("power_rotational", Unit::MW, "power taken by rotational drag, Eq. (32)", &[Mean]),
    Signal::new("power_stroke_damping", Unit::MW, "power taken by the damping of the stroke", &[Mean]),
    Signal::new("power_hinge_damping", Unit::MW, "power taken by the damping of the hinge", &[Mean]),
    Signal::new("power_dielectric", Unit::MW, "power taken by the dielectric loss", &[Mean]),
    Signal::new("current", Unit::MA, "current into the actuator, Eq. (39)", &[Rms, Peak]),
    Signal::new("power_transduced", Unit::MW, "electrical power without that of charging the capacitance and of the constant part of the voltage", &[]),
];

/// ⟨Vj⟩ = −⟨M_tr,y φ̇ + (M_tr,x′ + M_rot) ψ̇⟩ + ⟨damping⟩ + ⟨dielectric loss⟩: all else is given back within a period.
pub(super) const ENERGY: EnergyBalance = EnergyBalance {
    powers: &[(
        POWER,
        &[
            DRAG_POWER,
            ROTATION_POWER,
            position(&SIGNALS, "power_stroke_damping"),
            position(&SIGNALS, "power_hinge_damping"),
            position(&SIGNALS, "power_dielectric"),
        ],
    )],
    audit: [POWER, TRANSDUCED_POWER],
};

type Column = Derived<DirectDrive, Constants<f64>, S>;

#[rustfmt::skip]
pub(super) const DERIVED: &[Column] = &[
    Column::new("stroke_lag_deg", "deg", "phase by which the first harmonic of the stroke lags that of the drive voltage, in (-180, 180]",
        |_, _, cycle| lag_degrees(cycle[STROKE].phase(), SINE_PHASE)),
    Column::new("pitch_lag_deg", "deg", "phase by which the first harmonic of the pitch lags that of the stroke, in (-180, 180]",
        |_, _, cycle| lag_degrees(cycle[PITCH].phase(), cycle[STROKE].phase())),
    Column::new("lift_mean_gf", "gf", "mean lift in grams-force",
        |_, _, cycle| grams_force(cycle[LIFT].mean)),
    Column::new("efficiency_gf_per_w", "gf/W", "mean lift over mean electrical power (power_mean_mw); empty where that is not more than zero",
        |_, _, cycle| efficiency(grams_force(cycle[LIFT].mean), cycle[POWER].mean)),
    Column::new("power_supply_mw", "mW", "mean power of the supply: that of the positive part, less charge_recovery times what it takes back",
        |_, c, cycle| supplied(cycle[POWER].measure(Supply), cycle[POWER].mean, c.charge_recovery) * 1e3),
    Column::new("power_capacitive_mw", "mW", "C V_pp^2 f / 2, the power of charging the actuator's capacitance without recovery",
        |model, c, _| charging(c.c_p, model.drive.voltage_range(&c.drive), c.drive.frequency()) * 1e3),
    Column::new("energy_audit", "", "(electrical power by current x voltage - power_mean_mw) / power_mean_mw, zero but for the integration's error",
        |_, _, cycle| ENERGY.audit(cycle)),
    Column::new("strain_surface_max", "", "largest strain of the piezoelectric layer's outer face, from the bending of the actuator",
        |_, c, cycle| cycle[STROKE].measure(Peak) * c.strain_per_stroke.abs()),
    Column::new("hinge_strain_max", "", "largest strain of the hinge's faces, bent to an arc; empty without hinge_thickness and hinge_length",
        |_, c, cycle| hinge_strain(c.hinge_strain, cycle[PITCH].measure(Peak))),
    Column::new("field_max_v_per_um", "V/um", "largest electric field in the piezoelectric layer",
        |model, c, _| model.drive.largest_voltage(&c.drive) / c.piezo_thickness * 1e-6),
    Column::new("mode_1_hz", "Hz", "lower natural frequency of small motions in still air, without aerodynamic damping",
        |_, c, _| DirectDrive::linear_modes(c)[0]),
    Column::new("mode_2_hz", "Hz", "upper natural frequency of small motions",
        |_, c, _| DirectDrive::linear_modes(c)[1]),
];
