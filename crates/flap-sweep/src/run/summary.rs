//! The summary of a run.

use std::iter::Sum;

use flap_core::simulate::{Column, Row, Status};
use serde::{Deserialize, Serialize};

use crate::plan::Plan;
use crate::resonance::RESONANCE_MARGIN_HZ;

/// The number of rows with each status.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts([u64; Status::ALL.len()]);

impl Counts {
    /// Rows with this status.
    pub fn of(&self, status: Status) -> u64 {
        self.0[status as usize]
    }

    /// Every status with its count, in the order of reports.
    pub fn iter(&self) -> impl Iterator<Item = (Status, u64)> + '_ {
        Status::ALL.iter().map(|&status| (status, self.of(status)))
    }
}

impl FromIterator<(Status, u64)> for Counts {
    fn from_iter<I: IntoIterator<Item = (Status, u64)>>(iter: I) -> Counts {
        let mut counts = Counts::default();
        iter.into_iter().for_each(|(status, count)| counts.0[status as usize] += count);
        counts
    }
}

/// Rows with measures that are to be read with care.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Doubts {
    /// Rows whose error estimate exceeds the accuracy that was asked for.
    pub inaccurate: u64,
    /// Rows whose mean electrical power is negative: the air gives the wing more energy than it takes.
    pub powerless: u64,
    /// Rows whose resonance is at an end of the range in which it was looked for.
    pub at_range_end: u64,
}

impl Sum for Doubts {
    fn sum<I: Iterator<Item = Doubts>>(all: I) -> Doubts {
        all.fold(Doubts::default(), |sum, one| Doubts {
            inaccurate: sum.inaccurate + one.inaccurate,
            powerless: sum.powerless + one.powerless,
            at_range_end: sum.at_range_end + one.at_range_end,
        })
    }
}

/// The summary of a run, so far or finished. Counts are over the rows written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Points that are run in all; of a response, designs.
    pub points: u64,
    /// Points all of whose rows are written.
    pub ran: u64,
    /// Rows written of the point after those that are done with: the first ones of a response's curve.
    pub begun: u64,
    /// Rows written: those of the first points selected, but for excluded ones.
    pub rows: u64,
    /// Points among them that were excluded, and have no row.
    pub excluded: u64,
    /// The conditions of the plan, each with the number of these points that do not satisfy it.
    pub unsatisfied: Vec<(String, u64)>,
    /// True if the run was stopped before the last point.
    pub interrupted: bool,
    /// Rows by status.
    pub counts: Counts,
    /// Right-hand sides evaluated in all.
    pub rhs_evals: u64,
    /// Drive periods integrated in all.
    pub cycles: u64,
    /// Rows to be read with care.
    pub doubts: Doubts,
    /// The first few invalid points, each with the reason.
    pub invalid: Vec<(u64, String)>,
}

impl Summary {
    /// Reasons kept in [`Summary::invalid`].
    pub const MOST_REASONS: usize = 5;

    /// The summary `before` as the beginning of that of `plan`.
    pub(super) fn after(before: Summary, plan: &Plan) -> Summary {
        let counted = |name: &str| before.unsatisfied.iter().find(|(known, _)| known == name);
        let unsatisfied = plan.conditions().iter().map(|condition| {
            let count = counted(&condition.name).map_or(0, |(_, count)| *count);
            (condition.name.clone(), count)
        });
        Summary { unsatisfied: unsatisfied.collect(), interrupted: false, ..before }
    }

    /// Points that are done with: the first ones of those selected.
    pub fn done(&self) -> u64 {
        self.ran + self.excluded
    }

    /// Notes a point that does not satisfy the conditions with these numbers.
    pub(super) fn exclude(&mut self, unsatisfied: &[usize]) {
        self.excluded += 1;
        for &condition in unsatisfied {
            self.unsatisfied[condition].1 += 1;
        }
    }

    /// Adds the written row of the point with this index in the plan.
    pub(super) fn add(&mut self, index: u64, row: &Row) {
        if let (Status::Invalid, Some(reason)) = (row.status, &row.reason)
            && self.invalid.len() < Summary::MOST_REASONS
        {
            self.invalid.push((index, reason.clone()));
        }
        self.rows += 1;
        self.counts.0[row.status as usize] += 1;
        self.rhs_evals += row.rhs_evals;
        self.cycles += u64::from(row.cycles);
    }
}

/// The limits beyond which a row of a plan is to be read with care.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubtful {
    accuracy: f64,
    /// Positions among the measures.
    power: Option<usize>,
    margin: Option<usize>,
}

impl Doubtful {
    /// For the rows of `plan`.
    pub(super) fn of(plan: &Plan) -> Doubtful {
        let columns: &[Column] = plan.rows().columns();
        let position = |name: &str| columns.iter().position(|column| column.name == name);
        Doubtful {
            accuracy: plan.solver().accuracy,
            power: position("power_mean_mw"),
            margin: position(RESONANCE_MARGIN_HZ),
        }
    }

    /// Counts a row.
    pub(super) fn count(&self, row: &Row, doubts: &mut Doubts) {
        let measure =
            |position: Option<usize>| position.and_then(|position| row.measures.get(position).copied());
        doubts.inaccurate += u64::from(row.error_estimate > self.accuracy);
        doubts.powerless += u64::from(measure(self.power).is_some_and(|power| power < 0.0));
        doubts.at_range_end += u64::from(measure(self.margin) == Some(0.0));
    }
}
