//! Creates the labels of columns: the name in words, the unit, and the direction (larger or smaller values)
//! in which the measure improves.

use std::borrow::Cow;
use std::f64::consts::PI;

use flap_core::simulate::Simulator;
use flap_core::vehicle::FORCES;

use crate::derivative;

/// Label of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Name of the column in words, without the unit, such as `Lift, mean`.
    pub words: String,
    /// Unit for display, such as `N·m/rad` or `°`; empty for a column without a unit.
    pub unit: String,
    /// Direction in which the measure improves: towards larger or smaller values. `None` for a column that is
    /// neither a benefit nor a cost.
    pub better: Option<Direction>,
}

/// Direction in which a measure improves: towards larger or smaller values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Larger values of the measure are better: a benefit, such as lift.
    Larger,
    /// Smaller values of the measure are better: a cost, such as power.
    Smaller,
}

impl Label {
    /// Returns the name in words with the unit, such as `Lift, mean (mN)`.
    pub fn text(&self) -> String {
        titled(&self.words, &self.unit)
    }
}

/// Returns the label of a column whose values are in `unit`. The unit has the form `N*m/rad`, and is empty
/// for a column without a unit.
///
/// ```
/// use flap_sweep::table::labels::{self, Direction};
///
/// let label = labels::with_unit("power_drag_mean_mw", "mW");
/// assert_eq!(label.text(), "Drag power, mean (mW)");
/// assert_eq!(label.better, Some(Direction::Smaller));
/// ```
pub fn with_unit(column: &str, unit: &str) -> Label {
    Label { words: words(column, unit), unit: printed(unit), better: better(column) }
}

