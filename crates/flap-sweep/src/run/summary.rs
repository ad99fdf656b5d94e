//! Summary of a run.

use std::collections::{BTreeMap, HashMap};

use flap_core::simulate::{Column, Row, Status};
use serde::{Deserialize, Serialize};

use crate::plan::Plan;
use crate::refine::Refined;
use crate::resonance::RESONANCE_MARGIN_HZ;
use crate::vehicle::{HOVER_RESIDUAL, TRIM_LIMIT};

/// Number of rows with each status. In journals and sidecars, the numbers of rows are a TOML table whose keys
/// are the names of the statuses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "HashMap<Status, u64>", into = "BTreeMap<&'static str, u64>")]
pub struct Counts([u64; Status::ALL.len()]);

impl Counts {
    /// Returns the number of rows with the given status.
    pub fn of(&self, status: Status) -> u64 {
        self.0[status as usize]
    }

    /// Returns each status with its number of rows, in the order in which flap prints the statuses.
    pub fn iter(&self) -> impl Iterator<Item = (Status, u64)> + '_ {
        Status::ALL.iter().map(|&status| (status, self.of(status)))
    }
}

impl From<HashMap<Status, u64>> for Counts {
    fn from(counts: HashMap<Status, u64>) -> Counts {
        Counts(Status::ALL.map(|status| counts.get(&status).copied().unwrap_or(0)))
    }
}

impl From<Counts> for BTreeMap<&'static str, u64> {
    fn from(counts: Counts) -> BTreeMap<&'static str, u64> {
        counts.iter().map(|(status, count)| (status.name(), count)).collect()
    }
}

/// For each of four reasons why measures may be unreliable, the number of rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Warnings {
    /// Number of rows whose error estimate exceeds the requested accuracy.
    pub inaccurate: u64,
    /// Number of rows with a negative mean electrical power. At a negative mean power, the air adds more
    /// energy to the wing than the air removes.
    pub negative_power: u64,
    /// Number of rows whose resonance is at the smallest or largest frequency of the search.
    pub at_range_end: u64,
    /// Number of rows at hover with an unbalanced force above 1 % of the weight. For unbalanced torques, the
    /// limit is 1 % of the weight times 1 mm.
    pub unbalanced: u64,
}

/// A condition of a plan, and the number of points that do not satisfy this condition.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Unsatisfied {
    /// Name of the condition.
    pub condition: String,
    /// Number of points that do not satisfy the condition.
    pub points: u64,
}

/// A point with an impossible combination of parameter values.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct InvalidPoint {
    /// Index of the point in the plan.
    pub point: u64,
    /// The reason why the combination of values is impossible.
    pub reason: String,
}

/// Summary of the rows written so far. Journals and sidecars record the summary.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Summary {
    /// Number of all selected points. In a run of responses, `points` is the number of selected designs.
    pub points: u64,
    /// Number of points or designs whose rows are all written.
    pub ran: u64,
    /// Number of written rows of a response curve that is only partly written. Zero if every response curve
    /// is complete.
    pub begun: u64,
    /// Number of written rows.
    pub rows: u64,
    /// Number of points that the conditions have excluded so far. Excluded points have no row.
    pub excluded: u64,
    /// Number of evaluations of the equations of motion, summed over all rows.
    pub rhs_evals: u64,
    /// Number of integrated drive periods, summed over all rows.
    pub cycles: u64,
    /// Number of rows with each status.
    pub statuses: Counts,
    /// Numbers of rows whose measures may be unreliable.
    pub warnings: Warnings,
    /// For each condition of the plan, the number of points that do not satisfy the condition. The conditions
    /// have the same order as in the plan.
    pub unsatisfied: Vec<Unsatisfied>,
    /// The invalid points with the smallest indices, at most five.
    pub invalid: Vec<InvalidPoint>,
    /// Result of the refinement of the grid. `None` until the refinement has ended.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refined: Option<Refined>,
}

impl Summary {
    /// Largest number of points in [`Summary::invalid`].
    const MOST_INVALID: usize = 5;

