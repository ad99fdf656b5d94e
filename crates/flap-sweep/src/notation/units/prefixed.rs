//! Converts numbers in SI units to text with a suitable prefix.

use super::parse_as;

/// SI prefixes, each with its power of ten.
const PREFIXES: [(&str, i32); 9] =
    [("G", 9), ("M", 6), ("k", 3), ("", 0), ("m", -3), ("u", -6), ("n", -9), ("p", -12), ("f", -15)];

/// Returns the text of `value` with six digits, the unit and a suitable prefix, such as `17 mm` for 0.017 m.
///
/// [`parse_as`] reads the text.
pub fn prefixed(value: f64, si_unit: &str) -> String {
    let (unit, tens) = unit_for(value, si_unit);
    let value = if tens == 0 { value } else { value / 10_f64.powi(tens) };
    format!("{} {unit}", digits(value)).trim_end().to_owned()
}

/// Returns the text of `value` with all digits, and with the same prefix as in [`prefixed`]. From the
/// returned text, [`parse_as`] reads exactly the float `value`.
pub fn exact(value: f64, si_unit: &str) -> String {
    let (unit, tens) = unit_for(value, si_unit);
    let scientific = format!("{value:e}");
    let shifted = scientific.split_once('e').and_then(|(digits, exponent)| {
        let exponent = exponent.parse::<i32>().ok()? - tens;
        // The shortest digits of the shifted number, if it is exact.
        format!("{digits}e{exponent}").parse::<f64>().ok()
    });
    let plain = shifted.map(|number| format!("{number} {unit}").trim_end().to_owned());
    let is_same = |text: &String| parse_as(text, si_unit).is_ok_and(|read| read.to_bits() == value.to_bits());
    plain.filter(is_same).unwrap_or_else(|| format!("{value:?} {si_unit}").trim_end().to_owned())
}

/// Returns the unit with the prefix that is suitable for `value`, and the power of ten of the prefix.
fn unit_for(value: f64, si_unit: &str) -> (String, i32) {
    let (symbol, rest) = split(si_unit);
    if symbol.is_empty() || symbol == "rad" || value == 0.0 || !value.is_finite() {
        return (si_unit.to_owned(), 0);
    }
    let power = power(rest);
    // For mass, prefixes apply to the gram.
    let (kilo, symbol) = if symbol == "kg" { (3 * power, "g") } else { (0, symbol) };
    let least = if power == 1 { 1.0 } else { 0.1 };
    let fits =
        |(_, ten): &&(&str, i32)| value.abs() / 10_f64.powi(ten * power - kilo) >= least * (1.0 - 1e-9);
    let (prefix, ten) = PREFIXES.iter().find(fits).unwrap_or(&PREFIXES[PREFIXES.len() - 1]);
    (format!("{prefix}{symbol}{rest}"), ten * power - kilo)
}

/// Finds the prefix that the user has probably forgotten, and returns `value` with this prefix. For example,
/// if `usual` is 0.0165 m and `value` is 17 m, the result is 0.017 m.
///
/// Returns `None` if no prefix brings the value within a factor of ten of `usual`.
pub fn meant(value: f64, usual: f64, si_unit: &str) -> Option<f64> {
    let (symbol, rest) = split(si_unit);
    if symbol.is_empty() || symbol == "rad" {
        return None;
    }
    let power = power(rest);
    let candidates = PREFIXES.iter().map(|(_, ten)| value * 10_f64.powi(ten * power));
    let distance = |candidate: &f64| (candidate / usual).abs().log10().abs();
    let nearest = candidates.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    (nearest / usual > 0.0 && distance(&nearest) < 1.0).then_some(nearest)
}

/// Returns the first symbol of a unit, and the rest of the unit.
fn split(unit: &str) -> (&str, &str) {
    unit.split_at(unit.find(|letter: char| !letter.is_alphabetic()).unwrap_or(unit.len()))
}

/// Returns the power at the beginning of `rest`, such as 2 for `^2`, or 1 if `rest` begins with no power.
fn power(rest: &str) -> i32 {
    let digits = rest.strip_prefix('^').and_then(|rest| rest.get(..1));
    digits.and_then(|digit| digit.parse().ok()).unwrap_or(1)
}

/// Returns the text of a number, rounded to six digits.
fn digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded != 0.0 && !(1e-4..1e9).contains(&rounded.abs()) {
        format!("{rounded:e}")
    } else {
        rounded.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_fit_the_number() {
        for (value, unit, text) in [
            (0.017, "m", "17 mm"),
            (17.0, "m", "17 m"),
            (54.4e-6, "m^2", "54.4 mm^2"),
            (1.52e-6, "N*m/rad", "1.52 uN*m/rad"),
            (2.5e-6, "kg", "2.5 mg"),
            (1.2, "kg/m^3", "1.2 kg/m^3"),
            (3.1e-12, "kg*m^2", "3.1 ng*m^2"),
            (62e9, "Pa", "62 GPa"),
            (-0.001, "V", "-1 mV"),
            (0.2, "rad", "0.2 rad"),
            (0.5, "", "0.5"),
            (0.0, "m", "0 m"),
        ] {
            assert_eq!(prefixed(value, unit), text);
            let read = parse_as(text, unit).unwrap();
            assert!((read - value).abs() <= 1e-9 * value.abs(), "{text}: {read}");
        }
    }

    #[test]
    fn exact_numbers_are_read_back_bit_for_bit() {
        for (value, unit, text) in [
            (0.985 * 1.52e-6, "N*m/rad", "1.4972 uN*m/rad"),
            (54.59e-6, "m^2", "54.59 mm^2"),
            (51.1e-12, "kg*m^2", "51.1 ng*m^2"),
            (3333.0, "rad/m", "3333 rad/m"),
            (1.2, "kg/m^3", "1.2 kg/m^3"),
            (-230.0, "", "-230"),
            (69e-9, "m/V", "69 nm/V"),
        ] {
            assert_eq!(exact(value, unit), text);
            assert_eq!(parse_as(text, unit).unwrap().to_bits(), value.to_bits(), "{text}");
        }
    }

    #[test]
    fn a_forgotten_prefix_is_found() {
        assert_eq!(meant(17.0, 0.0165, "m").map(|meant| prefixed(meant, "m")), Some("17 mm".to_owned()));
        assert_eq!(
            meant(54.0, 54.4e-6, "m^2").map(|meant| prefixed(meant, "m^2")),
            Some("54 mm^2".to_owned())
        );
        assert_eq!(meant(2.0, 1.5e-6, "kg").map(|meant| prefixed(meant, "kg")), Some("2 mg".to_owned()));
        assert_eq!(meant(-17.0, 0.0165, "m"), None);
        assert_eq!(meant(500.0, 0.5, ""), None);
    }
}
