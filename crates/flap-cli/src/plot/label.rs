//! What is written at axes: a column's name in words, and its unit.

use flap_sweep::table::layout;

/// A column's label, and the unit that its numbers are shown in.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Label {
    /// The name in words: `Lift, mean`.
    pub(super) words: String,
    /// The unit as it is written: `mN`, `µN·m/rad`; empty for none.
    pub(super) unit: String,
    /// What numbers are multiplied with to have that unit.
    pub(super) factor: f64,
}

impl Label {
    /// The label of column `name` in `unit`, of numbers no larger than `largest`.
    pub(super) fn new(name: &str, unit: &str, largest: f64) -> Label {
        let (factor, shown) = scaled(unit, largest);
        Label { words: words(name, unit), unit: pretty(&shown), factor }
    }

    /// Name and unit: `Lift, mean (mN)`.
    pub(super) fn text(&self) -> String {
        if self.unit.is_empty() { self.words.clone() } else { format!("{} ({})", self.words, self.unit) }
    }

    /// A value in the unit shown, with it: `70 V`.
    pub(super) fn value(&self, value: f64) -> String {
        format!("{} {}", short(value * self.factor), self.unit).trim_end().to_owned()
    }
}

/// A number with six digits at most.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value.is_nan() { "none".to_owned() } else { value.to_string().replace("-0", "0") };
    }
    let size = value.abs();
    if !(1e-4..1e6).contains(&size) {
        let text = format!("{value:.4e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", trimmed(digits));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
    let decimals = (5.0 - size.log10().floor()).clamp(0.0, 9.0) as usize;
    trimmed(&format!("{value:.decimals$}")).to_owned()
}

fn trimmed(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

/// Words at the end of a name that say which number of a signal it is.
const QUALIFIERS: [(&str, &str); 13] = [
    ("mean", "mean"),
    ("max", "max"),
    ("min", "min"),
    ("peak", "peak"),
    ("pp", "peak to peak"),
    ("rms", "rms"),
    ("amplitude", "amplitude"),
    ("first", "first harmonic"),
    ("supply", "supply"),
    ("magnitude", "magnitude"),
    ("lag", "lag"),
    ("second", "second"),
    ("margin", "margin"),
];

/// A column's name in words, without its unit.
fn words(name: &str, unit: &str) -> String {
    // A parameter such as `air_density` has a unit that its name does not tell.
    let (stem, known) = layout::split_unit(name);
    let stem = if known == unit { stem } else { name };
    let mut parts: Vec<&str> = stem.split('_').filter(|part| !part.is_empty()).collect();
    let mut qualifiers = Vec::new();
    while parts.len() > 1 {
        let last = parts[parts.len() - 1];
        let Some((_, text)) = QUALIFIERS.iter().find(|(word, _)| *word == last) else { break };
        qualifiers.insert(0, *text);
        parts.pop();
    }
    let head = parts.join(" ");
    let mut letters = head.chars();
    let capital: String = letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect();
    std::iter::once(capital.as_str()).chain(qualifiers).collect::<Vec<_>>().join(", ")
}

/// The unit as it is printed in books.
pub(super) fn pretty(unit: &str) -> String {
    let text = unit.replace('*', "·").replace("^2", "²").replace("^3", "³").replace("^4", "⁴");
    // A micro is a prefix: at the beginning, or after a point or a stroke.
    let mut out = String::new();
    let mut begins = true;
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let micro = begins && letter == 'u' && letters.peek().is_some_and(|next| next.is_alphabetic());
        out.push(if micro { 'µ' } else { letter });
        begins = matches!(letter, '·' | '/');
    }
    out
}

/// Prefixes, and the powers of ten that they stand for.
const PREFIXES: [(&str, i32); 7] = [("G", 9), ("M", 6), ("k", 3), ("", 0), ("m", -3), ("u", -6), ("n", -9)];

