//! The types that contain the result of an optimisation.

use flap_core::simulate::{NoSlope, Row};

/// The status of an optimisation, which describes if an optimum was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The derivatives show that no small change of the design improves the goal. Missing derivatives are
    /// replaced by differences between rows.
    Optimal,
    /// The point is the best point that the search computed, but the derivatives do not confirm an optimum.
    /// Either the search ended early, or a neighbouring point has no periodic motion.
    Approximate,
    /// The search found no point that satisfies all conditions. The result is the point that violates the
    /// conditions least.
    Infeasible,
}

impl Status {
    /// All statuses.
    pub const ALL: [Status; 3] = [Status::Optimal, Status::Approximate, Status::Infeasible];

    /// Returns the word for this status in results.
    pub fn name(self) -> &'static str {
        match self {
            Status::Optimal => "optimal",
            Status::Approximate => "approximate",
            Status::Infeasible => "infeasible",
        }
    }
}

/// The kind of a restriction: a condition, or an end of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// A condition restricts the optimum.
    Limit,
    /// The smallest value of an axis restricts the optimum.
    Smallest,
    /// The largest value of an axis restricts the optimum.
    Largest,
}

impl Edge {
    /// Returns the word for this kind of restriction in results.
    pub fn name(self) -> &'static str {
        match self {
            Edge::Limit => "limit",
            Edge::Smallest => "smallest",
            Edge::Largest => "largest",
        }
    }
}

/// A condition or an end of an axis that restricts the optimum.
#[derive(Clone, Debug, PartialEq)]
pub struct Active {
    /// The kind of the restriction.
    pub edge: Edge,
    /// The text of the condition, or the name of the axis's parameter.
    pub name: String,
    /// The value of the limit: one side of the comparison in the condition, or the end of the axis in SI
    /// units.
    pub limit: f64,
    /// The Lagrange multiplier: the change of the goal at the optimum if the limit increases by one unit.
    pub per_unit: f64,
    /// The change of the goal at the optimum, in per cent, if the limit increases by 1 %.
    pub percent: f64,
}

/// A comparison in the conditions, with its values at the optimum.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitAt {
    /// The comparison as the user wrote it, or the name of the condition in the grid file.
    pub text: String,
    /// The values of both sides of the comparison: first the side that must be smaller, then the side that
    /// must be larger.
    pub sides: [f64; 2],
    /// If the comparison is not satisfied, the excess over the limit as a fraction of the limit. Otherwise
    /// zero.
    pub excess: f64,
}

/// A local optimum, at which one or more searches ended.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalOptimum {
    /// The value of the goal at this local optimum.
    pub goal: f64,
    /// The varied parameters and their values.
    pub varied: Vec<(usize, f64)>,
    /// True if this local optimum satisfies all conditions.
    pub is_feasible: bool,
    /// The number of searches that ended at this local optimum.
    pub starts: usize,
}

/// The best point that an optimisation found, with details of the search.
#[derive(Clone, Debug)]
pub struct Optimum {
    /// The status of the optimisation.
    pub status: Status,
    /// The value of the goal at the best design.
    pub goal: f64,
    /// The values of all parameters of the best design, in the order of the parameter table.
    pub values: Vec<f64>,
    /// The row of the best design. The measures of the model come first, then the measures that the grid file
    /// defines.
    pub row: Row,
    /// The varied parameters and their values.
    pub varied: Vec<(usize, f64)>,
    /// The varied parameters whose best value is at an end of their axis, with the smallest and the largest
    /// value of the axis.
    pub at_end: Vec<(usize, [f64; 2])>,
    /// The conditions and ends of axes that restrict the best design.
    pub active: Vec<Active>,
    /// All comparisons in the conditions, with their values at the best design.
    pub limits: Vec<LimitAt>,
    /// All local optima at which searches ended, beginning with the best.
    pub optima: Vec<LocalOptimum>,
    /// Number of points from which a search started.
    pub starts: usize,
    /// Number of points of the grid.
    pub points: u64,
    /// Number of grid points that were computed to choose the starts of the searches.
    pub computed: u64,
    /// Number of all computed rows.
    pub rows: u64,
    /// Number of computed rows with derivatives.
    pub sloped: u64,
    /// The reasons why derivatives were missing in the search that found the best design.
    pub missing: Vec<NoSlope>,
    /// True if the search for the best design ended with a pattern search, which needs no derivatives.
    pub is_polished: bool,
    /// The largest relative gain of the goal if one parameter changes by the width of its axis. The gain is
    /// predicted from the derivatives at the best design.
    pub left_over: f64,
}

impl Optimum {
    /// True if the best point satisfies all conditions.
    pub fn is_feasible(&self) -> bool {
        self.status != Status::Infeasible
    }
}

impl Active {
    /// Describes the effect of the limit on the optimal value of `goal`, as a sentence without a full stop.
    pub fn sentence(&self, goal: &str) -> String {
        let Active { name, .. } = self;
        let of = match self.edge {
            Edge::Limit => format!("the limit in `{name}`"),
            Edge::Smallest => format!("the smallest {name}"),
            Edge::Largest => format!("the largest {name}"),
        };
        let (by, change, unit) = if self.percent.is_finite() && self.percent != 0.0 {
            ("1 %", self.percent, " %")
        } else {
            ("1 unit", self.per_unit, "")
        };
        let direction = if change < 0.0 { "less" } else { "more" };
        let size: f64 = format!("{:.2e}", change.abs()).parse().unwrap_or(change.abs());
        format!("{by} more of {of} gives {size}{unit} {direction} {goal}")
    }
}
