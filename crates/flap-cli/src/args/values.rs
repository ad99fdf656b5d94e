//! Parsers for the values of options: numbers, quantities, times and assignments.
//!
//! If the text is not a valid value, each function returns the message for the user.

use std::num::NonZeroUsize;
use std::time::Duration;

use flap_core::simulate::Status;
use flap_sweep::notation::{nearest, units};
use flap_sweep::resonance;

/// The value of `--trim` that requires a force equal to the weight, and torques of zero.
pub(crate) const HOVER: &str = "hover";

/// Parses `name=value` and returns both parts without surrounding blanks.
pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=VALUE, such as drive_frequency='120 Hz'")?;
    Ok((name.trim().to_owned(), value.trim().to_owned()))
}

/// A name, and the beginning and the end of a range, as texts.
#[derive(Clone, Debug)]
pub(crate) struct NamedRange {
    pub(crate) name: String,
    pub(crate) from: String,
    pub(crate) to: String,
}

/// Parses `name=from:to` and returns the parts without surrounding blanks.
pub(super) fn named_range(text: &str) -> Result<NamedRange, String> {
    let parts = assignment(text).ok().and_then(|(name, range)| {
        let (from, to) = range.split_once(':')?;
        Some(NamedRange { name, from: from.trim().to_owned(), to: to.trim().to_owned() })
    });
    parts.ok_or_else(|| "write INPUT=FROM:TO, such as bias=-20V:20V".to_owned())
}

/// Parses `name=value` as [`assignment`] does, or the word `hover`, which has no value.
pub(super) fn target(text: &str) -> Result<(String, String), String> {
    if text.trim() == HOVER {
        return Ok((HOVER.to_owned(), String::new()));
    }
    match assignment(text) {
        Ok((name, _)) if name == HOVER => Err("write hover without a value".to_owned()),
        target => target.map_err(|_| "write COLUMN=VALUE, such as torque_pitch=0, or hover".to_owned()),
    }
}

/// Parses a length (m), which must not be negative.
pub(super) fn length(text: &str) -> Result<f64, String> {
    size(text, "m", "2 mm")
}

/// Parses a density (kg/m³), which must not be negative.
pub(super) fn density(text: &str) -> Result<f64, String> {
    size(text, "kg/m^3", "1400 kg/m^3")
}

/// Parses a mass per length (kg/m), which must not be negative.
pub(super) fn line_density(text: &str) -> Result<f64, String> {
    size(text, "kg/m", "20 mg/m")
}

/// Parses a mass (kg) of more than zero.
pub(super) fn mass(text: &str) -> Result<f64, String> {
    size(text, "kg", "0.6 mg").and_then(|mass| {
        if mass > 0.0 { Ok(mass) } else { Err("the mass must be more than zero".to_owned()) }
    })
}

/// Parses a quantity of zero or more and returns it in `unit`, an SI unit.
fn size(text: &str, unit: &str, example: &str) -> Result<f64, String> {
    let number = quantity(text, unit, example)?;
    if number >= 0.0 { Ok(number) } else { Err("expected zero or more".to_owned()) }
}

/// Parses a number of threads from 1 to 1024.
pub(super) fn threads(text: &str) -> Result<NonZeroUsize, String> {
    let number = text.parse::<NonZeroUsize>().ok().filter(|number| number.get() <= 1024);
    number.ok_or_else(|| "expected a whole number from 1 to 1024".to_owned())
}

/// Parses a number of rows, 1 or more.
pub(super) fn rows(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|_| "expected a whole number of 1 or more".to_owned())
}

/// Parses a whole number of 0 or more.
pub(super) fn index(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "expected a whole number of 0 or more".to_owned())
}

/// Parses a finite number greater than 0.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "expected a finite number more than zero".to_owned())
}

/// Parses a whole number from 1 to 2^32 - 1.
pub(super) fn count(text: &str) -> Result<u32, String> {
    let number = text.parse().ok().filter(|number| *number > 0);
    number.ok_or_else(|| format!("expected a whole number from 1 to {}", u32::MAX))
}

/// Parses a finite number.
pub(super) fn finite(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| "expected a finite number, such as 15".to_owned())
}

/// Parses a tolerance greater than 0 and less than 0.1.
pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "expected a number, such as 1e-6".to_owned())?;
    if number > 0.0 && number < 0.1 {
        Ok(number)
    } else {
        Err("must be more than 0 and less than 0.1".into())
    }
}

/// Parses the size of an impulse, an angle with its unit, and returns it in radians.
pub(super) fn impulse(text: &str) -> Result<f64, String> {
    let angle = quantity(text, "rad", "20 deg")?;
    resonance::impulse(angle).map_err(|error| error.line())
}

/// Parses a time with its unit and returns it in seconds.
pub(super) fn time(text: &str) -> Result<f64, String> {
    quantity(text, "s", "50 ms")
}

/// Parses a frequency with or without a unit and returns it in Hz.
pub(super) fn frequency(text: &str) -> Result<f64, String> {
    quantity(text, if units::has_unit(text) { "Hz" } else { "" }, "120 Hz")
}

/// Parses a number with a unit and returns it in `si_unit`.
fn quantity(text: &str, si_unit: &str, example: &str) -> Result<f64, String> {
    units::parse_as(text, si_unit).map_err(|error| {
        format!("{}: write a number with a unit, such as `{example}`", error.message("the value"))
    })
}

/// Parses a time from 0 to a day.
pub(super) fn interval(text: &str) -> Result<Duration, String> {
    let seconds = time(text)?;
    let allowed = Some(seconds).filter(|seconds| (0.0..=86_400.0).contains(seconds));
    allowed.map(Duration::from_secs_f64).ok_or_else(|| "must be from 0 s to 86400 s".to_owned())
}

/// Parses the name of a status.
pub(super) fn status(text: &str) -> Result<Status, String> {
    let found = Status::ALL.into_iter().find(|status| status.name() == text);
    found.ok_or_else(|| {
        let names = Status::ALL.map(Status::name);
        let hint = nearest(text, names).map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
        format!("statuses are {}{hint}", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_have_no_unit_of_another_dimension() {
        assert_eq!([frequency("120"), frequency("0.12 kHz")], [Ok(120.0), Ok(120.0)]);
        for text in ["45 deg", "110%", "3 V", "fast"] {
            assert!(frequency(text).is_err(), "{text}");
        }
    }
}
