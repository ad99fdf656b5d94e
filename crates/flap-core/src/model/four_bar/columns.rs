//! What is measured of the four-bar model, and the columns that come of it.

use crate::model::Measure::{Amplitude, First, Magnitude, Max, Mean, Min, Peak, PeakToPeak, Rms, Supply};
use crate::model::convert::DEGREES;
use crate::model::{Derived, Measure, Signal};

/// Number of signals.
pub(super) const S: usize = 17;

/// Positions in [`SIGNALS`].
pub(super) const STROKE: usize = 0;
pub(super) const PITCH: usize = 1;
pub(super) const LIFT: usize = 2;
pub(super) const DRIVE_POWER: usize = 7;
/// What the drive's power goes into: the four signals that follow it.
pub(super) const LOSSES: core::ops::Range<usize> = 8..12;
pub(super) const POWER: usize = 12;
pub(super) const TRANSDUCED_POWER: usize = 15;
pub(super) const DRIVING_POWER: usize = 16;

pub(super) const SIGNALS: [Signal; S] = [
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
        measures: &[Amplitude, PeakToPeak, Mean, Max, Min, First],
    },
    Signal {
        name: "lift",
        unit: "mN",
        suffix: "mn",
        factor: 1e3,
        doc: "lift of the wing, Eq. (4)",
        measures: &[Mean, Max, Min],
    },
    Signal {
        name: "lift_translational",
        unit: "mN",
        suffix: "mn",
        factor: 1e3,
        doc: "lift of the wing's translation, Eq. (5)",
        measures: &[Mean],
    },
    Signal {
        name: "lift_rotational",
        unit: "mN",
        suffix: "mn",
        factor: 1e3,
        doc: "lift of the wing's rotation, Eq. (6)",
        measures: &[Mean],
    },
    Signal {
        name: "lift_added_mass",
        unit: "mN",
        suffix: "mn",
        factor: 1e3,
        doc: "lift of the added mass, Eq. (7)",
        measures: &[Mean],
    },
    Signal {
        name: "drag",
        unit: "mN",
        suffix: "mn",
        factor: 1e3,
        doc: "translational drag along the stroke, Eq. (5)",
        measures: &[Magnitude],
    },
    Signal {
        name: "power_drive",
        unit: "mW",
        suffix: "mw",
        factor: 1e3,
        doc: "mechanical power of the actuator on the stroke; its mean is the sum of the four that follow",
        measures: &[Mean],
    },
    Signal {
        name: "power_stroke_damping",
        unit: "mW",
        suffix: "mw",
        factor: 1e3,
        doc: "power taken by the damping of the stroke",
        measures: &[Mean],
    },
    Signal {
        name: "power_hinge_damping",
        unit: "mW",
        suffix: "mw",
        factor: 1e3,
        doc: "power taken by the damping of the hinge",
        measures: &[Mean],
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
        doc: "power taken by rotational drag, Eqs. (6) and (18)",
        measures: &[Mean],
    },
    Signal {
        name: "power",
        unit: "mW",
        suffix: "mw",
        factor: 1e3,
        doc: "electrical power current x voltage (not in the paper); its mean is that of power_drive",
        measures: &[Mean, Supply],
    },
    Signal {
        name: "current",
        unit: "mA",
        suffix: "ma",
        factor: 1e3,
        doc: "current into the actuator (not in the paper)",
        measures: &[Rms, Peak],
    },
    Signal {
        name: "tip",
        unit: "um",
        suffix: "um",
        factor: 1e6,
        doc: "displacement of the actuator's tip",
        measures: &[PeakToPeak, Peak],
    },
    Signal {
        name: "power_transduced",
        unit: "mW",
        suffix: "mw",
        factor: 1e3,
        doc: "electrical power without that of charging capacitances and of the constant part of the voltage",
        measures: &[],
    },
    Signal {
        name: "power_driving",
        unit: "mW",
        suffix: "mw",
        factor: 1e3,
        doc: "mechanical power of the actuator without that of its stiffness",
        measures: &[],
    },
];

pub(super) const PRINCIPAL: &[(usize, Measure)] =
    &[(STROKE, First), (PITCH, First), (LIFT, Mean), (POWER, Mean)];

pub(super) const DERIVED: &[Derived] = &[
    Derived {
        name: "stroke_lag_deg",
        unit: "deg",
        doc: "phase by which the first harmonic of the stroke lags that of the drive voltage, in (-180, 180]",
    },
    Derived {
        name: "pitch_lag_deg",
        unit: "deg",
        doc: "phase by which the first harmonic of the pitch lags that of the stroke, in (-180, 180]: the paper's phase shift",
    },
    Derived { name: "lift_mean_gf", unit: "gf", doc: "mean lift in grams-force" },
    Derived {
        name: "efficiency_gf_per_w",
        unit: "gf/W",
        doc: "mean lift over mean electrical power (power_mean_mw)",
    },
    Derived {
        name: "power_capacitive_mw",
        unit: "mW",
        doc: "C V_pp^2 f / 2, the power of charging the blocked actuator's capacitance without recovery",
    },
    Derived {
        name: "energy_audit",
        unit: "",
        doc: "(power of the actuator's force - power_drive_mean_mw) / power_drive_mean_mw, zero but for the integration's error",
    },
    Derived {
        name: "electrical_audit",
        unit: "",
        doc: "(electrical power by current x voltage - power_mean_mw) / power_mean_mw, zero but for the integration's error",
    },
    Derived {
        name: "field_max_v_per_um",
        unit: "V/um",
        doc: "largest electric field in the piezoelectric layer",
    },
    Derived {
        name: "mode_1_hz",
        unit: "Hz",
        doc: "lower natural frequency of small undamped motions, with the added mass of still air",
    },
    Derived { name: "mode_2_hz", unit: "Hz", doc: "upper natural frequency of small undamped motions" },
];
