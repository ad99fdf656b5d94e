//! Parses units such as `V`, `uN*m/rad`, `mm²` or `kg/(m*s)`, and contains the table of all units with their
//! dimensions.

use std::fmt;

use super::number::{UnitError, UnitProblem};

/// A unit, with its dimension and its conversion to SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unit {
    pub(super) dimension: Dimension,
    /// Power of ten in the conversion to SI units.
    pub(super) shift: i32,
    /// Numerator of the conversion factor to SI units, without the power of ten. The numerator and the
    /// denominator are stored separately, because 60 is an exact float, but 1/60 is not.
    pub(super) above: f64,
    pub(super) below: f64,
}

impl Unit {
    const ONE: Unit = Unit { dimension: Dimension::base(0, 0, 0, 0), shift: 0, above: 1.0, below: 1.0 };

    /// Returns this unit multiplied by the symbol `symbol` to the power `power`. `prefix` is the power of
    /// ten of the symbol's prefix.
    fn times(mut self, symbol: &Symbol, prefix: i32, power: i32) -> Unit {
        self.dimension = self.dimension.times(symbol.dimension, power);
        self.shift = self.shift.saturating_add((symbol.shift + prefix).saturating_mul(power));
        if power >= 0 {
            self.above *= symbol.factor.powi(power);
        } else {
            self.below *= symbol.factor.powi(-power);
        }
        self
    }
}

/// Parses the unit `text`. Empty text is the unit of pure numbers.
///
/// Products and quotients are computed from left to right: `N/m*s` is `(N/m)*s`.
///
/// # Errors
/// Returns the first mistake, with its position in `text`.
pub(super) fn parse(text: &str) -> Result<Unit, UnitError> {
    let mut reader = Reader { text, at: 0 };
    let mut unit = Unit::ONE;
    reader.skip_spaces();
    if reader.rest().is_empty() {
        return Ok(unit);
    }
    // Sign of the powers inside parentheses; `None` outside.
    let mut group: Option<i32> = None;
    let mut sign = 1;
    loop {
        reader.skip_spaces();
        if group.is_none() && reader.take("(") {
            group = Some(sign);
            sign = 1;
            reader.skip_spaces();
        }
        unit = reader.factor(unit, sign * group.unwrap_or(1))?;
        reader.skip_spaces();
        if group.is_some() && reader.take(")") {
            group = None;
            reader.skip_spaces();
        }
        if reader.rest().is_empty() {
            return if group.is_none() { Ok(unit) } else { Err(reader.expected("`)`")) };
        }
        sign = reader.operator()?;
    }
}

