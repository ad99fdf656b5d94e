//! A checked design space: which points there are, and how each is run.
//!
//! A plan is never materialised: [`Plan::point`] computes any point in constant time.

use std::path::PathBuf;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Point, Rows, Simulator, SolverSettings};

use crate::axis::{Axis, Values};
use crate::resonance::AtResonance;
use crate::selection::Selection;

/// A design space that has passed every check. Made by [`crate::spec`] only.
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
    /// How points are integrated.
    pub solver: SolverSettings,
    /// Where rows go.
    pub output: Output,
    /// The grid file itself, for provenance.
    pub source: Source,
    /// Which of the points are run.
    pub selection: Selection,
    points: u64,
}

/// Where rows go and which columns they have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Output {
    /// Path as written in the grid file, relative to the working directory; `None` if it names none.
    pub path: Option<PathBuf>,
    /// Indices into the model's columns, in the order wanted; `None` for all.
    pub columns: Option<Vec<usize>>,
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
                let Parts { simulator, resonance, preset, base, axes, solver, output, source } = parts;
                let selection = Selection::All;
                Ok(Plan {
                    simulator,
                    resonance,
                    preset,
                    base,
                    axes,
                    solver,
                    output,
                    source,
                    selection,
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
