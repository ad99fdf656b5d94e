//! The edges of hysteresis: curves in the plane of two parameters, on which the bistable bands end. This
//! module contains the points of edges, their rows, and a one-line summary.

use std::fmt;

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::{Point, Unfinished};

use super::verdict::at;
use crate::notation::UserError;
use crate::plan::{Along, Plan};
use crate::table::layout::{Cell, CellKind, Column, Layout, Measure};

/// If an orbit on an edge has a Floquet multiplier above this value, the orbit is unstable on both sides of
/// the edge. The value is not exactly 1 because of numerical errors.
pub(super) const CRITICAL: f64 = 1.001;

/// Largest number of points that the continuation computes in each of the two directions along an edge.
pub(super) const MOST: usize = 2000;

/// Largest number of steps in the range of the second parameter.
const MOST_STEPS: f64 = 1e4;

/// The second parameter of the plane in which edges are computed, with the range of this parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeRange {
    /// Index of the second parameter in the model's parameter table.
    pub parameter: usize,
    /// Smallest and largest value of the second parameter, in SI units.
    pub range: [f64; 2],
    /// Step between the values of the second parameter at which points of the edge are returned. If `None`,
    /// all computed points are returned.
    pub step: Option<f64>,
}

impl EdgeRange {
    /// Checks the second parameter and its range. `along` describes the parameter of the response.
    ///
    /// # Errors
    /// [`UserError`] in one of the following cases:
    ///
    /// - The second parameter is a choice, or is the parameter of the response.
    /// - The value of the second parameter comes from an axis or a formula, or the model computes the value
    ///   from other parameters.
    /// - The range is empty or descending, or does not contain the design's value of the second parameter.
    /// - The step is zero or negative, or the range contains more than 10,000 steps.
    pub fn new(
        plan: &Plan,
        along: &Along,
        parameter: usize,
        range: [f64; 2],
        step: Option<f64>,
    ) -> Result<EdgeRange, UserError> {
        let Parameter { name, kind, unit, .. } = plan.parameters()[parameter];
        let error = |message: String, help: &str| Err(UserError::new(message, Some(help)));
        if let Kind::Choice(_) = kind {
            let message = format!("`{name}` is a choice, so bands have no edge along it");
            return Err(UserError::new(message, None));
        }
        if parameter == along.parameter {
            return error(format!("`{name}` is the followed parameter"), "choose two different parameters");
        }
        let value = plan.point(0).values[parameter];
        if !value.is_finite() || plan.clone().with_parameter(parameter, value).is_err() {
            let help = "set it to one number: each edge begins at this value";
            return error(format!("`{name}` has no value of its own"), help);
        }
        let [from, to] = range;
        let values = plan.in_designs(parameter).map_or_else(|| vec![value], <[f64]>::to_vec);
        if let Some(value) = values.iter().find(|value| from >= to || !(from..=to).contains(*value)) {
            let [value, from, to] = [*value, from, to].map(|value| at(value, unit));
            let help = "the range must rise, and contain the value of the design, at which each edge begins";
            return error(format!("`{name}` is {value}, and its range is {from} to {to}"), help);
        }
        if step.is_some_and(|step| step <= 0.0 || (to - from) / step > MOST_STEPS) {
            let help = "the range may have up to 10,000 steps";
            return error(format!("the step of `{name}` must be more than zero, and not too short"), help);
        }
        Ok(EdgeRange { parameter, range, step })
    }
}

/// The edges of hysteresis of one design.
#[derive(Clone, Debug, PartialEq)]
pub struct Edges {
    /// The edges, sorted by the value of the response's parameter at which each edge was found.
    pub edges: Vec<Edge>,
    /// Values of the parameter of the response at which a band ends but no edge could be computed.
    pub missed: Vec<f64>,
}

/// A curve in the plane of two parameters on which an orbit loses its stability.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// Kind of the edge, which depends on the Floquet multiplier that reaches the magnitude 1.
    pub kind: EdgeKind,
    /// Points in their order along the edge.
    pub points: Vec<EdgePoint>,
    /// The reason why the edge ends at its first point, and the reason why it ends at its last point.
    pub ends: [EdgeEnd; 2],
}

