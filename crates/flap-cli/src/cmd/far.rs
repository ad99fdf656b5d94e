//! Warnings about values that are far from the values of the preset. Most such values are mistakes.

use flap_sweep::study::deviation::Deviation;

use crate::console;

/// Prints a warning for each parameter whose value is far from the value of the preset.
pub(crate) fn warn(deviations: &[Deviation]) {
    for warning in deviations.iter().filter_map(Deviation::warning) {
        console::warn(&warning);
    }
}
