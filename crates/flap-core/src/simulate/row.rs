//! The row of a design point: its status, its measures, and the names of the measured columns.

use core::fmt::Display;

use crate::model::{Model, OverWings, SignalSet};

/// Result of one point.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Result in one word.
    pub status: Status,
    /// One value for each column of the model. The list is empty if flap found no orbit of one drive period.
    pub measures: Vec<f64>,
    /// Number of integrated drive periods, including the periods for the measures.
    pub cycles: u32,
    /// Largest change of a state over the last period of the orbit, in units of the state's typical size.
    ///
    /// For a symmetric orbit, the residual is the distance between the initial state and the mirrored state
    /// half a period later. The residual is NaN if no drive period was completed.
    pub residual: f64,
    /// Length of the orbit in drive periods: 1, or 2 and more for a subharmonic orbit. The length is 0 if no
    /// orbit was found.
    pub period: u32,
    /// Largest modulus of the orbit's Floquet multipliers: the factor per orbit by which a small change of
    /// the state grows or decays after many orbits.
    ///
    /// The error of the modulus is larger than the errors of the measures, see `docs/models/numerics.md`. The
    /// modulus is NaN if no orbit was found, or if the wing is at rest and the modulus does not clearly exceed 1.
    /// In still air, the drag on a wing at rest has no linear part, so only rounding errors decide if the
    /// modulus is below 1.
    pub floquet_max: f64,
    /// Estimate of the largest relative integration error of the model's [principal
    /// measures](crate::model::Principal), such as stroke, pitch, lift and power.
    ///
    /// See `docs/models/numerics.md`. The estimate is infinite if the error cannot be estimated, and NaN if
    /// the row has no measures.
    pub error_estimate: f64,
    /// State at the end of the last drive period. If flap found an orbit, this state is on the orbit. The
    /// list is empty if no drive period was completed.
    pub state: Vec<f64>,
    /// Number of evaluations of the right-hand side by the integrator.
    pub rhs_evals: u64,
    /// Reason why the parameter values are impossible.
    pub reason: Option<String>,
}

impl Row {
    /// Returns a row that contains only a status. All values except the status are missing or zero.
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

    /// Returns the row of a point whose combination of parameter values is impossible. The row contains the
    /// `reason`.
    pub fn invalid(reason: impl Display) -> Row {
        Row { reason: Some(reason.to_string()), ..Row::empty(Status::Invalid) }
    }

    /// Returns true if motions near the orbit approach the orbit. Returns `None` if the row has no orbit.
    pub fn stable(&self) -> Option<bool> {
        match (self.period, self.floquet_max.is_nan()) {
            (0, _) => None,
            // At rest: without drive every motion decays.
            (_, true) => Some(true),
            (_, false) => Some(self.floquet_max < 1.0),
        }
    }
}

/// Result of the simulation of a point in one word.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// The motion has settled on an orbit of one drive period.
    Periodic,
    /// The row describes an unstable orbit of one drive period. No motion settles on an unstable orbit. The
    /// continuation of a branch finds unstable orbits, and the rows of these orbits have measures.
    Unstable,
    /// The motion has settled on an orbit of two or more drive periods.
    Subharmonic,
    /// The motion has not settled within `max_cycles` drive periods.
    Unsettled,
    /// The state became infinite or not a number.
    Diverged,
    /// One drive period needs more than `max_steps` integration steps, or the integration needs steps that
    /// are too small.
    StepLimit,
    /// The combination of parameter values is impossible.
    Invalid,
}

impl Status {
    /// All statuses, in the order in which reports list the statuses.
    pub const ALL: [Status; 7] = [
        Status::Periodic,
        Status::Unstable,
        Status::Subharmonic,
        Status::Unsettled,
        Status::Diverged,
        Status::StepLimit,
        Status::Invalid,
    ];

    /// Returns the word for this status in the column `status` of a row.
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

/// The description of one column with a measure.
#[derive(Debug, Clone)]
pub struct Column {
    /// Name of the column, which ends with the unit, such as `lift_mean_mn`.
    pub name: String,
    /// Unit as `flap models` prints it, such as `mN`.
    pub unit: &'static str,
    /// Description in one line.
    pub doc: String,
    /// Columns in the rows of a vehicle that are computed from this column in the rows of the wings.
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
