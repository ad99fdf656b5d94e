//! Statuses of rows.

/// Result of a point's run in one word.
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
