//! Signals of the four-bar model, and the columns computed from them.

use super::constants::Constants;
use super::dynamics::FourBar;
use crate::model::Measure::{Amplitude, First, Magnitude, Max, Mean, Min, Peak, PeakToPeak, Rms, Supply};
use crate::model::readings::{SINE_PHASE, charging, efficiency, grams_force, hinge_strain, lag_degrees};
use crate::model::{Derived, EnergyBalance, Principal, Signal, Unit, position};
use crate::piezo::supplied;

/// Number of signals.
pub const S: usize = 18;

const STROKE: usize = position(&SIGNALS, "stroke");
const PITCH: usize = position(&SIGNALS, "pitch");
const LIFT: usize = position(&SIGNALS, "lift");
const DRIVE_POWER: usize = position(&SIGNALS, "power_drive");
const POWER: usize = position(&SIGNALS, "power");
const TRANSDUCED_POWER: usize = position(&SIGNALS, "power_transduced");
const DRIVING_POWER: usize = position(&SIGNALS, "power_driving");

#[rustfmt::skip]
pub(super) const SIGNALS: [Signal; S] = [
    Signal::new("stroke", Unit::DEG, "stroke angle", &[Amplitude, PeakToPeak, Mean, Max, Min, First]).principal(Principal::First),
    Signal::new("pitch", Unit::DEG, "pitch angle of the wing on its hinge", &[Amplitude, PeakToPeak, Peak, Mean, Max, Min, First]).principal(Principal::First),
    Signal::new("lift", Unit::MN, "lift of the wing, Eq. (4)", &[Mean, Max, Min]).principal(Principal::Mean),
    Signal::new("lift_translational", Unit::MN, "lift of the wing's translation, Eq. (5)", &[Mean]),
    Signal::new("lift_rotational", Unit::MN, "lift of the wing's rotation, Eq. (6)", &[Mean]),
    Signal::new("lift_added_mass", Unit::MN, "lift of the added mass, Eq. (7)", &[Mean]),
    Signal::new("drag", Unit::MN, "translational drag along the stroke, Eq. (5)", &[Magnitude]),
    Signal::new("power_drive", Unit::MW, "mechanical power of the actuator on the stroke; its mean is the sum of the four that follow", &[Mean]),
    Signal::new("power_stroke_damping", Unit::MW, "power taken by the damping of the stroke", &[Mean]),
    Signal::new("power_hinge_damping", Unit::MW, "power taken by the damping of the hinge", &[Mean]),
    Signal::new("power_translational", Unit::MW, "power taken by translational aerodynamics", &[Mean]),
    Signal::new("power_rotational", Unit::MW, "power taken by rotational drag, Eqs. (6) and (18)", &[Mean]),
    Signal::new("power", Unit::MW, "electrical power current x voltage (not in the paper); its mean is that of power_drive and power_dielectric", &[Mean]).principal(Principal::Mean).needs(&[Supply]),
    Signal::new("power_dielectric", Unit::MW, "power taken by the dielectric loss", &[Mean]),
    Signal::new("current", Unit::MA, "current into the actuator (not in the paper)", &[Rms, Peak]),
    Signal::new("tip", Unit::UM, "displacement of the actuator's tip", &[PeakToPeak, Peak]),
    Signal::new("power_transduced", Unit::MW, "electrical power without that of charging capacitances and of the constant part of the voltage", &[]),
    Signal::new("power_driving", Unit::MW, "mechanical power of the actuator without that of its stiffness", &[]),
];

const STROKE_DAMPING: usize = position(&SIGNALS, "power_stroke_damping");
const HINGE_DAMPING: usize = position(&SIGNALS, "power_hinge_damping");
const TRANSLATIONAL: usize = position(&SIGNALS, "power_translational");
const ROTATIONAL: usize = position(&SIGNALS, "power_rotational");
const DIELECTRIC: usize = position(&SIGNALS, "power_dielectric");

/// ⟨Vi⟩ − ⟨dielectric loss⟩ = ⟨F δ̇⟩ = the power that damping and air take: actuator, springs and inertia give back everything
/// within a period.
pub(super) const ENERGY: EnergyBalance = EnergyBalance {
    powers: &[
        (DRIVE_POWER, &[STROKE_DAMPING, HINGE_DAMPING, TRANSLATIONAL, ROTATIONAL]),
        (POWER, &[STROKE_DAMPING, HINGE_DAMPING, TRANSLATIONAL, ROTATIONAL, DIELECTRIC]),
    ],
    audit: [DRIVE_POWER, DRIVING_POWER],
};

type Column = Derived<FourBar, Constants<f64>, S>;

#[rustfmt::skip]
pub(super) const DERIVED: &[Column] = &[
    Column::new("stroke_lag_deg", "deg", "phase by which the first harmonic of the stroke lags that of the drive voltage, in (-180, 180]",
        |_, _, cycle| lag_degrees(cycle[STROKE].phase(), SINE_PHASE)),
    Column::new("pitch_lag_deg", "deg", "phase by which the first harmonic of the pitch lags that of the stroke, in (-180, 180]: the paper's phase shift",
        |_, _, cycle| lag_degrees(cycle[PITCH].phase(), cycle[STROKE].phase())),
    Column::new("lift_mean_gf", "gf", "mean lift in grams-force",
        |_, _, cycle| grams_force(cycle[LIFT].mean)),
    Column::new("efficiency_gf_per_w", "gf/W", "mean lift over mean electrical power (power_mean_mw)",
        |_, _, cycle| efficiency(grams_force(cycle[LIFT].mean), cycle[POWER].mean)),
    Column::new("power_supply_mw", "mW", "mean power of the supply: that of the positive part, less charge_recovery times what it takes back",
        |_, c, cycle| supplied(cycle[POWER].measure(Supply), cycle[POWER].mean, c.actuator.charge_recovery) * 1e3),
    Column::new("power_capacitive_mw", "mW", "C V_pp^2 f / 2, the power of charging the blocked actuator's capacitance without recovery",
        |model, c, _| {
            charging(c.actuator.capacitance, model.drive.voltage_range(&c.drive), c.drive.frequency()) * 1e3
        }),
    Column::new("energy_audit", "", "(power of the actuator's force - power_drive_mean_mw) / power_drive_mean_mw, zero but for the integration's error",
        |_, _, cycle| ENERGY.audit(cycle)),
    Column::new("electrical_audit", "", "(electrical power by current x voltage - power_mean_mw) / power_mean_mw, zero but for the integration's error",
        |_, _, cycle| cycle[POWER].audit(&cycle[TRANSDUCED_POWER])),
    Column::new("hinge_strain_max", "", "largest strain of the hinge's faces, bent to an arc; empty without hinge_thickness and hinge_length",
        |_, c, cycle| hinge_strain(c.wing.hinge_strain, cycle[PITCH].measure(Peak))),
    Column::new("field_max_v_per_um", "V/um", "largest electric field in the piezoelectric layer",
        |model, c, _| model.drive.largest_voltage(&c.drive) / c.actuator.piezo_thickness * 1e-6),
    Column::new("mode_1_hz", "Hz", "lower natural frequency of small undamped motions, with the added mass of still air",
        |_, c, _| FourBar::linear_modes(c)[0]),
    Column::new("mode_2_hz", "Hz", "upper natural frequency of small undamped motions",
        |_, c, _| FourBar::linear_modes(c)[1]),
];