/// Kind of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeKind {
    /// A Floquet multiplier is +1: a stable and an unstable orbit meet and vanish.
    Fold,
    /// A Floquet multiplier is −1: beyond the edge, the motion repeats only after two drive periods.
    PeriodDoubling,
    /// Two complex Floquet multipliers have the modulus 1: beyond the edge, the motion has a second
    /// frequency.
    Torus,
}

/// An orbit on an edge.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgePoint {
    /// Value of the parameter of the response, then value of the second parameter.
    pub values: [f64; 2],
    /// Marks the point if it is a cusp, or a local minimum or maximum of the second parameter.
    pub mark: Option<EdgeMark>,
    /// State of the orbit at the beginning of the drive period.
    pub state: Vec<f64>,
    /// Measures of the orbit.
    pub measures: Vec<f64>,
    /// Largest magnitude of the orbit's Floquet multipliers. If this magnitude is above 1, the orbit is
    /// unstable on both sides of the edge.
    pub floquet_max: f64,
}

/// A special point of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeMark {
    /// A cusp: the folds at both ends of a bistable band meet, and the band vanishes. In the plane of the two
    /// parameters, the edge turns back at the cusp.
    Cusp,
    /// A turn: the value of the second parameter has a local minimum or maximum along the edge.
    Turn,
}

/// The reason why an edge ends.
#[derive(Clone, Debug, PartialEq)]
pub enum EdgeEnd {
    /// The edge leaves the range of the parameter with this index: 0 for the parameter of the response, 1 for
    /// the second parameter.
    Range(usize),
    /// The edge is a closed curve.
    Closed,
    /// On an edge of the kind `Torus`, the two complex Floquet multipliers become real.
    Resonance,
    /// Newton's iteration does not converge, even with the shortest step along the edge.
    Unconverged,
    /// The motion over a drive period cannot be integrated.
    Unfinished(Unfinished),
    /// The edge has the largest allowed number of points.
    Long,
}

impl EdgeMark {
    /// Returns the name of this kind in result files.
    pub fn name(self) -> &'static str {
        match self {
            EdgeMark::Cusp => "cusp",
            EdgeMark::Turn => "turn",
        }
    }
}

impl EdgeKind {
    /// All kinds.
    pub const ALL: [EdgeKind; 3] = [EdgeKind::Fold, EdgeKind::PeriodDoubling, EdgeKind::Torus];

    /// Returns the name of this kind in result files.
    pub fn name(self) -> &'static str {
        match self {
            EdgeKind::Fold => "fold",
            EdgeKind::PeriodDoubling => "period_doubling",
            EdgeKind::Torus => "torus",
        }
    }
}

impl Edges {
    /// Returns the columns of the results file with edges.
    pub fn columns(plan: &Plan, along: &Along, second: &EdgeRange) -> Vec<Column> {
        let parameter = |index: usize| Column::of_parameter(&plan.parameters()[index]);
        let word = |name, doc| Column::new(name, "", CellKind::Text, doc);
        let varied = plan.axes().varied().map(parameter);
        let fixed = [
            Column::new("edge", "", CellKind::Whole, "number of the edge of the design, from 0"),
            word("kind", "kind of the critical multiplier: fold, period_doubling or torus"),
            word("mark", "cusp or turn; empty for other points"),
        ];
        let place = [second.parameter, along.parameter].map(parameter);
        let doc = "largest modulus of the Floquet multipliers";
        let multiplier = Column::new("floquet_max", "", CellKind::Number, doc);
        let measures = measures(plan).into_iter().map(|measure| measure.column);
        varied.chain(fixed).chain(place).chain([multiplier]).chain(measures).collect()
    }