/// The text of a unit, and the current position of the parser in the text.
struct Reader<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Reader<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn skip_spaces(&mut self) {
        self.at = self.text.len() - self.rest().trim_start().len();
    }

    fn take(&mut self, token: &str) -> bool {
        let found = self.rest().starts_with(token);
        if found {
            self.at += token.len();
        }
        found
    }

    /// Returns an error whose position is the next character.
    fn expected(&self, expected: &'static str) -> UnitError {
        let length = self.rest().chars().next().map_or(0, char::len_utf8);
        UnitError { span: self.at..self.at + length, problem: UnitProblem::BadUnit(expected) }
    }

    /// Consumes `*` or `/`, and returns the sign of the next power: 1 after `*`, and -1 after `/`.
    fn operator(&mut self) -> Result<i32, UnitError> {
        if self.take("/") {
            Ok(-1)
        } else if self.take("*") || self.take("\u{b7}") || self.take("\u{22c5}") {
            Ok(1)
        } else {
            Err(self.expected("`*` or `/`"))
        }
    }

    /// Parses the next symbol and its power, and returns `unit` times this symbol to this power.
    fn factor(&mut self, unit: Unit, sign: i32) -> Result<Unit, UnitError> {
        if self.take("1") {
            return Ok(unit);
        }
        let rest = self.rest();
        let length =
            rest.find(|c: char| !c.is_alphabetic() && c != '%' && c != '\u{b0}').unwrap_or(rest.len());
        if length == 0 {
            return Err(self.expected("a unit"));
        }
        let name = &rest[..length];
        let digits = rest[length..].bytes().take_while(u8::is_ascii_digit).count();
        let span = self.at..self.at + length + digits;
        let unknown = |nearest| UnitError {
            span: span.clone(),
            problem: UnitProblem::UnknownUnit {
                unit: rest[..length + digits].to_owned(),
                nearest,
                usual: Vec::new(),
            },
        };
        let Some((symbol, prefix)) = find(name) else {
            return Err(unknown(None));
        };
        if digits > 0 {
            return Err(unknown(Some(format!("{name}^{}", &rest[length..length + digits]))));
        }
        self.at += length;
        let power = self.power()?;
        Ok(unit.times(symbol, prefix, sign * power))
    }

    /// Parses a power such as `^2`, `^-1`, `²` or `⁻¹`. Without a power in the text, the result is 1.
    fn power(&mut self) -> Result<i32, UnitError> {
        const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
        let caret = self.take("^");
        let negative = self.take(if caret { "-" } else { "⁻" });
        let next = self.rest().chars().next();
        let digit = match next {
            Some(c) if caret => c.to_digit(10),
            Some(c) => SUPERSCRIPTS.iter().position(|&s| s == c).and_then(|n| u32::try_from(n).ok()),
            None => None,
        };
        let power = match digit {
            Some(digit) => {
                self.at += next.map_or(0, char::len_utf8);
                i32::try_from(digit).unwrap_or(0)
            }
            None if caret || negative => return Err(self.expected("a power from 1 to 9")),
            None => return Ok(1),
        };
        // Powers have one digit. A second digit is a mistake.
        let another = self.rest().starts_with(|c: char| c.is_ascii_digit() || SUPERSCRIPTS.contains(&c));
        if power == 0 || another {
            return Err(self.expected("a power from 1 to 9"));
        }
        Ok(if negative { -power } else { power })
    }
}

/// Dimension of a quantity: the exponents of the SI base units metre, kilogram, second and ampere.
///
/// An angle is a pure number, so a torsional stiffness may be given in N*m/rad or N*m. The powers of radians and hertz
/// are nevertheless counted, because 100 Hz and 100 rad/s are different frequencies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dimension {
    base: [i32; 4],
    radian: i32,
    hertz: i32,
}

impl Dimension {
    /// Returns the dimension with the given exponents of metre, kilogram, second and ampere.
    pub(super) const fn base(metre: i32, kilogram: i32, second: i32, ampere: i32) -> Dimension {
        Dimension { base: [metre, kilogram, second, ampere], radian: 0, hertz: 0 }
    }

    /// Plane angle.
    pub(super) const ANGLE: Dimension = Dimension { base: [0; 4], radian: 1, hertz: 0 };

    /// Cycles per second.
    pub(super) const FREQUENCY: Dimension = Dimension { base: [0, 0, -1, 0], radian: 0, hertz: 1 };

    /// Returns the dimension of a product: this quantity times a second quantity that is raised to the power
    /// `power`.
    pub(super) fn times(self, other: Dimension, power: i32) -> Dimension {
        // Saturating: with absurd exponents the dimension does not match.
        let add = |a: i32, b: i32| a.saturating_add(b.saturating_mul(power));
        let mut base = self.base;
        for (sum, exponent) in base.iter_mut().zip(other.base) {
            *sum = add(*sum, exponent);
        }
        Dimension { base, radian: add(self.radian, other.radian), hertz: add(self.hertz, other.hertz) }
    }

