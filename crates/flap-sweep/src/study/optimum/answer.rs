//! The result of an optimisation problem.

use flap_core::simulate::{NoSlope, Row};

/// The result of a search for an optimum, as a status of one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The derivatives show that no small change of the design is better. Differences of rows replace missing
    /// derivatives.
    Optimal,
    /// The best point that was found. The derivatives do not confirm this point, because the search ended
    /// early or a neighbour has no periodic motion.
    Approximate,
    /// No point satisfies all conditions. The point has the smallest violation of the conditions.
    Infeasible,
}

impl Status {
    /// All statuses.
    pub const ALL: [Status; 3] = [Status::Optimal, Status::Approximate, Status::Infeasible];

    /// The name of this variant in results.
    pub fn name(self) -> &'static str {
        match self {
            Status::Optimal => "optimal",
            Status::Approximate => "approximate",
            Status::Infeasible => "infeasible",
        }
    }
}

/// The kind of a bound or limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// A condition.
    Limit,
    /// The smallest value of an axis.
    Smallest,
    /// The largest value of an axis.
    Largest,
}

impl Edge {
    /// The name of this variant in results.
    pub fn name(self) -> &'static str {
        match self {
            Edge::Limit => "limit",
            Edge::Smallest => "smallest",
            Edge::Largest => "largest",
        }
    }
}

/// A bound or limit that restricts the optimum.
#[derive(Clone, Debug, PartialEq)]
pub struct Active {
    /// The kind of the bound or limit.
    pub edge: Edge,
    /// The condition, or the parameter of the axis.
    pub name: String,
    /// The number in the condition, or the value at the end of the axis in SI units.
    pub limit: f64,
    /// The Lagrange multiplier: the change of the optimal value of the goal per unit of the limit.
    pub per_unit: f64,
    /// The change of the optimal number in per cent of its magnitude, per per cent of the limit.
    pub percent: f64,
}

/// A condition at the optimum.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitAt {
    /// The comparison as the user wrote it, or the name of a condition of the grid.
    pub text: String,
    /// The values of the side that must be smaller, and of the side that must be larger.
    pub sides: [f64; 2],
    /// The amount by which the limit is exceeded, as a fraction of the limit; zero if the condition holds.
    pub excess: f64,
}

/// An optimum at which one or more searches end.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalOptimum {
    /// The value of the goal at this optimum.
    pub goal: f64,
    /// The varied parameters and their values.
    pub varied: Vec<(usize, f64)>,
    /// True if all conditions hold at this optimum.
    pub is_feasible: bool,
    /// The number of searches that end at this optimum.
    pub starts: usize,
}

/// The best point.
#[derive(Clone, Debug)]
pub struct Optimum {
    /// The status of the result, as one word.
    pub status: Status,
    /// The value of the goal at the best design.
    pub goal: f64,
    /// Value of each parameter, in the order of the parameters.
    pub values: Vec<f64>,
    /// The row of the best design: the measures of the model, then the measures of the plan.
    pub row: Row,
    /// The varied parameters and their values.
    pub varied: Vec<(usize, f64)>,
    /// The varied parameters whose value is at an end of the axis, with the smallest and the largest value of the axis.
    pub at_end: Vec<(usize, [f64; 2])>,
    /// The bounds and limits that restrict the best design.
    pub active: Vec<Active>,
    /// All conditions.
    pub limits: Vec<LimitAt>,
    /// All optima at which the searches end, beginning with the best optimum.
    pub optima: Vec<LocalOptimum>,
    /// Number of starts from which a search ran.
    pub starts: usize,
    /// Number of points of the grid, and number of grid points that were computed.
    pub points: u64,
    /// See [`Optimum::points`].
    pub computed: u64,
    /// Total number of computed rows.
    pub rows: u64,
    /// Number of computed rows with derivatives.
    pub sloped: u64,
    /// The reasons for missing derivatives.
    pub missing: Vec<NoSlope>,
    /// True if the search ended with a pattern search, which needs no derivatives.
    pub is_polished: bool,
    /// The gain that the derivatives predict along an axis, as a fraction of the goal per width of the axis.
    pub left_over: f64,
}

impl Optimum {
    /// True if the point satisfies all conditions.
    pub fn is_feasible(&self) -> bool {
        self.status != Status::Infeasible
    }
}

impl Active {
    /// The effect of the bound or limit on the optimal value of `goal`, as a sentence without a full stop.
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
