//! Names that a vehicle has no parameters for, although they say what was meant.

use flap_core::parameter::{Kind, Parameter};
use flap_core::vehicle::{DIFFERENCE, Vehicle, of_all_wings};

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
        if !Vehicle::may_differ(known) && (first == DIFFERENCE || is_wing(parameters, first)) {
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
