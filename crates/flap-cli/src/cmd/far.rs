//! Values far from the preset's, which have seldom been meant.

use flap_sweep::study::deviation::Deviation;

use crate::console;

/// Tells of each parameter that is far from the preset's value.
pub(crate) fn warn(deviations: &[Deviation]) {
    for warning in deviations.iter().filter_map(Deviation::warning) {
        console::warn(&warning);
    }
}