    /// Returns one row with the columns of [`Edges::columns`] for each point on the edges of `design`.
    pub fn rows<'p>(&self, plan: &'p Plan, design: &Point) -> Vec<Vec<Cell<'p>>> {
        let measures = measures(plan);
        let varied: Vec<Cell<'_>> = (plan.axes().varied())
            .map(|index| Cell::of_parameter(&plan.parameters()[index], design.values[index]))
            .collect();
        let row = |number: u64, kind: EdgeKind, point: &EdgePoint| {
            let [first, second] = point.values;
            let words = [Cell::Text(kind.name()), Cell::Text(point.mark.map_or("", EdgeMark::name))];
            let numbers = [second, first, point.floquet_max].map(Cell::Number);
            let measures = measures.iter().map(|measure| measure.cell(&point.measures));
            let cells = varied.iter().copied().chain([Cell::Whole(number)]).chain(words);
            cells.chain(numbers).chain(measures).collect()
        };
        let edges = (0..).zip(&self.edges);
        edges
            .flat_map(|(number, edge)| edge.points.iter().map(move |point| (number, edge.kind, point)))
            .map(|(number, kind, point)| row(number, kind, point))
            .collect()
    }
}

/// Returns the measures that rows of edges contain. Columns with derivatives are left out, because flap
/// computes no derivatives on edges.
fn measures(plan: &Plan) -> Vec<Measure> {
    let known = plan.rows().columns().len() + plan.measures().len();
    Layout::of(plan).measures().filter(|measure| measure.index < known).cloned().collect()
}

impl Edge {
    /// Returns a one-line summary of the edge. `along` and `second` are the parameters of the plane.
    pub fn verdict(&self, plan: &Plan, along: &Along, second: &EdgeRange) -> String {
        let units = [along.parameter, second.parameter].map(|index| plan.parameters()[index].unit);
        let place = |point: &EdgePoint| {
            let [first, second] = [0, 1].map(|k| at(point.values[k], units[k]));
            format!("{second}, {first}")
        };
        let kind = self.kind.name().replace('_', " ");
        let mut parts = match &self.points[..] {
            [first, ..] if self.ends[0] == EdgeEnd::Closed => {
                vec![format!("{kind} on a closed curve through {}", place(first))]
            }
            [first, .., last] => vec![format!("{kind} from {} to {}", place(first), place(last))],
            [point] => vec![format!("{kind} at {}", place(point))],
            [] => vec![kind],
        };
        for (index, point) in self.points.iter().enumerate() {
            let neighbour = self.points.get(if index == 0 { 1 } else { index - 1 });
            let is_smallest = neighbour.is_none_or(|neighbour| neighbour.values[1] >= point.values[1]);
            match point.mark {
                None => {}
                Some(EdgeMark::Cusp) => {
                    let motions = if point.floquet_max <= CRITICAL { "" } else { " of unstable orbits" };
                    let verb = if is_smallest { "begins" } else { "ends" };
                    parts.push(format!("hysteresis{motions} {verb} at {} (cusp)", place(point)));
                }
                Some(EdgeMark::Turn) => {
                    let limit = if is_smallest { "smallest" } else { "largest" };
                    let name = plan.parameters()[second.parameter].name;
                    parts.push(format!("{limit} {name} at {}", place(point)));
                }
            }
        }
        for (end, point) in self.ends.iter().zip([self.points.first(), self.points.last()]) {
            if let (false, Some(point)) = (matches!(end, EdgeEnd::Range(_) | EdgeEnd::Closed), point) {
                parts.push(format!("stopped at {}: {end}", place(point)));
            }
        }
        parts.join("; ")
    }
}

impl fmt::Display for EdgeEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EdgeEnd::Range(_) => write!(f, "the edge leaves the range"),
            EdgeEnd::Closed => write!(f, "the edge is closed"),
            EdgeEnd::Resonance => write!(f, "the pair of multipliers becomes real"),
            EdgeEnd::Unconverged => write!(f, "Newton's iteration does not converge for the shortest step"),
            EdgeEnd::Unfinished(unfinished) => unfinished.fmt(f),
            EdgeEnd::Long => write!(f, "it has {MOST} points"),
        }
    }
}
