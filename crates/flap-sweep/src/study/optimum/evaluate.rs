//! Computes rows and derivatives at the points that an optimisation tries.

use std::cell::{Cell, RefCell};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::rc::Rc;

use flap_core::simulate::{Interrupt, NoSlope, Row, Status};

use super::problem::Problem;
use crate::derivative::reasons_of;
use crate::plan::Plan;
use crate::run::{Outcome, RunError, RunOptions, alone};

/// Step of a coordinate for the finite differences that replace missing derivatives.
const STEP: f64 = 2e-3;

/// For designs at resonance or at hover, this step replaces [`STEP`]. This step is larger than [`STEP`],
/// because the computed resonance and the computed hover have numerical errors.
const STEP_WITH_SEARCH: f64 = 2e-2;

/// A point that the optimisation has computed.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub(super) coordinates: Vec<f64>,
    /// Values of the parameters that do not vary continuously (see
    /// [`Region::choice`](super::region::Region::choice)).
    pub(super) choice: Vec<f64>,
    pub(super) row: Row,
    /// The value of the goal at this point.
    pub(super) goal: f64,
    /// The values of both sides of each limit: first the side that must be smaller, then the side that must
    /// be larger.
    pub(super) sides: Vec<[f64; 2]>,
    /// The largest relative excess over a limit. The excess is zero if the point satisfies all limits, and
    /// infinite if the point has no periodic motion.
    pub(super) excess: f64,
    /// The first list contains the derivatives of the goal with respect to each coordinate. The next lists
    /// contain the derivatives of the distance from each limit.
    pub(super) slopes: Vec<Vec<f64>>,
    /// True if some derivatives are unknown and set to zero. A derivative is unknown if the row does not
    /// contain it and no neighbouring point has a periodic motion.
    pub(super) lacks_slopes: bool,
}

impl Trial {
    /// Returns the point with the given row. The measures of the row must contain the goal and both sides of
    /// each limit.
    pub(super) fn new(problem: &Problem, coordinates: Vec<f64>, choice: Vec<f64>, row: Row) -> Trial {
        let goal_index = problem.goal_index();
        let known = row.status == Status::Periodic && row.measures.len() > goal_index;
        let at = |place: usize| if known { row.measures[place] } else { f64::NAN };
        let goal = at(goal_index);
        let side = |number: usize| [goal_index + 1 + 2 * number, goal_index + 2 + 2 * number].map(at);
        let sides: Vec<[f64; 2]> = (0..problem.limits.len()).map(side).collect();
        let over = problem.limits.iter().zip(&sides).map(|(limit, &sides)| {
            let share = (sides[0] - sides[1]) / limit.scale(sides);
            match limit.holds(sides) {
                true => 0.0,
                false if share.is_nan() => f64::INFINITY,
                false => share.max(f64::MIN_POSITIVE),
            }
        });
        let excess = if goal.is_finite() { over.fold(0.0, f64::max) } else { f64::INFINITY };
        Trial { coordinates, choice, row, goal, sides, excess, slopes: Vec::new(), lacks_slopes: false }
    }

    /// True if this point is better than `other`. If both points satisfy all limits, the point with the
    /// better goal is better. If one or both points exceed a limit, the point with the smaller excess is
    /// better.
    pub(super) fn is_better(&self, problem: &Problem, other: &Trial) -> bool {
        if self.excess > 0.0 || other.excess > 0.0 {
            return self.excess < other.excess;
        }
        problem.aim.sign() * self.goal < problem.aim.sign() * other.goal
    }

    /// Compares two points for sorting: the point with the smaller excess over the limits comes first. If the
    /// excesses are equal, the point with the better goal comes first.
    pub(super) fn order(&self, problem: &Problem, other: &Trial) -> Ordering {
        let goal = |trial: &Trial| problem.aim.sign() * trial.goal;
        self.excess.total_cmp(&other.excess).then(goal(self).total_cmp(&goal(other)))
    }

    /// The distance of the point from a limit, divided by the size of the limit. The distance is negative if
    /// the point exceeds the limit.
    pub(super) fn margin(&self, problem: &Problem, number: usize) -> f64 {
        let sides = self.sides[number];
        (sides[1] - sides[0]) / problem.limits[number].scale(sides)
    }
}

/// Computes and stores the rows of one search for an optimum. All rows have the same values of the parameters
/// in `choice`.
pub(super) struct Evaluator<'p> {
    pub(super) problem: &'p Problem,
    options: &'p RunOptions,
    choice: Vec<f64>,
    interrupted: Interrupt<'p>,
    known: RefCell<Vec<Rc<Trial>>>,
    /// Number of computed rows.
    pub(super) rows: Cell<u64>,
    /// Number of computed rows with derivatives.
    pub(super) sloped: Cell<u64>,
    /// The reasons why derivatives of computed rows are missing.
    missing: RefCell<BTreeSet<NoSlope>>,
    /// True if a missing derivative was replaced by a difference between rows.
    pub(super) has_differences: Cell<bool>,
    failure: RefCell<Option<RunError>>,
}

