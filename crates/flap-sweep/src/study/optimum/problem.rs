//! Defines an optimisation problem: a plan, a goal that must be as large or as small as possible, and limits.

use flap_core::parameter::{Kind as ParameterKind, Parameter};

use super::answer::Optimum;
use super::limit::Limit;
use super::region::Region;
use crate::notation::expression::{Expression, ExpressionError, Kind, Meaning, Scope};
use crate::notation::text;
use crate::plan::formula::{Condition, OwnMeasure};
use crate::plan::{Plan, Value};

/// The direction of an optimisation: towards larger or smaller values of the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// Larger values of the goal are better.
    Largest,
    /// Smaller values of the goal are better.
    Smallest,
}

impl Aim {
    /// Returns 1 if smaller values of the goal are better, and -1 if larger values are better.
    pub(super) fn sign(self) -> f64 {
        match self {
            Aim::Largest => -1.0,
            Aim::Smallest => 1.0,
        }
    }
}

/// The part of an optimisation problem that contains a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProblemPart {
    /// The grid file contains the mistake.
    Plan,
    /// The expression of the goal contains the mistake.
    Goal,
    /// The condition with this index contains the mistake.
    Condition(usize),
}

/// A mistake in the definition of an optimisation problem.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct ProblemError {
    /// The part of the problem that contains the mistake.
    pub part: ProblemPart,
    /// Description of the mistake.
    pub message: String,
    /// Advice how to correct the mistake. `None` if flap has no advice.
    pub help: Option<String>,
}

/// An optimisation problem that has passed all checks.
#[derive(Clone)]
pub struct Problem {
    /// The user's plan.
    pub(super) plan: Plan,
    /// A copy of `plan` whose rows contain additional measures: the goal and both sides of each limit. The
    /// copy has only those conditions that are not limits of the problem.
    pub(super) measured: Plan,
    /// A copy of `measured` whose rows also contain derivatives of the goal and the limits with respect to
    /// the varied parameters. `None` if rows have no derivatives.
    pub(super) sloped: Option<Plan>,
    pub(super) region: Region,
    pub(super) aim: Aim,
    pub(super) goal: String,
    value: Expression,
    pub(super) limits: Vec<Limit>,
    /// Lower limit of the size of the goal (see [`Problem::size`]).
    least_size: f64,
}

impl Problem {
    /// Returns the problem with a new lower limit for the size of the goal: a thousandth of the median
    /// magnitude of `goals`.
    pub(super) fn sized_by(&self, goals: impl Iterator<Item = f64>) -> Problem {
        let mut sizes: Vec<f64> = goals.map(f64::abs).collect();
        sizes.sort_by(f64::total_cmp);
        let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
        Problem { least_size: 1e-3 * median, ..self.clone() }
    }

    /// Returns the size of the goal, by which changes of the goal are divided. The size is the magnitude of
    /// the goal, but at least `least_size`.
    ///
    /// The lower limit is necessary because some goals are zero at the optimum, for example a squared
    /// difference.
    pub(super) fn size(&self, goal: f64) -> f64 {
        let size = goal.abs().max(self.least_size);
        if size == 0.0 { 1.0 } else { size }
    }

    /// Returns the problem to find the best value of the expression `goal` within the axes of `plan`. The
    /// optimum must satisfy the `conditions` and the conditions of the plan.
    ///
    /// # Errors
    /// [`ProblemError`] with the first mistake that is found.
    pub fn new(plan: Plan, goal: &str, aim: Aim, conditions: &[String]) -> Result<Problem, ProblemError> {
        let region = Region::of(&plan).map_err(|parameter| without_bounds(&plan.parameters()[parameter]))?;
        if plan.axes().as_slice().is_empty() {
            return Err(ProblemError {
                part: ProblemPart::Plan,
                message: "the grid varies no parameter".to_owned(),
                help: Some("give the smallest and the largest value of parameters under [axes]".to_owned()),
            });
        }
        let value = parsed(&plan, goal, ProblemPart::Goal, Kind::Number)?;
        let (mut limits, mut kept) = (Vec::new(), Vec::new());
        for (number, condition) in conditions.iter().enumerate() {
            let part = ProblemPart::Condition(number);
            let expression = parsed(&plan, condition, part, Kind::Condition)?;
            let is_input = |place| plan.body().is_some_and(|body| body.has_input(place));
            let is_parameter = |place| place < plan.parameters().len() && !is_input(place);
            let is_of_parameters = expression.reads().all(is_parameter);
            match Limit::of_condition(&expression, |span| condition[span].to_owned()) {
                Some(found) => limits.extend(found),
                None if is_of_parameters => kept.push(Condition { name: condition.clone(), expression }),
                None => {
                    return Err(ProblemError {
                        part,
                        message: "a condition on measures consists of comparisons with <, <=, > or >=, joined with `and`".to_owned(),
                        help: Some("only conditions on parameters alone can contain `or`, `not`, == or !=".to_owned()),
                    });
                }
            }
        }
        for condition in plan.conditions() {
            match Limit::of_condition(&condition.expression, |_| condition.name.clone()) {
                Some(found) => limits.extend(found),
                None => kept.push(condition.clone()),
            }
        }
        let own = |name: String, expression: &Expression| OwnMeasure { name, expression: expression.clone() };
        let mut measures = vec![own("optimum goal".to_owned(), &value)];
        for (number, limit) in limits.iter().enumerate() {
            measures.push(own(format!("optimum less {number}"), &limit.comparison.less));
            measures.push(own(format!("optimum more {number}"), &limit.comparison.more));
        }
        let names: Vec<String> = measures.iter().map(|measure| measure.name.clone()).collect();
        let measured = plan.clone().with_conditions(kept).with_measures(measures);
        let by: Vec<usize> = region.variables.iter().map(|variable| variable.parameter).collect();
        let sloped = if by.is_empty() {
            None
        } else {
            measured.clone().with_columns(&names).and_then(|plan| plan.with_slopes(by)).ok()
        };
        let goal = goal.trim().to_owned();
        Ok(Problem { plan, measured, sloped, region, aim, goal, value, limits, least_size: 0.0 })
    }

