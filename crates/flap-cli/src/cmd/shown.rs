//! Formats the cells of results files for tables in a terminal, with six digits and suitable units.

use flap_sweep::table::labels;
use flap_sweep::table::labels::split_unit;

use crate::table::six_digits;

/// A unit in which the numbers of a column are easy to read, and the factor that converts numbers into this
/// unit.
pub(super) struct Shown {
    factor: f64,
    unit: String,
}

impl Shown {
    /// Chooses a unit with a suitable prefix for numbers that are given in `unit`.
    pub(super) fn new(unit: &str, numbers: impl IntoIterator<Item = f64>) -> Shown {
        let finite = numbers.into_iter().filter(|number| number.is_finite());
        let largest = finite.fold(0.0, |most: f64, number| most.max(number.abs()));
        let labels::Scale { factor, unit } = labels::scale(unit, largest);
        Shown { factor, unit }
    }

    /// Chooses a unit for the column `name`. If the name of the column ends in a unit, the numbers keep this unit.
    pub(super) fn of_column(name: &str, unit: &str, numbers: impl IntoIterator<Item = f64>) -> Shown {
        let (_, ending) = split_unit(name);
        if !ending.is_empty() && ending == unit {
            return Shown { factor: 1.0, unit: labels::printed(unit) };
        }
        Shown::new(unit, numbers)
    }

    /// Returns the chosen unit. The text is empty for numbers without a unit.
    pub(super) fn unit(&self) -> &str {
        &self.unit
    }

    /// Returns the heading of the column `name`. If the name does not end in the chosen unit, the heading
    /// also contains the unit.
    pub(super) fn heading(&self, name: &str) -> String {
        let (_, ending) = split_unit(name);
        if self.unit.is_empty() || labels::printed(ending) == self.unit {
            name.to_owned()
        } else {
            format!("{name} ({})", self.unit)
        }
    }

    /// Converts a number into the chosen unit and returns it with six digits.
    pub(super) fn number(&self, number: f64) -> String {
        six_digits(number * self.factor)
    }

    /// Returns a cell as text: a number in the chosen unit with six digits, or a word unchanged.
    pub(super) fn cell(&self, cell: &str) -> String {
        let is_kept = self.factor == 1.0 && cell.parse::<u64>().is_ok();
        match cell.parse() {
            Ok(number) if !is_kept => self.number(number),
            _ => cell.to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_have_a_unit_once() {
        let heading = |name: &str, unit: &str, largest| Shown::new(unit, [largest]).heading(name);
        assert_eq!(heading("lift_mean_mn", "mN", 1.0), "lift_mean_mn");
        assert_eq!(heading("stroke_pp_deg", "deg", 80.0), "stroke_pp_deg");
        assert_eq!(heading("hinge_stiffness", "N*m/rad", 6e-5), "hinge_stiffness (µN·m/rad)");
        assert_eq!(heading("status", "", f64::NAN), "status");
        let stroke = Shown::of_column("stroke_rad", "rad", [0.7]);
        assert_eq!((stroke.unit(), stroke.number(0.7).as_str()), ("rad", "0.7"));
    }

    #[test]
    fn cells_keep_whole_numbers_and_words() {
        let shown = Shown::new("N*m/rad", [1.6e-4, f64::NAN]);
        assert_eq!(shown.cell("8.64e-5"), "86.4");
        let modulus = Shown::new("Pa", [62e9]);
        assert_eq!((modulus.unit(), modulus.cell("62000000000").as_str()), ("GPa", "62.0"));
        let plain = Shown::new("", []);
        assert_eq!(["12", "", "up", "inf"].map(|cell| plain.cell(cell)), ["12", "", "up", "inf"]);
    }
}
