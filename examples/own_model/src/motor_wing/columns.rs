//! Signals of the motor-driven wing, and the columns computed from them.

use flap_core::model::Measure::{Amplitude, First, Magnitude, Max, Mean, Peak, Rms};
use flap_core::model::{Derived, EnergyBalance, Principal, Signal, Unit, position};

use super::{Constants, MotorWing};

/// Number of signals.
pub(crate) const S: usize = 9;

const LIFT: usize = position(&SIGNALS, "lift");
const POWER: usize = position(&SIGNALS, "power");
const AIR: usize = position(&SIGNALS, "power_air");

#[rustfmt::skip]
pub(super) const SIGNALS: [Signal; S] = [
    Signal::new("stroke", Unit::DEG, "flap angle", &[Amplitude, Max, First]).principal(Principal::First),
    Signal::new("lift", Unit::MN, "lift of the wing", &[Mean, Max]).principal(Principal::Mean),
    Signal::new("power", Unit::MW, "electrical power current x voltage", &[Mean, Magnitude]).principal(Principal::Mean),
    Signal::new("power_air", Unit::MW, "power that the air takes", &[Mean]),
    Signal::new("power_resistive", Unit::MW, "heat in the motor's winding", &[Mean]),
    Signal::new("power_bearing", Unit::MW, "heat in the motor's bearing", &[Mean]),
    Signal::new("power_magnetic", Unit::MW, "power lost where back_emf_constant is not torque_constant", &[]),
    Signal::new("current", Unit::MA, "current of the motor", &[Rms, Peak]),
    Signal::new("power_terminal", Unit::MW, "electrical power, to be compared with the losses", &[]),
];

/// Spring, inertia and inductance give back all that they take.
pub(super) const ENERGY: EnergyBalance = EnergyBalance {
    powers: &[(
        POWER,
        &[
            AIR,
            position(&SIGNALS, "power_resistive"),
            position(&SIGNALS, "power_bearing"),
            position(&SIGNALS, "power_magnetic"),
        ],
    )],
    audit: [POWER, position(&SIGNALS, "power_terminal")],
};

/// Newtons per gram-force.
const GRAM_FORCE: f64 = 9.806_65e-3;

type Column = Derived<MotorWing, Constants<f64>, S>;

#[rustfmt::skip]
pub(super) const DERIVED: &[Column] = &[
    Column::new("efficiency", "", "mean power that the air takes over mean magnitude of the electrical power",
        |_, _, cycle| cycle[AIR].mean / cycle[POWER].measure(Magnitude)),
    Column::new("efficiency_gf_per_w", "gf/W", "mean lift in grams-force over mean electrical power",
        |_, _, cycle| cycle[LIFT].mean / GRAM_FORCE / cycle[POWER].mean),
    Column::new("energy_audit", "", "relative difference of the mean electrical power from the losses, zero but for the integration's error",
        |_, _, cycle| ENERGY.audit(cycle)),
    Column::new("natural_hz", "Hz", "frequency of small undamped motions on the spring",
        |_, c, _| (c.stiffness / c.inertia).sqrt() / core::f64::consts::TAU),
];
