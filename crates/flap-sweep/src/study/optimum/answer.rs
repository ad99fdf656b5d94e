//! The answer to a problem.

use flap_core::simulate::{NoSlope, Row};

/// The result of a search for an optimum in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The derivatives show that no small change of the design is better.
    Optimal,
    /// The best point that was found. Derivatives do not confirm it: some are missing, or the search ended early.
    Approximate,
    /// No point satisfies all conditions. The point has the smallest violation of the conditions.
    Infeasible,
}

impl Status {
    /// All statuses.
    pub const ALL: [Status; 3] = [Status::Optimal, Status::Approximate, Status::Infeasible];

    /// The word for it.
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
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Edge::Limit => "limit",
            Edge::Smallest => "smallest",
            Edge::Largest => "largest",
        }
    }
}

/// A bound or limit that holds the optimum back.
#[derive(Clone, Debug, PartialEq)]
pub struct Active {
    /// Its kind.
    pub edge: Edge,
    /// The condition, or the parameter of the axis.
    pub name: String,
    /// The number that the condition compares with, or the end of the axis in SI units.
    pub limit: f64,
    /// The multiplier: the change of the optimal number per unit of the limit.
    pub per_unit: f64,
    /// The change of the optimal number in per cent of its magnitude, per per cent of the limit.
    pub percent: f64,
}

/// A condition at the optimum.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitAt {
    /// The comparison as the user wrote it, or the name of a condition of the grid.
    pub text: String,
    /// The side that must be smaller, and the side that must be larger.
    pub sides: [f64; 2],
    /// The share of the limit by which it is exceeded; zero if it holds.
    pub excess: f64,
}

/// An optimum that some starts end at.
#[derive(Clone, Debug, PartialEq)]
pub struct Other {
    /// The number there.
    pub goal: f64,
    /// The varied parameters and their values.
    pub varied: Vec<(usize, f64)>,
    /// True if all conditions hold there.
    pub is_feasible: bool,
    /// The number of starts that end there.
    pub starts: usize,
}

/// The best point.
#[derive(Clone, Debug)]
pub struct Optimum {
    /// The result in one word.
    pub status: Status,
    /// The number that is largest or smallest.
    pub goal: f64,
    /// One value per parameter.
    pub values: Vec<f64>,
    /// The row there: the model's measures, then the plan's own.
    pub row: Row,
    /// The varied parameters and their values.
    pub varied: Vec<(usize, f64)>,
    /// The parameters among them that are at an end of their axis, with the smallest and the largest value there.
    pub at_end: Vec<(usize, [f64; 2])>,
    /// The bounds and limits that hold it back.
    pub active: Vec<Active>,
    /// All conditions.
    pub limits: Vec<LimitAt>,
    /// All optima that the starts end at, the best first.
    pub optima: Vec<Other>,
    /// Starts that were refined.
    pub starts: usize,
    /// Points of the grid, and points of it that were computed.
    pub points: u64,
    /// See [`Optimum::points`].
    pub computed: u64,
    /// Rows computed in all.
    pub rows: u64,
    /// Rows with derivatives among them.
    pub sloped: u64,
    /// The reasons why derivatives were missing.
    pub missing: Vec<NoSlope>,
    /// True if the search ended with a pattern search, which needs no derivatives.
    pub is_polished: bool,
    /// The gain that the derivatives promise along an axis, as a share of the number per width of the axis.
    pub left_over: f64,
}

impl Optimum {
    /// True if the point satisfies all conditions.
    pub fn is_feasible(&self) -> bool {
        self.status != Status::Infeasible
    }
}

impl Active {
    /// The effect of the bound or limit on the optimal number, called `goal`, as a sentence without a full stop.
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
