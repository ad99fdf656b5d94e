//! Unit expressions: `V`, `uN*m/rad`, `mm²`, `kg/(m*s)`.

use super::dimension::Dimension;
use super::error::{Problem, UnitError};
use super::table::{self, Symbol};

/// A unit, reduced to how it converts to SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unit {
    pub(super) dimension: Dimension,
    /// Power of ten to SI.
    pub(super) shift: i32,
    /// Factors that are not powers of ten, above and below the line: dividing by 60 is exact where
    /// multiplying by 1/60 is not.
    pub(super) above: f64,
    pub(super) below: f64,
}

impl Unit {
    const ONE: Unit = Unit { dimension: Dimension::base(0, 0, 0, 0), shift: 0, above: 1.0, below: 1.0 };

    /// This unit times a symbol to a power.
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

/// Reads the unit `text`. Empty text is the unit of pure numbers.
///
/// Products and quotients are taken from left to right: `N/m*s` is `(N/m)*s`.
///
/// # Errors
/// With spans within `text`.
pub(super) fn parse(text: &str) -> Result<Unit, UnitError> {
    let mut reader = Reader { text, at: 0 };
    let mut unit = Unit::ONE;
    reader.skip_spaces();
    if reader.rest().is_empty() {
        return Ok(unit);
    }
    // Sign of the powers inside the parentheses, if inside.
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

/// A place in the text.
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

    /// An error at the next character.
    fn expected(&self, expected: &'static str) -> UnitError {
        let length = self.rest().chars().next().map_or(0, char::len_utf8);
        UnitError { span: self.at..self.at + length, problem: Problem::BadUnit(expected) }
    }

    /// The sign of the powers that follow: `*` or `/`.
    fn operator(&mut self) -> Result<i32, UnitError> {
        if self.take("/") {
            Ok(-1)
        } else if self.take("*") || self.take("\u{b7}") || self.take("\u{22c5}") {
            Ok(1)
        } else {
            Err(self.expected("`*` or `/`"))
        }
    }

    /// One symbol with its power, multiplied to `unit`.
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
            problem: Problem::UnknownUnit {
                unit: rest[..length + digits].to_owned(),
                nearest,
                usual: Vec::new(),
            },
        };
        let Some((symbol, prefix)) = table::find(name) else {
            return Err(unknown(None));
        };
        if digits > 0 {
            return Err(unknown(Some(format!("{name}^{}", &rest[length..length + digits]))));
        }
        self.at += length;
        let power = self.power()?;
        Ok(unit.times(symbol, prefix, sign * power))
    }

    /// `^2`, `^-1`, `²`, `⁻¹`, or nothing for 1.
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
        // One digit is plenty for a unit; a second one is a slip.
        let another = self.rest().starts_with(|c: char| c.is_ascii_digit() || SUPERSCRIPTS.contains(&c));
        if power == 0 || another {
            return Err(self.expected("a power from 1 to 9"));
        }
        Ok(if negative { -power } else { power })
    }
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
            let error = UnitError { span, problem: Problem::BadUnit(expected) };
            assert_eq!(parse(text), Err(error), "{text}");
        }
    }

    #[test]
    fn digits_after_a_symbol_are_not_a_power() {
        let problem = Problem::UnknownUnit {
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
}