impl<'p> Evaluator<'p> {
    pub(super) fn new(
        problem: &'p Problem,
        options: &'p RunOptions,
        choice: Vec<f64>,
        interrupted: Interrupt<'p>,
    ) -> Evaluator<'p> {
        Evaluator {
            problem,
            options,
            choice,
            interrupted,
            known: RefCell::default(),
            rows: Cell::new(0),
            sloped: Cell::new(0),
            missing: RefCell::default(),
            has_differences: Cell::new(false),
            failure: RefCell::new(None),
        }
    }

    /// Returns the reasons why derivatives of computed rows are missing.
    pub(super) fn missing(&self) -> Vec<NoSlope> {
        self.missing.borrow().iter().copied().collect()
    }

    /// If the rows of a point could not be computed, returns the last error.
    pub(super) fn failure(&self) -> Option<RunError> {
        self.failure.take()
    }

    /// Returns the point at the given coordinates. A stored point is not computed again.
    pub(super) fn at(&self, coordinates: &[f64]) -> Rc<Trial> {
        self.find(coordinates, false)
    }

    /// Returns the point at the given coordinates. If the motion of the point is periodic, the point also has
    /// derivatives.
    pub(super) fn with_slopes(&self, coordinates: &[f64]) -> Rc<Trial> {
        self.find(coordinates, true)
    }

    fn find(&self, coordinates: &[f64], has_slopes: bool) -> Rc<Trial> {
        let is_same =
            |trial: &&Rc<Trial>| trial.coordinates == coordinates && !(has_slopes && trial.slopes.is_empty());
        if let Some(known) = self.known.borrow().iter().find(is_same) {
            return Rc::clone(known);
        }
        let trial = Rc::new(self.compute(coordinates, has_slopes));
        self.known.borrow_mut().push(Rc::clone(&trial));
        trial
    }

    fn compute(&self, coordinates: &[f64], has_slopes: bool) -> Trial {
        let sloped = self.problem.sloped.as_ref().filter(|_| has_slopes);
        let plan = sloped.unwrap_or(&self.problem.measured);
        let row = self.row(plan, coordinates);
        let mut trial = Trial::new(self.problem, coordinates.to_vec(), self.choice.clone(), row);
        if has_slopes && trial.excess.is_finite() {
            (trial.slopes, trial.lacks_slopes) = self.slopes(&trial, sloped.is_some());
        }
        trial
    }

    /// Computes the row at the given coordinates. If a condition excludes the point, the row has the status
    /// `invalid`.
    fn row(&self, plan: &Plan, coordinates: &[f64]) -> Row {
        self.rows.set(self.rows.get() + 1);
        let excluded = || Row::invalid("a condition of the grid excludes the point");
        let point = match plan.clone().at(&self.problem.region.varied(coordinates, &self.choice)) {
            Ok(point) => point,
            Err(error) => return Row::invalid(error),
        };
        match alone(&point, self.options, self.interrupted).next() {
            Some(Ok(Outcome::Ran(row))) => row,
            Some(Ok(Outcome::Excluded(_))) => excluded(),
            None => Row::invalid("interrupted"),
            Some(Err(error)) => {
                let row = Row::invalid(&error);
                *self.failure.borrow_mut() = Some(error);
                row
            }
        }
    }

    /// Returns the values of [`Trial::slopes`] and [`Trial::lacks_slopes`]. The derivatives come from the
    /// row. Derivatives that are missing in the row are computed as differences between rows.
    fn slopes(&self, trial: &Trial, is_sloped: bool) -> (Vec<Vec<f64>>, bool) {
        let Trial { coordinates, row, .. } = trial;
        let variables = &self.problem.region.variables;
        let quantities = 1 + 2 * self.problem.limits.len();
        let first = self.problem.goal_index() + quantities;
        let has_row = is_sloped && row.measures.len() > first + quantities * variables.len();
        if has_row {
            self.sloped.set(self.sloped.get() + 1);
            let code = row.measures[first + quantities * variables.len()];
            self.missing.borrow_mut().extend(reasons_of(code));
        }
        let mut lacks_slopes = false;
        let mut of = vec![vec![f64::NAN; variables.len()]; quantities];
        for (number, variable) in variables.iter().enumerate() {
            let per_coordinate = variable.slope(coordinates[number]);
            let known =
                |quantity: usize| row.measures[first + quantity * variables.len() + number] * per_coordinate;
            let column: Vec<f64> = if has_row { (0..quantities).map(known).collect() } else { Vec::new() };
            let column = if column.is_empty() || column.iter().any(|slope| slope.is_nan()) {
                self.has_differences.set(true);
                let differences = self.differences(trial, number);
                lacks_slopes |= differences.is_none();
                let differences = differences.unwrap_or_else(|| vec![0.0; quantities]);
                let mended = (0..quantities).map(|quantity| {
                    let exact = column.get(quantity).copied().filter(|slope| !slope.is_nan());
                    exact.unwrap_or(differences[quantity])
                });
                mended.collect()
            } else {
                column
            };
            for (quantity, slope) in column.into_iter().enumerate() {
                of[quantity][number] = slope;
            }
        }
        let mut slopes = vec![of[0].clone()];
        for number in 0..self.problem.limits.len() {
            let (less, more) = (&of[1 + 2 * number], &of[2 + 2 * number]);
            slopes.push(less.iter().zip(more).map(|(less, more)| more - less).collect());
        }
        (slopes, lacks_slopes)
    }

    /// Computes finite differences of the goal and of the sides of all limits, between the point and a
    /// neighbour along one coordinate. The neighbour must be within the bounds. Returns `None` if no
    /// neighbour has a periodic motion.
    fn differences(&self, trial: &Trial, number: usize) -> Option<Vec<f64>> {
        let quantities = |trial: &Trial| -> Vec<f64> {
            std::iter::once(trial.goal).chain(trial.sides.iter().flatten().copied()).collect()
        };
        let here = quantities(trial);
        let step = if self.problem.plan.has_search() { STEP_WITH_SEARCH } else { STEP };
        for step in [step, -step] {
            let mut moved = trial.coordinates.clone();
            moved[number] += step;
            if !(0.0..=1.0).contains(&moved[number]) {
                continue;
            }
            let there = self.at(&moved);
            if there.excess.is_finite() {
                let pairs = here.iter().zip(quantities(&there));
                return Some(pairs.map(|(here, there)| (there - here) / step).collect());
            }
        }
        None
    }
}
