//! The progress of a run.

/// The progress of a run, in points of a sweep or in designs of a response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Points that have run or are excluded, whether their rows are written yet or not.
    pub finished: u64,
    /// Points that are run in all.
    pub points: u64,
}
