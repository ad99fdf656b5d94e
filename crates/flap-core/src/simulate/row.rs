//! Rows: results of points, with their statuses and columns.

use core::fmt::Display;

use crate::model::{Model, OverWings, SignalSet};

/// Result of one point's run.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The result in one word.
    pub status: Status,
    /// One value per column of the model if the point is on an orbit of one drive period, otherwise empty.
    pub measures: Vec<f64>,
    /// Drive periods integrated, measuring included.
    pub cycles: u32,
    /// Change of the strobed state over the last orbit period, or over half a period of a symmetric orbit, in units of each
    /// state's typical size.
    /// NaN if no period was completed.
    pub residual: f64,
    /// Drive periods per orbit: 1, or more for a subharmonic; 0 if no orbit was found.
    pub period: u32,
    /// Largest modulus of the orbit's Floquet multipliers: a change of the state grows or decays by this factor per
    /// orbit in the end. Its error is larger than that of the measures, see `docs/models/numerics.md`. NaN without an orbit, and for a wing at rest: forces that go with the square of a speed have
    /// no linear part there.
    pub floquet_max: f64,
    /// Estimate of the largest relative error that the integration makes in the model's
    /// [principal measures](crate::model::Principal), such as stroke, pitch, lift and power: see `docs/models/numerics.md`. Infinite if it cannot be estimated, NaN without measures.
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

/// Result of a point's run in one word.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// Settled on an orbit with the period of the drive.
    Periodic,
    /// On an orbit with the period of the drive that motions leave. No motion settles there: it is found where a branch of
    /// orbits is continued, and has measures.
    Unstable,
    /// Settled on an orbit of two or more drive periods.
    Subharmonic,
    /// Not settled within `max_cycles`.
    Unsettled,
    /// The state became infinite or not a number.
    Diverged,
    /// More than `max_steps` integration steps in one drive period, or steps too small to advance time.
    StepLimit,
    /// The parameters are impossible together.
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

    /// The word in the `status` column.
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
    /// Unit in words as printed by `flap models`, such as `mN`.
    pub unit: &'static str,
    /// One line of meaning.
    pub doc: String,
    /// The way in which the rows of a vehicle have it.
    pub over_wings: OverWings,
}

/// The columns of a model: its signals' measures, then the values derived from them.
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
