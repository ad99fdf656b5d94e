//! Signals of the four-bar model, and the columns computed from them.

use super::constants::Constants;
use super::dynamics::FourBar;
use crate::model::Measure::{Peak, Supply};
use crate::model::OverWings::{Each, Sum};
use crate::model::readings::{SINE_PHASE, charging, efficiency, grams_force, hinge_strain, lag_degrees};
use crate::model::{Derived, Model, Unit};
use crate::piezo::supplied;

crate::signals! {
    /// Signals of the four-bar model.
    pub struct Signals {
        stroke: (Unit::DEG, "stroke angle", [Amplitude, PeakToPeak, Mean, Max, Min, First]) principal First,
        pitch: (Unit::DEG, "pitch angle of the wing on its hinge", [Amplitude, PeakToPeak, Peak, Mean, Max, Min, First]) principal First,
        lift: (Unit::MN, "lift of the wing, Eq. (4)", [Mean, Max, Min]) principal Mean of_wings [Mean],
        lift_translational: (Unit::MN, "lift of the wing's translation, Eq. (5)", [Mean]),
        lift_rotational: (Unit::MN, "lift of the wing's rotation, Eq. (6)", [Mean]),
        lift_added_mass: (Unit::MN, "lift of the added mass, Eq. (7)", [Mean]),
        drag: (Unit::MN, "translational drag along the stroke, Eq. (5)", [Magnitude]),
        power_drive: (Unit::MW, "mechanical power of the actuator on the stroke; its mean is the sum of the four that follow", [Mean]),
        power_stroke_damping: (Unit::MW, "power taken by the damping of the stroke", [Mean]),
        power_hinge_damping: (Unit::MW, "power taken by the damping of the hinge", [Mean]),
        power_translational: (Unit::MW, "power taken by translational aerodynamics", [Mean]),
        power_rotational: (Unit::MW, "power taken by rotational drag, Eqs. (6) and (18)", [Mean]),
        power: (Unit::MW, "electrical power current x voltage (not in the paper); its mean is that of power_drive and power_dielectric", [Mean]) principal Mean needs [Supply],
        power_dielectric: (Unit::MW, "power taken by the dielectric loss", [Mean]),
        current: (Unit::MA, "current into the actuator (not in the paper)", [Rms, Peak]),
        tip: (Unit::UM, "displacement of the actuator's tip", [PeakToPeak, Peak]),
        power_transduced: (Unit::MW, "electrical power without that of charging capacitances and of the constant part of the voltage", []),
        power_driving: (Unit::MW, "mechanical power of the actuator without that of its stiffness", []),
    }
}

type Column = Derived<FourBar, Constants<f64>, Signals>;

#[rustfmt::skip]
pub(super) const DERIVED: &[Column] = &[
    Column::new("stroke_lag_deg", "deg", "phase by which the first harmonic of the stroke lags that of the drive voltage, in (-180, 180]",
        |_, _, cycle| lag_degrees(cycle.stroke.phase(), SINE_PHASE)).over_wings(Each),
    Column::new("pitch_lag_deg", "deg", "phase by which the first harmonic of the pitch lags that of the stroke, in (-180, 180]: the paper's phase shift",
        |_, _, cycle| lag_degrees(cycle.pitch.phase(), cycle.stroke.phase())).over_wings(Each),
    Column::new("lift_mean_gf", "gf", "mean lift in grams-force",
        |_, _, cycle| grams_force(cycle.lift.mean)),
    Column::new("efficiency_gf_per_w", "gf/W", "mean lift over mean electrical power (power_mean_mw)",
        |_, _, cycle| efficiency(grams_force(cycle.lift.mean), cycle.power.mean)),
    Column::new("power_supply_mw", "mW", "mean power of the supply: that of the positive part, less charge_recovery times what it takes back",
        |_, c, cycle| supplied(cycle.power.measure(Supply), cycle.power.mean, c.actuator.charge_recovery) * 1e3).over_wings(Sum),
    Column::new("power_capacitive_mw", "mW", "C V_pp^2 f / 2, the power of charging the blocked actuator's capacitance without recovery",
        |model, c, _| {
            charging(c.actuator.capacitance, model.drive.voltage_range(&c.drive), c.drive.frequency()) * 1e3
        }).over_wings(Sum),
    Column::new("energy_audit", "", "(power of the actuator's force - power_drive_mean_mw) / power_drive_mean_mw, zero but for the integration's error",
        |_, _, cycle| FourBar::energy_audit(cycle)),
    Column::new("electrical_audit", "", "(electrical power by current x voltage - power_mean_mw) / power_mean_mw, zero but for the integration's error",
        |_, _, cycle| cycle.power.audit(&cycle.power_transduced)),
    Column::new("hinge_strain_max", "", "largest strain of the hinge's faces, bent to an arc; empty without hinge_thickness and hinge_length",
        |_, c, cycle| hinge_strain(c.wing.hinge_strain, cycle.pitch.measure(Peak))).over_wings(Each),
    Column::new("field_max_v_per_um", "V/um", "largest electric field in the piezoelectric layer",
        |model, c, _| model.drive.largest_voltage(&c.drive) / c.actuator.piezo_thickness * 1e-6).over_wings(Each),
    Column::new("mode_1_hz", "Hz", "lower natural frequency of small undamped motions, with the added mass of still air",
        |_, c, _| FourBar::linear_modes(c)[0]),
    Column::new("mode_2_hz", "Hz", "upper natural frequency of small undamped motions",
        |_, c, _| FourBar::linear_modes(c)[1]),
];
