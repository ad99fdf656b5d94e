//! The parameters whose values are written with units.

use std::collections::BTreeSet;

/// The parameters whose values a file writes with their units, such as `"17 mm"`.
#[derive(Clone, Debug, Default)]
pub(crate) struct WithUnits(BTreeSet<usize>);

impl WithUnits {
    /// True if the value of the parameter is written with its unit.
    pub(crate) fn contain(&self, parameter: usize) -> bool {
        self.0.contains(&parameter)
    }

    /// Notes of a new value of the parameter whether it has its unit; `None` for what leaves the value as it is.
    pub(crate) fn note(&mut self, parameter: usize, has_unit: Option<bool>) {
        match has_unit {
            Some(true) => _ = self.0.insert(parameter),
            Some(false) => _ = self.0.remove(&parameter),
            None => {}
        }
    }
}