    /// Returns a copy of the summary `before`, in which the number of points and the conditions are replaced
    /// by the values of `plan`.
    pub(super) fn after(before: Summary, plan: &Plan) -> Summary {
        let counted = |name: &str| before.unsatisfied.iter().find(|known| known.condition == name);
        let unsatisfied = plan.conditions().iter().map(|condition| Unsatisfied {
            condition: condition.name.clone(),
            points: counted(&condition.name).map_or(0, |known| known.points),
        });
        Summary { points: plan.selected(), unsatisfied: unsatisfied.collect(), ..before }
    }

    /// Returns the number of finished points. The finished points are the first points in the list of
    /// selected points.
    pub fn done(&self) -> u64 {
        self.ran.saturating_add(self.excluded)
    }

    /// Returns true if some selected points are not finished.
    pub fn is_interrupted(&self) -> bool {
        self.done() < self.points
    }

    /// Returns true if all rows have the status `periodic`.
    pub fn all_periodic(&self) -> bool {
        self.statuses.of(Status::Periodic) == self.rows
    }

    /// Counts an excluded point, which does not satisfy the conditions with the indices `unsatisfied`.
    pub(super) fn exclude(&mut self, unsatisfied: &[usize]) {
        self.excluded += 1;
        for &condition in unsatisfied {
            self.unsatisfied[condition].points += 1;
        }
    }

    /// Counts a written row. `index` is the index of the row's point in the plan.
    pub(super) fn add(&mut self, index: u64, row: &Row, limits: &Limits) {
        if let (Status::Invalid, Some(reason)) = (row.status, &row.reason)
            && self.invalid.len() < Summary::MOST_INVALID
        {
            self.invalid.push(InvalidPoint { point: index, reason: reason.clone() });
        }
        self.rows += 1;
        self.statuses.0[row.status as usize] += 1;
        self.rhs_evals += row.rhs_evals;
        self.cycles += u64::from(row.cycles);
        let measure =
            |position: Option<usize>| position.and_then(|position| row.measures.get(position).copied());
        self.warnings.inaccurate += u64::from(row.error_estimate > limits.accuracy);
        self.warnings.negative_power += u64::from(measure(limits.power).is_some_and(|power| power < 0.0));
        self.warnings.at_range_end += u64::from(measure(limits.margin) == Some(0.0));
        self.warnings.unbalanced +=
            u64::from(measure(limits.residual).is_some_and(|share| share > TRIM_LIMIT));
    }

    /// Adds the numbers of `other` to this summary. The two summaries must count different points of one
    /// plan.
    pub fn add_all(&mut self, other: &Summary) {
        self.points += other.points;
        self.ran += other.ran;
        self.rows += other.rows;
        self.excluded += other.excluded;
        self.rhs_evals += other.rhs_evals;
        self.cycles += other.cycles;
        for (own, count) in self.statuses.0.iter_mut().zip(other.statuses.0) {
            *own += count;
        }
        self.warnings.inaccurate += other.warnings.inaccurate;
        self.warnings.negative_power += other.warnings.negative_power;
        self.warnings.at_range_end += other.warnings.at_range_end;
        self.warnings.unbalanced += other.warnings.unbalanced;
        for Unsatisfied { condition, points } in &other.unsatisfied {
            match self.unsatisfied.iter_mut().find(|known| known.condition == *condition) {
                Some(known) => known.points += points,
                None => {
                    self.unsatisfied.push(Unsatisfied { condition: condition.clone(), points: *points });
                }
            }
        }
        self.invalid.extend(other.invalid.iter().cloned());
        self.invalid.sort_unstable();
        self.invalid.truncate(Summary::MOST_INVALID);
    }
}

/// The requested accuracy of a plan, and the positions of measures in a row. With these data, flap decides if
/// the measures of a row may be unreliable.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    accuracy: f64,
    /// Position of the mean electrical power among the measures of a row.
    power: Option<usize>,
    margin: Option<usize>,
    residual: Option<usize>,
}

impl Limits {
    /// Returns the requested accuracy of `plan` and the positions of the measures that flap checks in each
    /// row.
    pub(super) fn of(plan: &Plan) -> Limits {
        let columns: &[Column] = plan.rows().columns();
        let position = |name: &str| columns.iter().position(|column| column.name == name);
        Limits {
            accuracy: plan.solver().accuracy,
            power: position("power_mean_mw"),
            margin: position(RESONANCE_MARGIN_HZ),
            residual: position(HOVER_RESIDUAL),
        }
    }
}
