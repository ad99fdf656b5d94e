//! The units and prefixes that grid files may use, and what a misspelt one may have meant.

use super::dimension::Dimension;

/// A unit with a symbol of its own.
#[derive(Debug)]
pub(super) struct Symbol {
    /// As written.
    pub(super) name: &'static str,
    pub(super) dimension: Dimension,
    /// Power of ten to SI: exact, applied to the text of the number.
    pub(super) shift: i32,
    /// The factor to SI that remains after `shift`: 1 for decimal units.
    pub(super) factor: f64,
    /// True if it takes prefixes.
    prefixes: bool,
    /// The forms people use, the SI one first: for messages.
    usual: &'static [&'static str],
}

/// Powers of ten before a unit.
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

/// Every unit. No symbol may be another one with a prefix.
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

/// The unit written `name`, with the power of ten of its prefix.
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

/// Ways to write a quantity in the SI unit `unit`, itself first. None for a pure number.
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

/// Units that the unknown unit `name` may have meant, best guess first.
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
