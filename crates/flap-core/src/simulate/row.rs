//! Rows: results of points.

use core::fmt::Display;

use super::status::Status;

/// Result of one point's run.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The result in one word.
    pub status: Status,
    /// One value per column of the model if the point is on an orbit of one drive period, otherwise empty.
    pub measures: Vec<f64>,
    /// Drive periods integrated, measuring included.
    pub cycles: u32,
    /// Change of the strobed state over the last orbit period, in units of each state's typical size.
    /// NaN if no period was completed.
    pub residual: f64,
    /// Drive periods per orbit: 1, or more for a subharmonic; 0 if no orbit was found.
    pub period: u32,
    /// Largest modulus of the orbit's Floquet multipliers: a change of the state grows or decays by this factor per
    /// orbit in the end. Its error is larger than that of the measures, see `docs/numerics.md`. NaN without an orbit, and for a wing at rest: forces that go with the square of a speed have
    /// no linear part there.
    pub floquet_max: f64,
    /// Estimate of the largest relative error that the integration makes in the model's
    /// [principal measures](crate::model::Principal), such as stroke, pitch, lift and power: see `docs/numerics.md`. Infinite if it cannot be estimated, NaN without measures.
    pub error_estimate: f64,
    /// The state at the end of the last drive period, on the orbit if there is one. Empty if no period was completed.
    pub state: Vec<f64>,
    /// Right-hand sides evaluated by the integrator.
    pub rhs_evals: u64,
    /// The reason why the parameters are invalid.
    pub reason: Option<String>,
}

impl Row {
    /// A row that says nothing but its status: no period has been completed.
    pub(super) fn empty(status: Status) -> Row {
        Row {
            status,
            measures: Vec::new(),
            cycles: 0,
            residual: f64::NAN,
            period: 0,
            floquet_max: f64::NAN,
            error_estimate: f64::NAN,
            state: Vec::new(),
            rhs_evals: 0,
            reason: None,
        }
    }

    /// The row of a point whose parameters are impossible together, with the reason.
    pub fn invalid(reason: impl Display) -> Row {
        Row { reason: Some(reason.to_string()), ..Row::empty(Status::Invalid) }
    }

    /// True if motions near the orbit approach it; `None` without an orbit.
    pub fn stable(&self) -> Option<bool> {
        match (self.period, self.floquet_max.is_nan()) {
            (0, _) => None,
            // At rest: without drive every motion dies away.
            (_, true) => Some(true),
            (_, false) => Some(self.floquet_max < 1.0),
        }
    }
}
