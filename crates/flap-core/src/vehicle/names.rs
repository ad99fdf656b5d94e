//! The meaning of the names of a vehicle's parameters.

use crate::parameter::{Kind, Parameter};

/// The parameter of all wings whose value a wing's own one has where it is not set; `None` of other parameters.
pub fn of_all_wings(parameters: &[Parameter<'_>], index: usize) -> Option<usize> {
    let Kind::Following(_, follows) = parameters[index].kind else { return None };
    let wing = parameters[index].name.strip_suffix(follows)?;
    if wing.ends_with('_') { Parameter::index(parameters, follows) } else { None }
}

/// The value of a parameter at a point: of a wing's own one that is not set, that of all wings.
pub fn standing(parameters: &[Parameter<'_>], values: &[f64], index: usize) -> f64 {
    let shared = of_all_wings(parameters, index).filter(|_| values[index].is_nan());
    values[shared.unwrap_or(index)]
}
