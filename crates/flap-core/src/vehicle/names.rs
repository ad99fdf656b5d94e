//! The meaning of the names of a vehicle's parameters.

use super::mount::DIFFERENCE;
use super::parameters::may_differ;
use crate::parameter::{Kind, Parameter};

/// The parameter of all wings whose value a wing's own one has where it is not set; `None` of other parameters.
pub fn of_all_wings(parameters: &[Parameter], index: usize) -> Option<usize> {
    let Kind::Following(_, follows) = parameters[index].kind else { return None };
    let wing = parameters[index].name.strip_suffix(follows)?;
    if wing.ends_with('_') { Parameter::index(parameters, follows) } else { None }
}

/// The value of a parameter at a point: of a wing's own one that is not set, that of all wings.
pub fn standing(parameters: &[Parameter], values: &[f64], index: usize) -> f64 {
    let shared = of_all_wings(parameters, index).filter(|_| values[index].is_nan());
    values[shared.unwrap_or(index)]
}

/// The reason why a vehicle with these parameters has none called `name`, where the name says what was meant: a choice or the
/// frequency of one wing, a difference of wings of one side, a phase. `None` if these are not the parameters of a vehicle.
pub fn why_absent(parameters: &[Parameter], name: &str) -> Option<String> {
    if !parameters.iter().any(|known| known.name == "about_x") {
        return None;
    }
    if is_phase(parameters, name) {
        return Some(
            "a drive has no phase of its own: the phase between wings changes no mean force or torque"
                .to_owned(),
        );
    }
    parameters.iter().enumerate().find_map(|(index, known)| {
        let first = name.strip_suffix(known.name)?.strip_suffix('_')?;
        if !may_differ(known) && (first == DIFFERENCE || is_wing(parameters, first)) {
            let what = if let Kind::Choice(_) = known.kind { "choices are" } else { "the frequency is" };
            return Some(format!("{what} common to all wings: write `{}`", known.name));
        }
        let has_own = (0..parameters.len()).any(|own| of_all_wings(parameters, own) == Some(index));
        (first == DIFFERENCE && has_own).then(|| {
            "a left-right difference needs wings on both sides: some with mirrored = true, and some without"
                .to_owned()
        })
    })
}

fn is_wing(parameters: &[Parameter], name: &str) -> bool {
    parameters.iter().any(|known| known.name.strip_suffix("_position_x") == Some(name))
}

/// True if the name is that of a drive's phase: of all wings, of one, or of a difference.
fn is_phase(parameters: &[Parameter], name: &str) -> bool {
    let Some(first) = name.strip_suffix("phase_difference").or(name.strip_suffix("phase")) else {
        return false;
    };
    let first = first.strip_suffix("drive_").unwrap_or(first);
    first.is_empty()
        || first.strip_suffix('_').is_some_and(|first| first == DIFFERENCE || is_wing(parameters, first))
}
