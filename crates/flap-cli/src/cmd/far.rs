//! Warnings about values far from the preset's. Most such values are mistakes.

use flap_sweep::study::deviation::Deviation;

use crate::console;

/// Prints a warning for each parameter that is far from the preset's value.
pub(crate) fn warn(deviations: &[Deviation]) {
    for warning in deviations.iter().filter_map(Deviation::warning) {
        console::warn(&warning);
    }
}