/// SI units that parameters are in, each with the exponent of the part that takes the prefix.
const SCALABLE: [(&str, i32); 13] = [
    ("m^2", 2),
    ("m", 1),
    ("s", 1),
    ("N*m/rad", 1),
    ("N*m*s", 1),
    ("N/m", 1),
    ("N", 1),
    ("Hz", 1),
    ("V", 1),
    ("V/m", 1),
    ("Pa", 1),
    ("F", 1),
    ("W", 1),
];

/// The unit with the prefix that suits `largest`, and the factor from `unit` to it.
fn scaled(unit: &str, largest: f64) -> (f64, String) {
    let suits = largest == 0.0 || (0.1..=1e4).contains(&largest);
    if suits || !largest.is_finite() {
        return (1.0, unit.to_owned());
    }
    match unit {
        "kg" if largest < 1e-3 => return (1e6, "mg".to_owned()),
        "kg" if largest < 1.0 => return (1e3, "g".to_owned()),
        "kg*m^2" if largest < 1e-6 => return (1e12, "mg*mm^2".to_owned()),
        _ => {}
    }
    let Some((_, power)) = SCALABLE.iter().find(|(known, _)| *known == unit) else {
        return (1.0, unit.to_owned());
    };
    let fits = PREFIXES.iter().find(|(_, ten)| largest / 10_f64.powi(ten * power) >= 1.0);
    let (prefix, ten) = fits.unwrap_or(&PREFIXES[PREFIXES.len() - 1]);
    (1.0 / 10_f64.powi(ten * power), format!("{prefix}{unit}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(name: &str, unit: &str) -> String {
        Label::new(name, unit, 1.0).text()
    }

    #[test]
    fn labels_are_words_with_units() {
        assert_eq!(text("lift_mean_mn", "mN"), "Lift, mean (mN)");
        assert_eq!(text("stroke_pp_deg", "deg"), "Stroke, peak to peak (deg)");
        assert_eq!(text("drive_voltage_pp", "V"), "Drive voltage, peak to peak (V)");
        assert_eq!(text("efficiency_gf_per_w", "gf/W"), "Efficiency (gf/W)");
        assert_eq!(text("power_plate_1_supply_mw", "mW"), "Power plate 1, supply (mW)");
        assert_eq!(text("field_max_v_per_um", "V/um"), "Field, max (V/µm)");
        assert_eq!(text("strain_surface_max", ""), "Strain surface, max");
        assert_eq!(text("air_density", "kg/m^3"), "Air density (kg/m³)");
        assert_eq!(text("mode_1_hz", "Hz"), "Mode 1 (Hz)");
        assert_eq!(text("mean", ""), "Mean");
        assert_eq!(text("", ""), "");
    }

    #[test]
    fn small_and_large_numbers_have_prefixes() {
        let hinge = Label::new("hinge_stiffness", "N*m/rad", 1.6e-4);
        assert_eq!(hinge.text(), "Hinge stiffness (µN·m/rad)");
        assert_eq!(hinge.value(6e-5), "60 µN·m/rad");
        let area = Label::new("wing_area", "m^2", 6e-5);
        assert_eq!((area.text().as_str(), area.factor.round()), ("Wing area (mm²)", 1e6));
        assert_eq!(Label::new("wing_inertia_hinge", "kg*m^2", 5e-11).text(), "Wing inertia hinge (mg·mm²)");
        assert_eq!(Label::new("piezo_modulus", "Pa", 6.2e10).value(6.2e10), "62 GPa");
        assert_eq!(Label::new("wing_mass", "kg", 1e-6).value(1.1e-6), "1.1 mg");
        assert_eq!(Label::new("time_s", "s", 0.02).text(), "Time (ms)");
        assert_eq!(Label::new("drive_frequency", "Hz", 122.0).value(95.0), "95 Hz");
        assert_eq!(Label::new("lift_mean_mn", "mN", 1e-3).text(), "Lift, mean (mN)");
    }

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (95.0, "95"),
            (0.1 + 0.2, "0.3"),
            (124.25, "124.25"),
            (1.0 / 3.0, "0.333333"),
            (2.5e-7, "2.5e-7"),
            (-1e9, "-1e9"),
            (f64::NAN, "none"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
