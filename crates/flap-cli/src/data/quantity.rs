//! Numbers with units in comparisons: `drive_frequency > 95 Hz`.

use flap_sweep::notation::UserError;
use flap_sweep::notation::quantity::{self, Quantity, quantities};
use flap_sweep::table::labels;

use super::columns;
use crate::failure::Failure;

/// Returns the comparison `text` without units: each number is converted to the unit of the column with which the
/// number is compared.
///
/// # Errors
/// `Usage` for a number with a unit that is compared with no column, or with a column of another dimension.
pub(super) fn without_units(
    text: &str,
    names: &[String],
    unit_of: impl Fn(usize) -> String,
) -> Result<String, Failure> {
    let unit = |name: &str| columns::find(names.iter().map(String::as_str), name).map(&unit_of);
    quantity::without_units(text, unit, |error| {
        let message = format!("--where {text}: {error}");
        Failure::from(UserError { message, ..error })
    })
}

/// Returns the comparison `text` with printed units, such as `µN·m/rad`.
pub(crate) fn printed(text: &str) -> String {
    let mut shown = String::new();
    let mut copied = 0;
    for Quantity { number, unit, .. } in quantities(text) {
        shown += &text[copied..number.end];
        shown += " ";
        shown += &labels::printed(&text[unit.clone()]);
        copied = unit.end;
    }
    shown + &text[copied..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_printed_as_in_books() {
        assert_eq!(printed("hinge_stiffness > 90 uN*m/rad"), "hinge_stiffness > 90 µN·m/rad");
        assert_eq!(printed("x2 > 1"), "x2 > 1");
    }
}
