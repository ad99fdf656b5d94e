//! Labels of columns with units that suit the size of the values, such as mm² instead of m².

use flap_sweep::table::labels;

use crate::data::columns::{Cells, Table};
use crate::data::levels::{Levels, Values};

/// The label of a column, and the unit in which a picture shows the numbers of the column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Label {
    /// The name of a column as text, such as `Lift, mean`.
    pub(super) words: String,
    /// The unit in the picture, such as `mN` or `µN·m/rad`. Empty for a column without a unit.
    pub(super) unit: String,
    /// The factor that converts a number in the file into the unit in the picture.
    pub(super) factor: f64,
}

impl Label {
    /// Returns the label of the column `name`, whose numbers are in `unit` and have magnitudes up to
    /// `largest`.
    pub(super) fn new(name: &str, unit: &str, largest: f64) -> Label {
        let labels::Scale { factor, unit: shown } = labels::scale(unit, largest);
        Label { words: labels::with_unit(name, unit).words, unit: shown, factor }
    }

    /// Returns the name of the column with the unit, such as `Lift, mean (mN)`.
    pub(super) fn text(&self) -> String {
        labels::titled(&self.words, &self.unit)
    }

    /// Returns a value as text in the unit of the picture, such as `70 V`.
    pub(super) fn value(&self, value: f64) -> String {
        format!("{} {}", short(value * self.factor), self.unit).trim_end().to_owned()
    }
}

impl Table {
    /// Returns the label of a column. The unit in the label suits the largest number of the column.
    pub(super) fn label(&self, index: usize) -> Label {
        let column = &self.columns[index];
        let largest = match &column.cells {
            Cells::Numbers(values) => values
                .iter()
                .filter(|value| value.is_finite())
                .fold(0.0, |most: f64, value| most.max(value.abs())),
            _ => 0.0,
        };
        Label::new(&column.name, &column.unit, largest)
    }
}

impl Levels {
    /// Returns the value with the index `place` in the list of distinct values, as text with its unit.
    pub(super) fn text(&self, place: usize, label: &Label) -> String {
        match &self.values {
            Values::Numbers(values) => label.value(values[place]),
            Values::Words(words) => words[place].clone(),
        }
    }
}

/// Returns a number as text with at most six digits.
pub(super) fn short(value: f64) -> String {
    digits(value, 6)
}

/// Returns the numbers as text with four digits. If neighbouring numbers then have equal texts, returns five
/// or six digits.
pub(super) fn distinct(values: &[f64]) -> Vec<String> {
    let texts = |most: u8| values.iter().map(|&value| digits(value, most)).collect::<Vec<_>>();
    let is_distinct = |texts: &Vec<String>| texts.windows(2).all(|two| two[0] != two[1]);
    [4, 5].map(texts).into_iter().find(is_distinct).unwrap_or_else(|| texts(6))
}

/// Returns a number as text with at most `most` digits, where `most` is from 1 to 6. Digits before the
/// decimal point are always kept for numbers below 1e6.
pub(super) fn digits(value: f64, most: u8) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value.is_nan() { "none".to_owned() } else { value.to_string().replace("-0", "0") };
    }
    let size = value.abs();
    if !(1e-4..1e6).contains(&size) {
        let text = format!("{value:.*e}", usize::from(most.min(5)) - 1);
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", trimmed(digits));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
    let decimals = (f64::from(most) - 1.0 - size.log10().floor()).clamp(0.0, 9.0) as usize;
    trimmed(&format!("{value:.decimals$}")).to_owned()
}

fn trimmed(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!([digits(133.456, 4), digits(1.0 / 3.0, 4)], ["133.5", "0.3333"]);
        assert_eq!(distinct(&[0.349_774, 0.5]), ["0.3498", "0.5"]);
        assert_eq!(distinct(&[0.349_774, 0.349_781]), ["0.34977", "0.34978"]);
    }
}