    /// Returns the plan with the axes of the problem.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Returns the expression of the goal as the user wrote it.
    pub fn goal(&self) -> &str {
        &self.goal
    }

    /// Returns the direction of the optimisation: towards larger or smaller values of the goal.
    pub fn aim(&self) -> Aim {
        self.aim
    }

    /// Returns the value of this problem's goal at the best design of a second problem. Both problems must
    /// have the same plan.
    pub fn value(&self, best: &Optimum) -> f64 {
        let measures = &best.row.measures;
        let body = self.plan.body();
        let mut known =
            body.map_or_else(|| best.values.clone(), |body| body.at_hover(&best.values, measures));
        known.extend_from_slice(measures);
        self.value.value(&known)
    }

    /// True if rows contain derivatives with respect to the varied parameters.
    pub fn has_slopes(&self) -> bool {
        self.sloped.is_some()
    }

    /// The index of the goal in the measures of a row. In the list of measures, the goal is followed by the
    /// values of both sides of each limit.
    pub(super) fn goal_index(&self) -> usize {
        self.plan.rows().columns().len() + self.plan.measures().len()
    }
}

fn without_bounds(parameter: &Parameter) -> ProblemError {
    ProblemError {
        part: ProblemPart::Plan,
        message: format!("the distribution of `{}` has no smallest and largest value", parameter.name),
        help: Some("vary it under [axes], or sample it with `from` and `to` alone".to_owned()),
    }
}

/// Parses the expression `text`. The value `wanted` determines if the expression must be a number or a
/// condition.
fn parsed(plan: &Plan, text: &str, part: ProblemPart, wanted: Kind) -> Result<Expression, ProblemError> {
    let names = Names { plan };
    let refused = |message: String, help: Option<String>| ProblemError { part, message, help };
    let expression = Expression::parse(text, &names).map_err(|errors| {
        let explained = |error: &ExpressionError| {
            let listed = || format!("measures are {}", text::listed(plan.measured(), "measure"));
            let help = error.help.clone().or_else(|| error.message.contains("name").then(listed));
            refused(error.message.clone(), help)
        };
        errors.first().map_or_else(|| refused("not an expression".to_owned(), None), explained)
    })?;
    if expression.kind() == wanted {
        return Ok(expression);
    }
    Err(match wanted {
        Kind::Number => refused("a condition, not a number".to_owned(), None),
        Kind::Condition => refused(
            "a number, not a condition".to_owned(),
            Some("write a comparison such as lift_mean_mn > 1".to_owned()),
        ),
    })
}

/// The names that goals and conditions may contain: parameters, measures of the model, and measures that the
/// grid file defines.
struct Names<'p> {
    plan: &'p Plan,
}

impl Names<'_> {
    fn of_parameter(&self, index: usize) -> Meaning<'_> {
        let index = self.plan.standing(index);
        let unset = match self.plan.base()[index] {
            Value::Resonance => Some("the resonance of each design, which is the measure resonance_hz"),
            _ => self.plan.unset(index),
        };
        match (&self.plan.parameters()[index].kind, unset) {
            (ParameterKind::Choice(options), _) => Meaning::Choice(index, options),
            (_, Some(follows)) => Meaning::Unset(follows, String::new()),
            (_, None) => Meaning::Number(index),
        }
    }
}

impl Scope for Names<'_> {
    fn meaning(&self, name: &str) -> Option<Meaning<'_>> {
        let parameters = self.plan.parameters();
        if let Some(index) = Parameter::index(parameters, name) {
            return Some(self.of_parameter(index));
        }
        let columns = self.plan.rows().columns();
        if let Some(place) = columns.iter().position(|column| column.name == name) {
            return Some(Meaning::Number(parameters.len() + place));
        }
        let place = self.plan.measures().iter().position(|own| own.name == name)?;
        let index = parameters.len() + columns.len() + place;
        Some(match self.plan.measures()[place].kind() {
            Kind::Number => Meaning::Number(index),
            Kind::Condition => Meaning::Condition(index),
        })
    }

    fn names(&self) -> Vec<String> {
        let parameters = self.plan.parameters().iter().map(|parameter| parameter.name.to_owned());
        self.plan.measured().map(str::to_owned).chain(parameters).collect()
    }

    fn has_units(&self) -> bool {
        true
    }

    fn unit(&self, name: &str) -> Option<String> {
        if let Some(index) = Parameter::index(self.plan.parameters(), name) {
            return Some(self.plan.parameters()[index].unit.to_owned());
        }
        let column = self.plan.rows().columns().iter().find(|column| column.name == name);
        let own = || self.plan.measures().iter().any(|own| own.name == name).then(String::new);
        column.map(|column| column.unit.to_owned()).or_else(own)
    }
}
