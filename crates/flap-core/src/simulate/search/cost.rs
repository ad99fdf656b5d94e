//! The cost of a search.

use crate::ode::Outcome;

/// The cost of a search, but for the periods of its last march.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cost {
    periods: u32,
    rhs_evals: u64,
}

impl Cost {
    /// Adds periods of a march that are counted nowhere else.
    pub(super) fn add_march(&mut self, periods: u32) {
        self.periods += periods;
    }

    /// Adds the right-hand sides of periods that the march counts.
    pub(super) fn add_marched(&mut self, outcome: Outcome) {
        self.rhs_evals += outcome.rhs_evals;
    }

    /// Adds a period that was integrated `times` times: once, or with its responses as well.
    pub(super) fn add_period(&mut self, outcome: Outcome, times: u32) {
        self.periods += times;
        self.rhs_evals += outcome.rhs_evals * u64::from(times);
    }

    /// Drive periods integrated.
    pub(super) fn periods(&self) -> u32 {
        self.periods
    }

    /// Right-hand sides evaluated.
    pub(super) fn rhs_evals(&self) -> u64 {
        self.rhs_evals
    }
}
