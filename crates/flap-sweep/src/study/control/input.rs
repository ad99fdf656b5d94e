//! The inputs of a vehicle by name.

use flap_core::parameter::{Kind, Parameter};
use flap_core::vehicle::Vehicle;

use crate::plan::gradient;

/// Words for the parameters of a drive: each with the names that models have for it.
pub const WORDS: [(&str, &[&str]); 6] = [
    ("amplitude", &["drive_voltage_pp"]),
    ("bias", &["drive_offset", "drive_bias"]),
    ("frequency", &["drive_frequency"]),
    ("second_harmonic", &["drive_second_harmonic"]),
    ("second_phase", &["drive_second_phase"]),
    ("third_harmonic", &["drive_third_harmonic"]),
];

/// The last part of the names of differences in words.
const DIFFERENCE: &str = "_difference";

/// An input of a vehicle: one of its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// The name as given: a parameter, or a word such as `bias_difference`.
    pub name: String,
    /// Index in the vehicle's parameter table.
    pub parameter: usize,
    /// Unit in which people give it: such as `V`, `deg`, or empty.
    pub unit: &'static str,
    /// That unit in SI.
    pub factor: f64,
}

/// The reason why there is no such input.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InputError {
    /// The vehicle has no such parameter.
    #[error("the vehicle has no input `{0}`")]
    Unknown(String),
    /// The parameter is a choice.
    #[error("`{0}` is a choice, not an input")]
    Choice(String),
}

impl Input {
    /// The input called `name`: a parameter of the vehicle, or one of [`WORDS`], alone for all wings, behind the name of a
    /// wing for that one (`left_bias`), or in front of `_difference` for the left-right difference.
    ///
    /// # Errors
    /// If there is none.
    pub fn of(vehicle: &Vehicle, name: &str) -> Result<Input, InputError> {
        let parameters = parameters(vehicle);
        let unknown = || InputError::Unknown(name.to_owned());
        let index = names(vehicle, name)
            .iter()
            .find_map(|name| Parameter::index(parameters, name))
            .ok_or_else(unknown)?;
        let parameter = &parameters[index];
        if let Kind::Choice(_) = parameter.kind {
            return Err(InputError::Choice(name.to_owned()));
        }
        let (unit, factor) = match parameter.unit {
            "rad" => ("deg", 1.0_f64.to_radians()),
            "m" => ("mm", 1e-3),
            "kg" => ("mg", 1e-6),
            unit => (unit, 1.0),
        };
        Ok(Input { name: name.to_owned(), parameter: index, unit, factor })
    }

    /// The inputs that a vehicle has by default: amplitude, bias and, if its drive has harmonics, the second one; each for all
    /// wings and, where there are a left and a right one, as a difference.
    pub fn usual(vehicle: &Vehicle, has_harmonics: bool) -> Vec<Input> {
        let words = ["amplitude", "bias", "second_harmonic"];
        let words = if has_harmonics { &words[..] } else { &words[..2] };
        let names = words.iter().flat_map(|word| [(*word).to_owned(), format!("{word}{DIFFERENCE}")]);
        names.filter_map(|name| Input::of(vehicle, &name).ok()).collect()
    }

    /// All names of inputs, for suggestions.
    pub fn names(vehicle: &Vehicle) -> Vec<String> {
        let words = WORDS.iter().flat_map(|(word, _)| {
            let of_wings = vehicle.mounts().iter().map(move |mount| format!("{}_{word}", mount.name));
            [(*word).to_owned(), format!("{word}{DIFFERENCE}")].into_iter().chain(of_wings)
        });
        let words = words.filter(|name| Input::of(vehicle, name).is_ok());
        let parameters = parameters(vehicle).iter();
        let numbers = parameters.filter(|parameter| !matches!(parameter.kind, Kind::Choice(_)));
        words.chain(numbers.map(|parameter| parameter.name.to_owned())).collect()
    }

    /// The size of its parameter (SI), from which changes are measured; `None` if it is not known.
    pub(super) fn size(&self, vehicle: &Vehicle, values: &[f64]) -> Option<f64> {
        gradient::size(vehicle, values, self.parameter).map(f64::abs)
    }
}

/// The vehicle's parameter table.
pub(super) fn parameters(vehicle: &Vehicle) -> &[Parameter<'_>] {
    use flap_core::simulate::Simulator as _;
    vehicle.parameters()
}

/// The parameters that a name may stand for.
fn names(vehicle: &Vehicle, name: &str) -> Vec<String> {
    let mut names = vec![name.to_owned()];
    let mut add = |word: &str, first: &str| {
        let known = WORDS.iter().find(|(known, _)| *known == word);
        names.extend(
            known.iter().flat_map(|(_, of_models)| of_models.iter().map(|one| format!("{first}{one}"))),
        );
    };
    add(name, "");
    if let Some(word) = name.strip_suffix(DIFFERENCE) {
        add(word, "difference_");
    }
    for mount in vehicle.mounts() {
        if let Some(word) = name.strip_prefix(&format!("{}_", mount.name)) {
            add(word, &format!("{}_", mount.name));
        }
    }
    names
}
