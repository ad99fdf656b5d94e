//! Settings of the integrator and of the search for orbits, with their defaults and allowed values.

use crate::ode::Tolerances;

/// Settings of the integrator, and the conditions under which a point counts as settled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverSettings {
    /// Relative tolerance of the integrator, per step and component.
    pub rtol: f64,
    /// Absolute tolerance, in units of each state's typical size in the model.
    pub atol: f64,
    /// A point is settled when its state, strobed once per drive period, changes by less than this
    /// (in units of each state's typical size).
    pub settle_tol: f64,
    /// Drive periods after which a point counts as unsettled.
    pub max_cycles: u32,
    /// Integration steps within one drive period after which a point is given up.
    pub max_steps: u32,
    /// Largest [`error_estimate`](super::Row::error_estimate) and energy audit of a row. A point whose row exceeds it is
    /// integrated again with tighter tolerances, up to a limit.
    pub accuracy: f64,
    /// Newton's iteration on the period map looks for the orbit to which a motion is on its way. Without it, points
    /// settle by marching alone: to the same orbits, in more periods.
    pub newton: bool,
}

impl SolverSettings {
    /// The defaults.
    pub const DEFAULT: SolverSettings = SolverSettings {
        rtol: 1e-6,
        atol: 1e-8,
        settle_tol: 1e-6,
        max_cycles: 1000,
        max_steps: 20_000,
        accuracy: 1e-3,
        newton: true,
    };

    /// These settings with another relative tolerance, and with the settings that follow it by default: `atol`, a
    /// hundredth of it, and `accuracy`, a thousand times as much but at least 1e-3.
    pub fn with_rtol(self, rtol: f64) -> SolverSettings {
        SolverSettings { rtol, atol: rtol / 100.0, accuracy: (1000.0 * rtol).max(1e-3), ..self }
    }

    /// The tolerances and limits of the integrator.
    pub(super) fn tolerances(&self) -> Tolerances {
        Tolerances { rtol: self.rtol, atol: self.atol, max_steps: self.max_steps }
    }
}

impl Default for SolverSettings {
    fn default() -> Self {
        SolverSettings::DEFAULT
    }
}
