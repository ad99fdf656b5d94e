//! A checked design space: which points there are, and how each is run.
//!
//! A plan is never materialised: [`Plan::point`] computes any point in constant time.

mod along;
pub mod axis;
pub mod formula;
pub mod sample;
pub mod selection;

use std::path::PathBuf;

use flap_core::parameter::{Invalid, Kind, Parameter, Range};
use flap_core::simulate::{Point, Rows, Simulator, SolverSettings};

use crate::notation::text;
use crate::plan::axis::{Axis, Values};
use crate::plan::formula::{Condition, Derived, OwnMeasure};
use crate::plan::selection::Selection;
use crate::resonance::AtResonance;
pub use along::Along;

/// A design space that has passed every check. Made by [`crate::grid`] only.
pub struct Plan {
    /// The model.
    pub simulator: &'static dyn Simulator,
    /// What turns points into rows if each design is run at its own resonance.
    pub resonance: Option<AtResonance>,
    /// Name of the preset that the parameters start from.
    pub preset: &'static str,
    /// Parameter values before the axes are applied: the preset with `[params]` on top. NaN for what is not set: a number
    /// that follows others, or a drive frequency that is to be the resonance.
    pub base: Vec<f64>,
    /// The axes; the last varies fastest.
    pub axes: Vec<Axis>,
    /// The file that lists the points of the sample, if one does.
    pub points_file: Option<PointsFile>,
    /// The parameters that are computed from others.
    pub derived: Derived,
    /// The conditions that points satisfy, or are not run.
    pub conditions: Vec<Condition>,
    /// The columns that are computed from what rows measure. Each may use those before it.
    pub measures: Vec<OwnMeasure>,
    /// How points are integrated.
    pub solver: SolverSettings,
    /// Where rows go.
    pub output: Output,
    /// The grid file itself, for provenance.
    pub source: Source,
    /// Which of the points are run.
    pub selection: Selection,
    /// The parameter that rises and falls, if each point is a design with a curve of rows.
    pub followed: Option<Along>,
    points: u64,
}

/// Where rows go and which columns they have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Output {
    /// Path as written in the grid file, relative to the working directory; `None` if it names none.
    pub path: Option<PathBuf>,
    /// Indices into the model's columns, followed by the plan's own measures, in the order wanted; `None` for all.
    pub columns: Option<Vec<usize>>,
}

/// A file that lists the points of a sample.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PointsFile {
    /// Its path, from the working directory.
    pub path: PathBuf,
    /// The hash of its text: XXH3 of 64 bits.
    pub xxh3: u64,
}

impl PointsFile {
    /// The hash in hexadecimal digits.
    pub fn hash(&self) -> String {
        format!("{:016x}", self.xxh3)
    }
}

/// Whether a point is run.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It is run.
    Runs,
    /// It does not satisfy the conditions with these numbers. It has no row.
    Excluded(Vec<usize>),
    /// It cannot be run, but has a row that says so.
    Invalid(Invalid),
}

/// A grid file as read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Source {
    /// Name for messages, usually the path.
    pub name: String,
    /// The text.
    pub text: String,
}

/// Everything a plan is made of, before its size is known.
pub(crate) struct Parts {
    pub(crate) simulator: &'static dyn Simulator,
    pub(crate) resonance: Option<AtResonance>,
    pub(crate) preset: &'static str,
    pub(crate) base: Vec<f64>,
    pub(crate) axes: Vec<Axis>,
    pub(crate) points_file: Option<PointsFile>,
    pub(crate) derived: Derived,
    pub(crate) conditions: Vec<Condition>,
    pub(crate) measures: Vec<OwnMeasure>,
    pub(crate) solver: SolverSettings,
    pub(crate) output: Output,
    pub(crate) source: Source,
}

impl Plan {
    /// The largest number of points a plan may have: 2^63.
    pub const MAX_POINTS: u64 = 1 << 63;

    /// Builds the plan, or gives the parts back if it would have more than [`Plan::MAX_POINTS`] points.
    pub(crate) fn new(parts: Parts) -> Result<Plan, Box<Parts>> {
        let points = parts.axes.iter().try_fold(1_u64, |product, axis| product.checked_mul(axis.len()));
        match points {
            Some(points) if points <= Plan::MAX_POINTS => {
                let Parts {
                    simulator,
                    resonance,
                    preset,
                    base,
                    axes,
                    points_file,
                    derived,
                    conditions,
                    measures,
                    solver,
                    output,
                    source,
                } = parts;
                let selection = Selection::All;
                Ok(Plan {
                    simulator,
                    resonance,
                    preset,
                    base,
                    axes,
                    points_file,
                    derived,
                    conditions,
                    measures,
                    solver,
                    output,
                    source,
                    selection,
                    followed: None,
                    points,
                })
            }
            _ => Err(Box::new(parts)),
        }
    }

    /// Takes an axis out of the plan and gives its values, if one varies this parameter and no other.
    pub fn take_axis(&mut self, parameter: usize) -> Option<Values> {
        let alone = |axis: &Axis| matches!(axis.parameters[..], [(varied, _)] if varied == parameter);
        let axis = self.axes.remove(self.axes.iter().position(alone)?);
        self.points /= axis.len();
        axis.parameters.into_iter().next().map(|(_, values)| values)
    }

