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

    /// The meaning in one line, with what to do about it.
    pub fn describe(self) -> &'static str {
        match self {
            Status::Periodic => "settled on an orbit of one drive period; the row has measures",
            Status::Unstable => {
                "an unstable orbit: motions near it move away; only in the branches that `flap respond --unstable` continues"
            }
            Status::Subharmonic => {
                "settled on an orbit of 2 to 8 drive periods, one of which differs from the next: no measures"
            }
            Status::Unsettled => {
                "not settled after max_cycles drive periods: quasi-periodic, chaotic or slow. `flap rerun --status unsettled \
                 --max-cycles N` runs such points longer"
            }
            Status::Diverged => {
                "the state became infinite or not a number: check the parameters against their units"
            }
            Status::StepLimit => {
                "more than max_steps integration steps in one drive period: check the parameters against their units, or \
                 raise max_steps under [solver]"
            }
            Status::Invalid => {
                "the parameters are impossible together, or a derived one is out of its range; `flap run GRID --point N` \
                 prints the reason"
            }
        }
    }

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