    /// Returns the exponents of the SI base units and of the radian.
    pub(super) fn powers(self) -> [(&'static str, i32); 5] {
        let [metre, kilogram, second, ampere] = self.base;
        [("m", metre), ("kg", kilogram), ("s", second), ("A", ampere), ("rad", self.radian)]
    }

    /// Returns true if a value with this dimension is allowed where a value with the dimension `wanted` is
    /// expected.
    pub(super) fn fits(self, wanted: Dimension) -> bool {
        let mixes_turns_and_radians =
            (self.hertz != 0 && wanted.radian != 0) || (self.radian != 0 && wanted.hertz != 0);
        self.base == wanted.base && !mixes_turns_and_radians
    }
}

/// Prints the dimension in words if the dimension has a name (`a voltage`), otherwise in base units.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((_, name)) = NAMES.iter().find(|(dimension, _)| *dimension == *self) {
            return f.write_str(name);
        }
        let plain = Dimension { radian: 0, hertz: 0, ..*self };
        if let Some((_, name)) = NAMES.iter().find(|(dimension, _)| *dimension == plain) {
            return f.write_str(name);
        }
        let powers = plain.powers().into_iter().filter(|(_, exponent)| *exponent != 0);
        let powers = powers.map(|(symbol, exponent)| match exponent {
            1 => symbol.to_owned(),
            _ => format!("{symbol}^{exponent}"),
        });
        f.write_str(&powers.collect::<Vec<_>>().join("*"))
    }
}

/// Dimensions with a name. In the list, angles and frequencies come before pure numbers and rates, because
/// the first match is used.
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

/// A unit with its own symbol, such as `V` or `min`.
#[derive(Debug)]
pub(super) struct Symbol {
    /// Symbol.
    pub(super) name: &'static str,
    pub(super) dimension: Dimension,
    /// Power of ten in the conversion to SI units. The power is added to the exponent in the text of the
    /// number, so the conversion is exact.
    pub(super) shift: i32,
    /// The conversion to SI units multiplies by this factor and by the power of ten `shift`. The factor
    /// is 60 for minutes, and 1 for decimal units.
    pub(super) factor: f64,
    /// True if the unit allows prefixes.
    prefixes: bool,
    /// Usual units of the quantity that this unit measures, for messages. The first unit is the SI unit.
    usual: &'static [&'static str],
}

/// SI prefixes, each with its power of ten.
const PREFIXES: &[(&str, i32)] = &[
    ("T", 12),
    ("G", 9),
    ("M", 6),
    ("k", 3),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("\u{b5}", -6),  // µ, the micro sign
    ("\u{3bc}", -6), // μ, the Greek letter
    ("n", -9),
    ("p", -12),
    ("f", -15),
];

