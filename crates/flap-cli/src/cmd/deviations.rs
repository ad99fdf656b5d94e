//! Warnings about parameter values that are far from the values in the preset, because such values are
//! usually mistakes.

use flap_sweep::study::deviation::Deviation;

use crate::console;

/// Prints a warning for each parameter whose value is far from its value in the preset.
pub(crate) fn warn(deviations: &[Deviation]) {
    for warning in deviations.iter().filter_map(Deviation::warning) {
        console::warn(&warning);
    }
}
