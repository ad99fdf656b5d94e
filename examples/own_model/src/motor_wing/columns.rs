//! Signals of the motor-driven wing, and the columns that are computed from the signals.

use flap_core::model::readings::{efficiency, grams_force};
use flap_core::model::{Derived, Measure, Model, Unit};

use super::{Constants, MotorWing};

flap_core::signals! {
    /// Signals of the motor-driven wing.
    pub struct Signals {
        stroke: (Unit::DEG, "flap angle", [Amplitude, Max, First]) principal First,
        lift: (Unit::MN, "test lift of the wing", [Mean, Max]) principal Mean,
        power: (Unit::MW, "electrical power current x voltage", [Mean, Magnitude]) principal Mean,
        power_air: (Unit::MW, "power that the air takes", [Mean]),
        power_resistive: (Unit::MW, "heat in the motor's winding", [Mean]),
        power_bearing: (Unit::MW, "heat in the motor's bearing", [Mean]),
        power_magnetic: (Unit::MW, "power lost where back_emf_constant is not torque_constant", []),
        current: (Unit::MA, "current of the motor", [Rms, Peak]),
        power_terminal: (Unit::MW, "electrical power, to be compared with the losses", []),
    }
}

type Column = Derived<MotorWing, Constants<f64>, Signals>;

#[rustfmt::skip]
pub(super) const DERIVED: &[Column] = &[
    Column::new("efficiency", "", "mean power that the air takes over mean magnitude of the electrical power",
        |_, _, cycle| cycle.power_air.mean / cycle.power.measure(Measure::Magnitude)),
    Column::new("efficiency_gf_per_w", "gf/W", "mean lift in grams-force over mean electrical power",
        |_, _, cycle| efficiency(grams_force(cycle.lift.mean), cycle.power.mean)),
    Column::new("energy_audit", "", "relative difference of the mean electrical power from the losses, zero but for the integration's error",
        |_, _, cycle| MotorWing::energy_audit(cycle)),
    Column::new("natural_hz", "Hz", "frequency of small undamped motions on the spring",
        |_, c, _| (c.stiffness / c.inertia).sqrt() / core::f64::consts::TAU),
];