const fn prefixed(name: &'static str, dimension: Dimension, usual: &'static [&'static str]) -> Symbol {
    Symbol { name, dimension, shift: 0, factor: 1.0, prefixes: true, usual }
}

const fn alone(
    name: &'static str,
    dimension: Dimension,
    factor: f64,
    usual: &'static [&'static str],
) -> Symbol {
    Symbol { name, dimension, shift: 0, factor, prefixes: false, usual }
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;
const OHM: Dimension = Dimension::base(2, 1, -3, -2);
const OHMS: &[&str] = &["Ohm", "kOhm", "MOhm"];
const ANGLES: &[&str] = &["rad", "mrad", "deg"];

/// All units. A symbol must not equal a different symbol with a prefix: for example, no unit may have the
/// symbol `mm`.
pub(super) const SYMBOLS: &[Symbol] = &[
    prefixed("m", Dimension::base(1, 0, 0, 0), &["m", "mm", "um"]),
    // The SI unit is the kilogram.
    Symbol { shift: -3, ..prefixed("g", Dimension::base(0, 1, 0, 0), &["kg", "g", "mg"]) },
    prefixed("s", Dimension::base(0, 0, 1, 0), &["s", "ms", "us"]),
    alone("min", Dimension::base(0, 0, 1, 0), 60.0, &["min"]),
    prefixed("A", Dimension::base(0, 0, 0, 1), &["A", "mA", "uA"]),
    prefixed("Hz", Dimension::FREQUENCY, &["Hz", "kHz"]),
    prefixed("N", Dimension::base(1, 1, -2, 0), &["N", "mN", "uN"]),
    // Standard gravity times a gram.
    Symbol { factor: 9.806_65e-3, ..prefixed("gf", Dimension::base(1, 1, -2, 0), &["gf", "mgf"]) },
    prefixed("J", Dimension::base(2, 1, -2, 0), &["J", "mJ", "uJ"]),
    prefixed("W", Dimension::base(2, 1, -3, 0), &["W", "mW", "uW"]),
    prefixed("Pa", Dimension::base(-1, 1, -2, 0), &["Pa", "MPa", "GPa"]),
    prefixed("C", Dimension::base(0, 0, 1, 1), &["C", "uC", "nC"]),
    prefixed("V", Dimension::base(2, 1, -3, -1), &["V", "mV", "kV"]),
    prefixed("F", Dimension::base(-2, -1, 4, 2), &["F", "nF", "pF"]),
    prefixed("H", Dimension::base(2, 1, -2, -2), &["H", "mH", "uH"]),
    prefixed("Ohm", OHM, OHMS),
    prefixed("ohm", OHM, OHMS),
    prefixed("\u{3a9}", OHM, OHMS),  // Ω, the Greek letter
    prefixed("\u{2126}", OHM, OHMS), // Ω, the ohm sign
    prefixed("rad", Dimension::ANGLE, ANGLES),
    alone("deg", Dimension::ANGLE, DEGREE, ANGLES),
    alone("\u{b0}", Dimension::ANGLE, DEGREE, ANGLES),
    Symbol { shift: -2, ..alone("%", Dimension::base(0, 0, 0, 0), 1.0, &["%"]) },
];

/// Returns the symbol of the unit `name`, and the power of ten of its prefix: for example, `m` and -3 for
/// `mm`.
pub(super) fn find(name: &str) -> Option<(&'static Symbol, i32)> {
    if let Some(symbol) = SYMBOLS.iter().find(|symbol| symbol.name == name) {
        return Some((symbol, 0));
    }
    PREFIXES.iter().find_map(|(prefix, power)| {
        let rest = name.strip_prefix(prefix)?;
        let symbol = SYMBOLS.iter().find(|symbol| symbol.prefixes && symbol.name == rest)?;
        Some((symbol, *power))
    })
}

/// Returns the usual units of a quantity with the SI unit `unit`, beginning with the SI unit. The list is empty for a
/// pure number.
pub(super) fn usual(unit: &str) -> Vec<String> {
    if unit.is_empty() {
        return Vec::new();
    }
    let end = unit.find(|c: char| !c.is_alphabetic()).unwrap_or(unit.len());
    let (first, rest) = unit.split_at(end);
    let mut ways = vec![unit.to_owned()];
    if let Some((symbol, _)) = find(first) {
        ways.extend(
            symbol.usual.iter().filter(|other| **other != first).map(|other| format!("{other}{rest}")),
        );
    }
    ways
}

/// Returns units that are similar to the unknown unit `name`, the most similar first.
pub(super) fn suggestions(name: &str) -> Vec<String> {
    let mut names: Vec<String> =
        SYMBOLS.iter().flat_map(|symbol| symbol.usual.iter().map(|usual| (*usual).to_owned())).collect();
    for symbol in SYMBOLS {
        names.push(symbol.name.to_owned());
        if symbol.prefixes {
            names.extend(PREFIXES.iter().map(|(prefix, _)| format!("{prefix}{}", symbol.name)));
        }
    }

    let lower = name.to_lowercase();
    let other_case = names.iter().filter(|candidate| candidate.to_lowercase() == lower);
    let products = name.char_indices().skip(1).filter_map(|(at, _)| {
        let (left, right) = name.split_at(at);
        (find(left).is_some() && find(right).is_some()).then(|| format!("{left}*{right}"))
    });
    let mut similar: Vec<(f64, &String)> = names
        .iter()
        .map(|candidate| (strsim::jaro_winkler(name, candidate), candidate))
        .filter(|(likeness, _)| *likeness > 0.8)
        .collect();
    similar.sort_by(|a, b| b.0.total_cmp(&a.0));

    other_case.cloned().chain(products).chain(similar.into_iter().map(|(_, name)| name.clone())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(text: &str) -> Unit {
        parse(text).expect(text)
    }

    #[test]
    fn equal_units() {
        let pairs = [
            ("uN*m/rad", "\u{b5}N\u{b7}m/rad"),
            ("uN*m/rad", "\u{3bc}N \u{22c5} m / rad"),
            ("m/s^2", "m/s²"),
            ("m/s^2", "m*s⁻²"),
            ("m/s^2", "m/s/s"),
            ("kg/(m*s)", "kg/m/s"),
            ("kg/(m/s)", "kg/m*s"),
            ("kg/( m * s^2 )*A", "kg*A/m/s²"),
            ("1/m", "m^-1"),
            ("Ohm", "\u{3a9}"),
            ("Ohm", "\u{2126}"),
            ("deg", "°"),
            ("", "  "),
            ("", "1"),
        ];
        for (left, right) in pairs {
            assert_eq!(unit(left), unit(right), "{left} and {right}");
        }
    }

    #[test]
    fn dimensions() {
        let pairs = [
            ("N", "kg*m/s^2"),
            ("J", "N*m"),
            ("W", "J/s"),
            ("W", "V*A"),
            ("Pa", "N/m^2"),
            ("C", "A*s"),
            ("F", "C/V"),
            ("Ohm", "V/A"),
            ("gf", "mN"),
            ("min", "s"),
        ];
        for (left, right) in pairs {
            assert_eq!(unit(left).dimension, unit(right).dimension, "{left} and {right}");
        }
    }

    #[test]
    fn malformed() {
        let power = "a power from 1 to 9";
        let cases = [
            ("N*", 2..2, "a unit"),
            ("*m", 0..1, "a unit"),
            ("N**m", 2..3, "a unit"),
            ("N m", 2..3, "`*` or `/`"),
            ("kg/(m*s", 7..7, "`)`"),
            ("kg/((m))", 4..5, "a unit"),
            ("m)", 1..2, "`*` or `/`"),
            ("m^", 2..2, power),
            ("m^-", 3..3, power),
            ("m^12", 3..4, power),
            ("m^0", 3..3, power),
            ("m⁻", 4..4, power),
            ("m^2.5", 3..4, "`*` or `/`"),
            ("V?", 1..2, "`*` or `/`"),
        ];
        for (text, span, expected) in cases {
            let error = UnitError { span, problem: UnitProblem::BadUnit(expected) };
            assert_eq!(parse(text), Err(error), "{text}");
        }
    }

    #[test]
    fn digits_after_a_symbol_are_not_a_power() {
        let problem = UnitProblem::UnknownUnit {
            unit: "mm2".to_owned(),
            nearest: Some("mm^2".to_owned()),
            usual: Vec::new(),
        };
        assert_eq!(parse("mg*mm2"), Err(UnitError { span: 3..6, problem }));
    }

    #[test]
    fn absurd_powers_do_not_overflow() {
        let text = vec!["Tm^9"; 1000].join("*");
        assert_eq!(unit(&text).shift, 12 * 9 * 1000);
    }

    #[test]
    fn no_symbol_reads_two_ways() {
        for symbol in SYMBOLS {
            let readings = PREFIXES
                .iter()
                .filter_map(|(prefix, _)| symbol.name.strip_prefix(prefix))
                .filter(|rest| SYMBOLS.iter().any(|other| other.prefixes && other.name == *rest));
            assert_eq!(readings.count(), 0, "{} is also a prefix and a unit", symbol.name);
        }
    }

    #[test]
    fn usual_forms_exist_and_measure_the_same() {
        for symbol in SYMBOLS {
            for usual in symbol.usual {
                let (found, _) = find(usual).expect(usual);
                assert_eq!(found.dimension, symbol.dimension, "{usual}");
            }
        }
    }

    #[test]
    fn ways_to_write_a_unit() {
        assert_eq!(usual("V"), ["V", "mV", "kV"]);
        assert_eq!(usual("N*m/rad"), ["N*m/rad", "mN*m/rad", "uN*m/rad"]);
        assert_eq!(usual("kg*m^2"), ["kg*m^2", "g*m^2", "mg*m^2"]);
        assert_eq!(usual("1/m"), ["1/m"]);
        assert!(usual("").is_empty());
        assert_eq!(usual("m^2"), ["m^2", "mm^2", "um^2"]);
    }

    #[test]
    fn guesses() {
        assert_eq!(suggestions("hz")[0], "Hz");
        assert_eq!(suggestions("uNm")[0], "uN*m");
        assert_eq!(suggestions("volt"), Vec::<String>::new());
        assert!(suggestions("umm").contains(&"um".to_owned()));
    }
}