    /// Crosses the points with rows of values that a program gives for some parameters, as many for each: an axis before
    /// all others. False, and no change, if that would make more than [`Plan::MAX_POINTS`] points.
    #[must_use]
    pub fn cross(&mut self, parameters: Vec<(usize, Vec<f64>)>) -> bool {
        let parameters =
            parameters.into_iter().map(|(parameter, list)| (parameter, Values::Unchecked(list))).collect();
        let axis = Axis { parameters };
        match self.points.checked_mul(axis.len()) {
            Some(points) if points <= Plan::MAX_POINTS => {
                self.points = points;
                self.axes.insert(0, axis);
                true
            }
            _ => false,
        }
    }

    /// Number of points.
    pub fn len(&self) -> u64 {
        self.points
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.points == 0
    }

    /// Point number `index`, which must be less than [`Plan::len`].
    pub fn point(&self, index: u64) -> Point {
        let mut values = self.base.clone();
        let mut rest = index;
        for axis in self.axes.iter().rev() {
            let position = rest % axis.len();
            rest /= axis.len();
            for (parameter, along) in &axis.parameters {
                values[*parameter] = along.get(position);
            }
        }
        self.derived.fill(&mut values, &[]);
        Point::at_rest(index, values)
    }

    /// Number of points that are run.
    pub fn selected(&self) -> u64 {
        self.selection.len(self.points)
    }

    /// Number `position` of the points that are run, which must be less than [`Plan::selected`].
    pub fn selected_point(&self, position: u64) -> Point {
        self.point(self.selection.index(position))
    }

    /// Whether the point with these values is run.
    pub fn judge(&self, values: &[f64]) -> Verdict {
        let held: Vec<Option<bool>> =
            self.conditions.iter().map(|condition| condition.holds(values)).collect();
        let unsatisfied: Vec<usize> = (0..held.len()).filter(|&number| held[number] == Some(false)).collect();
        if !unsatisfied.is_empty() {
            return Verdict::Excluded(unsatisfied);
        }
        if let Some(parameter) = self.computed().find(|&parameter| !self.is_allowed(parameter, values)) {
            return Verdict::Invalid(self.not_allowed(parameter, values[parameter]));
        }
        let unknown = self.conditions.iter().zip(held).find(|(_, holds)| holds.is_none());
        match unknown {
            Some((condition, _)) => Verdict::Invalid(Invalid::new(format!(
                "whether it satisfies the condition `{}` cannot be computed",
                condition.name
            ))),
            None => Verdict::Runs,
        }
    }

    /// The parameters whose values nobody has seen: sampled and derived ones, and those that a program gives.
    fn computed(&self) -> impl Iterator<Item = usize> + '_ {
        let varied = self.axes.iter().flat_map(|axis| &axis.parameters);
        let unseen =
            varied.filter(|(_, values)| matches!(values, Values::Sampled { .. } | Values::Unchecked(_)));
        unseen.map(|(parameter, _)| *parameter).chain(self.derived.parameters())
    }

    fn is_allowed(&self, parameter: usize, values: &[f64]) -> bool {
        range(&self.parameters()[parameter]).contains(values[parameter])
    }

    /// Why a computed value cannot be used.
    fn not_allowed(&self, parameter: usize, value: f64) -> Invalid {
        let parameter = &self.parameters()[parameter];
        let Parameter { name, unit, .. } = parameter;
        if value.is_nan() {
            return Invalid::new(format!("`{name}` comes out as not a number"));
        }
        let value = format!("{} {unit}", text::float(value));
        let allowed = range(parameter).describe();
        Invalid::new(format!("`{name}` comes out as {}, but must be {allowed}", value.trim_end()))
    }

    /// Adds the plan's own measures to those of a row, if the point has them.
    pub fn add_own_measures(&self, values: &[f64], measures: &mut Vec<f64>) {
        // A row that the model made at a resonance found before lacks what was found out about that.
        if self.measures.is_empty() || measures.len() != self.rows().columns().len() {
            return;
        }
        let mut known = values.to_vec();
        known.extend_from_slice(measures);
        for own in &self.measures {
            known.push(own.value(&known));
        }
        measures.extend_from_slice(&known[values.len() + measures.len()..]);
    }

    /// Indices of the varied parameters, in the order of the axes: the columns after `point`.
    pub fn varied(&self) -> impl Iterator<Item = usize> + '_ {
        self.axes.iter().flat_map(|axis| axis.parameters.iter().map(|(parameter, _)| *parameter))
    }

    /// What turns points into rows: the model, or the model at the resonance of each design.
    pub fn rows(&self) -> &dyn Rows {
        match &self.resonance {
            Some(resonance) => resonance,
            None => self.simulator,
        }
    }

    /// The model's parameter table.
    pub fn parameters(&self) -> &'static [Parameter] {
        self.simulator.parameters()
    }
}

/// The numbers that a parameter accepts.
fn range(parameter: &Parameter) -> Range {
    match parameter.kind {
        Kind::Number(range) | Kind::Following(range, _) => range,
        Kind::Choice(_) => Range::NonNegative,
    }
}
