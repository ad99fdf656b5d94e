//! Warnings about values that are far from the values of the preset. Values that are far from the preset are usually
//! mistakes.

use flap_sweep::study::deviation::Deviation;

use crate::console;

/// Prints a warning for each parameter whose value is far from the value of the preset.
pub(crate) fn warn(deviations: &[Deviation]) {
    for warning in deviations.iter().filter_map(Deviation::warning) {
        console::warn(&warning);
    }
}
