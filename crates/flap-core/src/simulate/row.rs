//! Rows: results of points, with statuses and columns.

use core::fmt::Display;

use crate::model::{Model, OverWings, SignalSet};

/// Result of one point.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Result in one word.
    pub status: Status,
    /// One value per column of the model if the point is on an orbit of one drive period, otherwise empty.
    pub measures: Vec<f64>,
    /// Number of integrated drive periods, including the measured ones.
    pub cycles: u32,
    /// Change of the strobed state over the last orbit period, in units of each state's typical size.
    ///
    /// For a symmetric orbit it is the change over half a period. NaN if no period was completed.
    pub residual: f64,
    /// Length of the orbit in drive periods: 1, or more for a subharmonic; 0 if no orbit was found.
    pub period: u32,
    /// Largest modulus of the orbit's Floquet multipliers.
    ///
    /// A small change of the state grows or decays by this factor per orbit in the long run.
    ///
    /// Its error is larger than the errors of the measures, see `docs/models/numerics.md`. NaN without an orbit, and
    /// for a wing at rest: forces proportional to the square of a speed have no linear part there.
    pub floquet_max: f64,
    /// Estimate of the largest relative integration error of the model's [principal
    /// measures](crate::model::Principal), such as stroke, pitch, lift and power.
    ///
    /// See `docs/models/numerics.md`. Infinite if it cannot be estimated, NaN without measures.
    pub error_estimate: f64,
    /// State at the end of the last drive period, on the orbit if there is one. Empty if no period was completed.
    pub state: Vec<f64>,
    /// Number of right-hand sides evaluated by the integrator.
    pub rhs_evals: u64,
    /// Reason for invalid parameters.
    pub reason: Option<String>,
}

impl Row {
    /// Returns a row with a status alone, for a point without a completed period.
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

    /// Returns the row of a point with an impossible combination of parameter values, with the reason.
    pub fn invalid(reason: impl Display) -> Row {
        Row { reason: Some(reason.to_string()), ..Row::empty(Status::Invalid) }
    }

    /// Returns true if motions near the orbit approach it; `None` without an orbit.
    pub fn stable(&self) -> Option<bool> {
        match (self.period, self.floquet_max.is_nan()) {
            (0, _) => None,
            // At rest: without drive every motion decays.
            (_, true) => Some(true),
            (_, false) => Some(self.floquet_max < 1.0),
        }
    }
}

/// Result of a point's run in one word.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// Settled on an orbit with the period of the drive.
    Periodic,
    /// On an unstable orbit with the period of the drive. No motion settles there. Continuation of a branch finds
    /// such orbits, and they have measures.
    Unstable,
    /// Settled on an orbit of two or more drive periods.
    Subharmonic,
    /// Not settled within `max_cycles`.
    Unsettled,
    /// The state became infinite or not a number.
    Diverged,
    /// More than `max_steps` integration steps in one drive period, or steps too small to advance time.
    StepLimit,
    /// The combination of parameter values is impossible.
    Invalid,
}

impl Status {
    /// All statuses, in the order of reports.
    pub const ALL: [Status; 7] = [
        Status::Periodic,
        Status::Unstable,
        Status::Subharmonic,
        Status::Unsettled,
        Status::Diverged,
        Status::StepLimit,
        Status::Invalid,
    ];

    /// Returns the word in the `status` column.
    pub fn name(self) -> &'static str {
        match self {
            Status::Periodic => "periodic",
            Status::Unstable => "unstable",
            Status::Subharmonic => "subharmonic",
            Status::Unsettled => "unsettled",
            Status::Diverged => "diverged",
            Status::StepLimit => "step_limit",
            Status::Invalid => "invalid",
        }
    }
}

/// One measured column.
#[derive(Debug, Clone)]
pub struct Column {
    /// Name with its unit, such as `lift_mean_mn`.
    pub name: String,
    /// Unit in words as in `flap models`, such as `mN`.
    pub unit: &'static str,
    /// Description in one line.
    pub doc: String,
    /// Form of this column in the rows of a vehicle.
    pub over_wings: OverWings,
}

/// Returns the columns of a model: the measures of its signals, then the derived columns.
pub(super) fn columns<M: Model<N>, const N: usize>() -> Vec<Column> {
    let measured = M::Signals::TABLE.iter().flat_map(|signal| {
        signal.measures.iter().map(move |measure| Column {
            name: format!("{}_{}_{}", signal.name, measure.name(), signal.unit.suffix),
            unit: signal.unit.name,
            doc: format!("{} {}", measure.describe(), signal.doc),
            over_wings: signal.over_wings(*measure),
        })
    });
    let derived = M::DERIVED.iter().map(|derived| Column {
        name: derived.name.to_owned(),
        unit: derived.unit,
        doc: derived.doc.to_owned(),
        over_wings: derived.over_wings,
    });
    measured.chain(derived).collect()
}