/// Returns the unit of a column, or an empty text for a column without a unit.
///
/// If one of the `models` has a parameter, a measure or a derivative with this name, the function returns the
/// unit that the model states. For all other names, the ending of the name determines the unit: for example,
/// `_mn` means mN.
pub fn unit_of(column: &str, models: &[&'static dyn Simulator]) -> Cow<'static, str> {
    let of_model = |name| unit_in_models(name, models);
    let derivative = derivative::parts(column).and_then(|(of, by, per)| {
        let is_known = per == derivative::Per::Cent || of_model(by).is_some();
        is_known.then(|| derivative::unit(&unit_of(of, models), of_model(by).unwrap_or_default(), per))
    });
    derivative.map_or_else(|| of_model(column).unwrap_or_else(|| split_unit(column).1).into(), Cow::from)
}

/// Endings of column names, each with the unit that the ending means. If two endings match a name, the longer
/// ending comes first in the list.
const ENDINGS: [(&str, &str); 30] = [
    ("_gf_per_w", "gf/W"),
    ("_deg_per_v", "deg/V"),
    ("_v_per_um", "V/um"),
    ("_rad_s", "rad/s"),
    ("_m_s", "m/s"),
    ("_1_s", "1/s"),
    ("_mgf", "mgf"),
    ("_deg", "deg"),
    ("_rad", "rad"),
    ("_khz", "kHz"),
    ("_hz", "Hz"),
    ("_gf", "gf"),
    ("_mn", "mN"),
    ("_un", "uN"),
    ("_unm", "uN*m"),
    ("_mw", "mW"),
    ("_uw", "uW"),
    ("_ma", "mA"),
    ("_ua", "uA"),
    ("_mm", "mm"),
    ("_um", "um"),
    ("_mg", "mg"),
    ("_kg", "kg"),
    ("_ms", "ms"),
    ("_us", "us"),
    ("_mj", "mJ"),
    ("_uj", "uJ"),
    ("_v", "V"),
    ("_s", "s"),
    ("_m", "m"),
];

/// Splits the name of a column into the part before the unit and the unit. The unit is empty if the name does
/// not end in a unit.
///
/// ```
/// assert_eq!(flap_sweep::table::labels::split_unit("lift_mean_mn"), ("lift_mean", "mN"));
/// assert_eq!(flap_sweep::table::labels::split_unit("status"), ("status", ""));
/// ```
pub fn split_unit(name: &str) -> (&str, &'static str) {
    let split = ENDINGS.iter().find_map(|(ending, unit)| Some((name.strip_suffix(ending)?, *unit)));
    split.unwrap_or((name, ""))
}

/// Searches all models for a parameter or a measure called `name`, and returns its unit.
fn unit_in_models(name: &str, models: &[&'static dyn Simulator]) -> Option<&'static str> {
    models.iter().find_map(|model| {
        let parameter = model.parameters().iter().find(|parameter| parameter.name == name);
        let measure = || model.columns().iter().find(|measure| measure.name == name);
        parameter.map(|parameter| parameter.unit).or_else(|| measure().map(|measure| measure.unit))
    })
}

/// Returns the text of a label: the words, then the unit in parentheses. If `unit` is empty, the text
/// contains only the words.
pub fn titled(words: &str, unit: &str) -> String {
    if unit.is_empty() { words.to_owned() } else { format!("{words} ({unit})") }
}

/// Words with which the names of benefits and costs begin, each with the direction in which the measure
/// improves. If two entries match a name, the longer entry comes first in the list.
const BETTER: [(&str, Direction); 10] = [
    ("lift", Direction::Larger),
    ("force_up", Direction::Larger),
    ("efficiency", Direction::Larger),
    ("power", Direction::Smaller),
    ("current", Direction::Smaller),
    ("strain", Direction::Smaller),
    ("field", Direction::Smaller),
    ("drag", Direction::Smaller),
    ("force", Direction::Smaller),
    ("hover_growth", Direction::Smaller),
];

/// Returns [`Direction::Larger`] for a benefit and [`Direction::Smaller`] for a cost. The first words of the
/// column name determine the result. Returns `None` if the column is neither a benefit nor a cost.
pub fn better(column: &str) -> Option<Direction> {
    // The other forces and torques of a vehicle have target values: neither large nor small values are preferred.
    if column != "force_up_mn" && FORCES.contains(&column) {
        return None;
    }
    let begins =
        |words: &str| column.strip_prefix(words).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'));
    BETTER.iter().find(|(words, _)| begins(words)).map(|(_, direction)| *direction)
}

/// Words in column names that stand after a comma in labels: for example, the label of `lift_max_mn` is
/// `Lift, largest (mN)`.
const QUALIFIERS: [(&str, &str); 14] = [
    ("mean", "mean"),
    ("max", "largest"),
    ("min", "smallest"),
    ("peak", "peak"),
    ("pp", "peak to peak"),
    ("rms", "rms"),
    ("amplitude", "amplitude"),
    ("first", "first harmonic"),
    ("supply", "supply"),
    ("magnitude", "mean magnitude"),
    ("lag", "lag"),
    ("second", "second"),
    ("third", "third"),
    ("margin", "margin"),
];

/// Nouns that stand before their adjectives in names of measures. For example, the label of
/// `power_drag_mean_mw` begins with `Drag power`.
const NOUNS: [&str; 9] =
    ["lift", "drag", "power", "current", "force", "torque", "efficiency", "strain", "field"];

fn qualifier(word: &str) -> Option<&'static str> {
    QUALIFIERS.iter().find(|(known, _)| *known == word).map(|(_, text)| *text)
}

/// Returns a column's name in words, without its unit.
fn words(name: &str, unit: &str) -> String {
    let (shortened, known) = split_unit(name);
    // A parameter such as `air_density` has a unit that its name does not contain.
    let is_shortened = !known.is_empty() && (unit.is_empty() || unit == known);
    let stem = if is_shortened { shortened } else { name };
    let parts: Vec<&str> = stem.split('_').filter(|part| !part.is_empty()).collect();
    if parts.is_empty() {
        return String::new();
    }
    let is_whole = parts[0] == "mode";
    let first_behind = parts.iter().skip(1).position(|part| qualifier(part).is_some()).map(|place| place + 1);
    let (noun, behind) = parts.split_at(first_behind.filter(|_| !is_whole).unwrap_or(parts.len()));

    let mut noun = noun.to_vec();
    let is_measure = is_shortened || noun[0] == "strain";
    let has_adjective = |noun: &[&str]| {
        noun.len() > 1 && noun[1] != "audit" && !noun[1].starts_with(|letter: char| letter.is_ascii_digit())
    };
    if is_measure && NOUNS.contains(&noun[0]) && has_adjective(&noun) {
        noun.rotate_left(1);
    }
    let said: Vec<&str> = behind.iter().map(|part| qualifier(part).unwrap_or(part)).collect();
    let separator = if behind.iter().all(|part| qualifier(part).is_some()) { ", " } else { " " };
    let mut text = capitalized(&noun.join(" "));
    if !said.is_empty() {
        text += ", ";
        text += &said.join(separator);
    }
    text
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
}

/// Returns a unit for display: for example, `uN*m/rad` becomes `µN·m/rad`, `mm^2` becomes `mm²`, and `deg`
/// becomes `°`.
pub fn printed(unit: &str) -> String {
    let mut text = String::new();
    let mut rest = unit;
    while let Some(first) = rest.chars().next() {
        let is_word = first.is_alphabetic();
        let end = if is_word {
            rest.find(|letter: char| !letter.is_alphabetic()).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (token, behind) = rest.split_at(end);
        rest = behind;
        match token {
            "deg" => text.push('°'),
            "*" => text.push('·'),
            "^" => {
                let digits = rest.find(|letter: char| letter != '-' && !letter.is_ascii_digit());
                let (exponent, behind) = rest.split_at(digits.unwrap_or(rest.len()));
                text.extend(exponent.chars().map(superscript));
                rest = behind;
            }
            _ => match token.strip_prefix('u').filter(|symbol| !symbol.is_empty()) {
                Some(symbol) => text.extend(["µ", symbol]),
                None => text += token,
            },
        }
    }
    text
}

fn superscript(digit: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    digit.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize])
}

/// A unit with a suitable prefix, and the factor that converts values from the original unit into this unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// Factor by which values in the original unit are multiplied.
    pub factor: f64,
    /// Unit of the scaled values, for display.
    pub unit: String,
}

/// SI prefixes of units, each with its power of ten.
const PREFIXES: [(&str, i32); 8] =
    [("G", 9), ("M", 6), ("k", 3), ("", 0), ("m", -3), ("µ", -6), ("n", -9), ("p", -12)];

/// Units to which a prefix can be added. Units of measures, such as mN, already have a prefix.
const SYMBOLS: [&str; 13] = ["m", "s", "N", "Pa", "V", "F", "kg", "Hz", "W", "A", "J", "Ohm", "C"];

/// Returns a scale for values in `unit`. With the prefix of the scale, the largest magnitude of the values,
/// `largest`, is between 1 and 1000.
///
/// If `largest` is from 0.1 to 10 000, the unit does not change. Radians always become degrees.
pub fn scale(unit: &str, largest: f64) -> Scale {
    let scale = |factor: f64, unit: &str| Scale { factor, unit: unit.to_owned() };
    match unit {
        "rad" => return scale(180.0 / PI, "°"),
        "rad/s" => return scale(0.18 / PI, "°/ms"),
        _ => {}
    }
    let symbol_end = unit.find(|letter: char| !letter.is_ascii_alphabetic()).unwrap_or(unit.len());
    let (symbol, rest) = unit.split_at(symbol_end);
    let is_readable = largest == 0.0 || !largest.is_finite() || (0.1..1e4).contains(&largest);
    if is_readable || !SYMBOLS.contains(&symbol) {
        return scale(1.0, &printed(unit));
    }
    if unit == "kg*m^2" {
        return if largest < 1e-9 { scale(1e12, "mg·mm²") } else { scale(1e9, "g·mm²") };
    }
    // The exponent of the symbol also applies to its prefix.
    let digits = rest.strip_prefix('^').unwrap_or("");
    let digits = &digits[..digits.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(digits.len())];
    let power = digits.parse().unwrap_or(1);
    let (symbol, base) = if symbol == "kg" { ("g", 3) } else { (symbol, 0) };
    let size = largest.log10() + f64::from(base) + 1e-9;
    let fits = PREFIXES.iter().find(|(_, ten)| size >= f64::from(ten * power));
    let (prefix, ten) = fits.unwrap_or(&PREFIXES[PREFIXES.len() - 1]);
    Scale { factor: power_of_ten(base - ten * power), unit: format!("{prefix}{symbol}{}", printed(rest)) }
}

/// Returns the number nearest to 10^`exponent`, for exponents from -22 to 22.
fn power_of_ten(exponent: i32) -> f64 {
    if exponent < 0 { 1.0 / 10_f64.powi(-exponent) } else { 10_f64.powi(exponent) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_words_with_units() {
        for (name, unit, text) in [
            ("lift_mean_mn", "mN", "Lift, mean (mN)"),
            ("lift_max_mn", "mN", "Lift, largest (mN)"),
            ("stroke_pp_deg", "deg", "Stroke, peak to peak (°)"),
            ("stroke_pp_deg_per_v", "deg/V", "Stroke, peak to peak (°/V)"),
            ("stroke_first_lag_deg", "deg", "Stroke, first harmonic, lag (°)"),
            ("drive_voltage_pp", "V", "Drive voltage, peak to peak (V)"),
            ("efficiency_gf_per_w", "gf/W", "Efficiency (gf/W)"),
            ("efficiency_capacitive_gf_per_w", "gf/W", "Capacitive efficiency (gf/W)"),
            ("power_plate_1_supply_mw", "mW", "Plate 1 power, supply (mW)"),
            ("power_translational_mean_mw", "mW", "Translational power, mean (mW)"),
            ("lift_added_mass_mean_mn", "mN", "Added mass lift, mean (mN)"),
            ("current_1_rms_ma", "mA", "Current 1, rms (mA)"),
            ("field_max_v_per_um", "V/um", "Field, largest (V/µm)"),
            ("strain_surface_max", "", "Surface strain, largest"),
            ("resonance_second_hz", "Hz", "Resonance, second (Hz)"),
            ("drive_second_harmonic", "", "Drive, second harmonic"),
            ("drive_third_harmonic", "", "Drive, third harmonic"),
            ("drive_third_phase", "rad", "Drive, third phase (rad)"),
            ("air_density", "kg/m^3", "Air density (kg/m³)"),
            ("energy_audit", "", "Energy audit"),
            ("drag_coefficient_max", "", "Drag coefficient, largest"),
            ("force_factor", "", "Force factor"),
            ("force_up_mn", "mN", "Up force (mN)"),
            ("torque_roll_unm", "uN*m", "Roll torque (µN·m)"),
            ("lift_slope", "", "Lift slope"),
            ("mode_1_hz", "Hz", "Mode 1 (Hz)"),
            ("mean", "", "Mean"),
            ("_", "", ""),
            ("", "", ""),
        ] {
            assert_eq!(with_unit(name, unit).text(), text, "{name}");
        }
    }

    #[test]
    fn units_are_those_of_models_and_of_endings() {
        let models = flap_core::simulate::all();
        assert_eq!(unit_of("hinge_stiffness", models), "N*m/rad");
        assert_eq!(unit_of("lift_mean_mn", models), "mN");
        assert_eq!(unit_of("my_own_ms", models), "ms");
        assert_eq!(unit_of("rhs_evals", models), "");
        // Without the model, the unit of a parameter is unknown.
        assert_eq!(unit_of("hinge_stiffness", &[]), "");
        assert_eq!(unit_of("lift_mean_mn", &[]), "mN");
        assert_eq!(unit_of("d_lift_mean_mn_per_pct_hinge_stiffness", models), "mN/%");
        assert_eq!(unit_of("d_strain_max_per_si_hinge_stiffness", models), "1/(N*m/rad)");
        // The unit of a parameter that belongs to no model is unknown.
        assert_eq!(unit_of("d_lift_mean_mn_per_si_zzz", models), "");
    }

    #[test]
    fn benefits_and_costs_have_directions() {
        assert_eq!(better("lift_mean_mn"), Some(Direction::Larger));
        assert_eq!(better("power_mean_mw"), Some(Direction::Smaller));
        assert_eq!(better("drive_frequency"), None);
        assert_eq!(better("hover_growth_1_s"), Some(Direction::Smaller));
        assert_eq!(better("hover_period_s"), None);
        assert_eq!(better("force_up_mn"), Some(Direction::Larger));
        assert_eq!(better("force_left_mn"), None);
        assert_eq!(better("torque_yaw_unm"), None);
        assert_eq!(better(""), None);
    }

    #[test]
    fn units_are_printed_as_in_books() {
        for (unit, text) in [
            ("uN*m/rad", "µN·m/rad"),
            ("V/um", "V/µm"),
            ("m^-12", "m⁻¹²"),
            ("m^4", "m⁴"),
            ("u", "u"),
            ("", ""),
        ] {
            assert_eq!(printed(unit), text);
        }
    }

    #[test]
    fn small_and_large_values_have_prefixes() {
        for (value, unit, shown, text) in [
            (8.64e-5, "N*m/rad", 86.4, "µN·m/rad"),
            (1.4972e-6, "N*m/rad", 1.4972, "µN·m/rad"),
            (0.0324, "m", 32.4, "mm"),
            (5.459e-5, "m^2", 54.59, "mm²"),
            (5.11e-11, "kg*m^2", 51.1, "mg·mm²"),
            (8e-5, "kg", 80.0, "mg"),
            (6.2e10, "Pa", 62.0, "GPa"),
            (3.2e-10, "m/V", 320.0, "pm/V"),
            (1e-15, "F", 1e-3, "pF"),
            (0.02, "s", 20.0, "ms"),
            (197.7, "N/m", 197.7, "N/m"),
            (120.0, "Hz", 120.0, "Hz"),
            (PI / 6.0, "rad", 30.0, "°"),
            (0.0, "m", 0.0, "m"),
            (0.5, "", 0.5, ""),
            (1e-3, "mN", 1e-3, "mN"),
        ] {
            let scale = scale(unit, value);
            assert!((value * scale.factor - shown).abs() <= 1e-12 * shown, "{value} {unit}");
            assert_eq!(scale.unit, text, "{value} {unit}");
        }
    }
}
