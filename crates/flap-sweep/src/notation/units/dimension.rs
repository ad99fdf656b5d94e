//! Dimensions: the kinds of quantities that units measure.

use std::fmt;

/// Exponents of the SI base units that models need: metre, kilogram, second, ampere.
///
/// An angle is a pure number, so that a torsional stiffness may be given in N*m/rad or N*m. Radians and
/// hertz are counted none the less: a drive at 100 Hz is not one at 100 rad/s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Dimension {
    base: [i32; 4],
    radian: i32,
    hertz: i32,
}

impl Dimension {
    /// Metres, kilograms, seconds and amperes to these powers.
    pub(super) const fn base(metre: i32, kilogram: i32, second: i32, ampere: i32) -> Dimension {
        Dimension { base: [metre, kilogram, second, ampere], radian: 0, hertz: 0 }
    }

    /// A plane angle.
    pub(super) const ANGLE: Dimension = Dimension { base: [0; 4], radian: 1, hertz: 0 };

    /// Cycles per second.
    pub(super) const FREQUENCY: Dimension = Dimension { base: [0, 0, -1, 0], radian: 0, hertz: 1 };

    /// The dimension of a product of this quantity with another one to the given power.
    pub(super) fn times(self, other: Dimension, power: i32) -> Dimension {
        // Saturating: absurd exponents then merely fail to match.
        let add = |a: i32, b: i32| a.saturating_add(b.saturating_mul(power));
        let mut base = self.base;
        for (sum, exponent) in base.iter_mut().zip(other.base) {
            *sum = add(*sum, exponent);
        }
        Dimension { base, radian: add(self.radian, other.radian), hertz: add(self.hertz, other.hertz) }
    }

    /// True if a value of this dimension can stand in place of a `wanted` one.
    pub(super) fn fits(self, wanted: Dimension) -> bool {
        let mixes_turns_and_radians =
            (self.hertz != 0 && wanted.radian != 0) || (self.radian != 0 && wanted.hertz != 0);
        self.base == wanted.base && !mixes_turns_and_radians
    }
}

/// In words where there are any (`a voltage`), otherwise in base units.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((_, name)) = NAMES.iter().find(|(dimension, _)| *dimension == *self) {
            return f.write_str(name);
        }
        let plain = Dimension { radian: 0, hertz: 0, ..*self };
        if let Some((_, name)) = NAMES.iter().find(|(dimension, _)| *dimension == plain) {
            return f.write_str(name);
        }
        let symbols = ["m", "kg", "s", "A"];
        let powers: Vec<String> = symbols
            .iter()
            .zip(self.base)
            .filter(|(_, exponent)| *exponent != 0)
            .map(|(symbol, exponent)| match exponent {
                1 => (*symbol).to_owned(),
                _ => format!("{symbol}^{exponent}"),
            })
            .collect();
        f.write_str(&powers.join("*"))
    }
}

/// Dimensions that have a name. Angles and frequencies come before the plain numbers and rates they are.
const NAMES: &[(Dimension, &str)] = &[
    (Dimension::ANGLE, "an angle"),
    (Dimension { base: [0, 0, -1, 0], radian: 1, hertz: 0 }, "an angular rate"),
    (Dimension { base: [0, 0, -2, 0], radian: 1, hertz: 0 }, "an angular acceleration"),
    (Dimension::FREQUENCY, "a frequency"),
    (Dimension::base(0, 0, 0, 0), "a pure number"),
    (Dimension::base(1, 0, 0, 0), "a length"),
    (Dimension::base(2, 0, 0, 0), "an area"),
    (Dimension::base(3, 0, 0, 0), "a volume"),
    (Dimension::base(0, 1, 0, 0), "a mass"),
    (Dimension::base(0, 0, 1, 0), "a time"),
    (Dimension::base(0, 0, -1, 0), "a rate"),
    (Dimension::base(0, 0, -2, 0), "a rate of a rate"),
    (Dimension::base(1, 0, -1, 0), "a speed"),
    (Dimension::base(1, 0, -2, 0), "an acceleration"),
    (Dimension::base(1, 1, -2, 0), "a force"),
    (Dimension::base(2, 1, -2, 0), "a torque or an energy"),
    (Dimension::base(2, 1, -3, 0), "a power"),
    (Dimension::base(-1, 1, -2, 0), "a pressure"),
    (Dimension::base(0, 1, -2, 0), "a stiffness"),
    (Dimension::base(-3, 1, 0, 0), "a density"),
    (Dimension::base(2, 1, 0, 0), "a moment of inertia"),
    (Dimension::base(0, 0, 0, 1), "a current"),
    (Dimension::base(0, 0, 1, 1), "a charge"),
    (Dimension::base(2, 1, -3, -1), "a voltage"),
    (Dimension::base(1, 1, -3, -1), "an electric field"),
    (Dimension::base(-2, -1, 4, 2), "a capacitance"),
    (Dimension::base(2, 1, -3, -2), "a resistance"),
];
