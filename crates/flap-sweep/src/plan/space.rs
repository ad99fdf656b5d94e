//! A plan is the checked contents of a grid file: the points, their model or vehicle, and the input and
//! output files.
//!
//! The points of the axes are not stored: [`Plan::point`] computes any point in constant time. Only points that a
//! refinement adds are stored.

use std::path::PathBuf;
use std::sync::Arc;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Point, Rows, Simulator, SolverSettings};
use flap_core::vehicle::{Vehicle, of_all_wings};
use serde::{Deserialize, Serialize};

use super::axes::{Along, Axes};
use super::formula::{Condition, Derived, OwnMeasure};
use super::gradient::Gradient;
use super::refine::Refine;
use super::robot::{Differences, Robot};
use super::selection::Selection;
use super::uncertainty::Uncertainty;
use super::value::{Value, WithUnits};
use crate::resonance::AtResonance;
use crate::vehicle::BodyRows;

/// A checked design space, and the settings for the computation of its points.
///
/// [`crate::grid`] makes plans from grid files. Methods that change a plan keep the plan valid: values are in
/// range, and exactly one part of the plan determines each parameter. The selection of a plan contains only
/// indices of existing points.
#[derive(Clone)]
pub struct Plan {
    pub(super) space: Space,
    pub(super) selection: Selection,
    pub(super) followed: Option<Along>,
    /// The initial state of each point, or `None` for a motion that begins at rest. If all motions begin at
    /// rest, the list is empty.
    pub(super) initial_states: Vec<Option<Vec<f64>>>,
    /// Names of the components of the state, if rows contain the state. If rows contain no state, the list is
    /// empty.
    pub(super) states: Vec<String>,
    /// Points that a refinement has added after the points of the axes. Each point is a list of positions,
    /// one along each axis.
    pub(super) added: Arc<Vec<Vec<f64>>>,
}

/// Contents of a checked grid file.
#[derive(Clone)]
pub(crate) struct Space {
    /// The simulator that computes the points.
    pub(crate) robot: Robot,
    /// The object that computes rows at the resonance, if flap computes each design at its own resonance.
    pub(crate) resonance: Option<AtResonance>,
    /// The object that computes rows at hover or with the damping matrix, if the grid file requests such
    /// rows.
    pub(crate) body: Option<BodyRows>,
    /// Name of the preset.
    pub(crate) preset: &'static str,
    /// Value that each parameter has if no axis varies the parameter, from the preset, the device or
    /// `[params]`.
    pub(crate) base: Vec<Value>,
    /// Parameters whose values have units in the file, in `[params]` or along an axis.
    pub(crate) with_units: WithUnits,
    /// Standard errors of the parameters, and correlations between the parameters.
    pub(crate) uncertainty: Uncertainty,
    /// Devices of the grid: first the device that the grid file names, then the devices on which this device
    /// is based.
    pub(crate) devices: Vec<Source>,
    /// Parameter values in which the designs of the plan differ, if the plan has several designs.
    pub(crate) differences: Differences,
    /// Axes, which contain the varied parameters and their values.
    pub(crate) axes: Axes,
    /// Settings of the refinement, if the grid file requests a refinement.
    pub(crate) refine: Option<Refine>,
    /// File that lists the points of the sample, if there is such a file.
    pub(crate) points_file: Option<PointsFile>,
    /// Parameters that are computed from other parameters.
    pub(crate) derived: Derived,
    /// Conditions. flap does not compute points that do not satisfy all conditions.
    pub(crate) conditions: Vec<Condition>,
    /// Columns that the user defines by expressions. An expression can contain the model's measures and
    /// earlier columns of the user.
    pub(crate) measures: Vec<OwnMeasure>,
    /// The derivatives that rows contain, if there are any.
    pub(crate) gradient: Option<Gradient>,
    /// Tolerances and limits of the integration.
    pub(crate) solver: SolverSettings,
    /// Path and columns of the results file.
    pub(crate) output: Output,
    /// Parameters that the grid file sets or varies for all wings without effect, because each wing has its
    /// own value.
    pub(crate) unreached: Vec<&'static Parameter<'static>>,
    /// Name and text of the grid file, which are recorded with the results.
    pub(crate) source: Source,
}

impl Plan {
    /// Returns the plan that computes all points of a design space.
    pub(crate) fn new(space: Space) -> Plan {
        Plan {
            space,
            selection: Selection::All,
            followed: None,
            initial_states: Vec::new(),
            states: Vec::new(),
            added: Arc::default(),
        }
    }

    /// Returns the simulator that computes the points: a model or a vehicle.
    pub fn robot(&self) -> &Robot {
        &self.space.robot
    }

    /// Returns the vehicle if the plan describes vehicles, and otherwise the model. In contrast to
    /// [`Plan::parameters`], the parameters of the model or vehicle do not include the parameter that names
    /// the design.
    pub fn simulator(&self) -> &dyn Simulator {
        &**self.robot()
    }

    /// Returns the vehicle, if the plan describes vehicles.
    pub fn vehicle(&self) -> Option<&Vehicle> {
        self.robot().vehicle().map(Arc::as_ref)
    }

    /// Returns the parameters of points: the model's parameter table, and the parameter that names the design if the
    /// plan has several designs.
    pub fn parameters(&self) -> &[Parameter<'_>] {
        self.robot().parameters()
    }

    /// Returns the object that computes rows at the resonance, if flap computes each design at its own
    /// resonance.
    pub fn resonance(&self) -> Option<&AtResonance> {
        self.space.resonance.as_ref()
    }

    /// Returns the object that computes rows at hover or with the damping matrix, if the plan has such rows.
    pub fn body(&self) -> Option<&BodyRows> {
        self.space.body.as_ref()
    }

    /// Returns the object that computes rows: the model, the vehicle, or a search for the resonance or hover
    /// of each design.
    pub fn rows(&self) -> &dyn Rows {
        match (self.resonance(), self.body()) {
            (Some(resonance), _) => resonance,
            (None, Some(body)) => body,
            (None, None) => self.simulator(),
        }
    }

    /// Returns true if flap searches for the resonance or for hover at each point.
    pub(crate) fn has_search(&self) -> bool {
        self.resonance().is_some() || self.body().is_some_and(BodyRows::is_at_hover)
    }

    /// Returns the name of the preset, or an empty text if the plan has no preset.
    pub fn preset(&self) -> &'static str {
        self.space.preset
    }

    /// Returns the value that each parameter has if no axis varies the parameter, from the preset, the device
    /// or `[params]`.
    pub fn base(&self) -> &[Value] {
        &self.space.base
    }

    /// Returns the index of the parameter that names the design, if the plan has several designs.
    pub fn design(&self) -> Option<usize> {
        self.robot().has_designs().then(|| self.parameters().len() - 1)
    }

    /// Returns the value of a parameter in each design of the plan, if the designs have different values of
    /// this parameter.
    pub fn in_designs(&self, parameter: usize) -> Option<&[f64]> {
        self.space.differences.of(parameter)
    }

    /// Returns true if the value of a parameter, or all of its values along an axis, have units in the file.
    pub fn has_unit(&self, parameter: usize) -> bool {
        self.space.with_units.contain(parameter)
    }

    /// Returns the standard errors of the parameters, and the correlations between the parameters.
    pub fn uncertainty(&self) -> &Uncertainty {
        &self.space.uncertainty
    }

    /// Returns the names and texts of the devices: first the device that the grid file names, then the
    /// devices on which this device is based.
    pub fn devices(&self) -> &[Source] {
        &self.space.devices
    }

    /// Returns the axes with the varied parameters.
    pub fn axes(&self) -> &Axes {
        &self.space.axes
    }

    /// Returns the settings of the refinement, if the plan has a refinement. A plan of responses has no
    /// refinement.
    pub fn refine(&self) -> Option<&Refine> {
        self.space.refine.as_ref().filter(|_| self.followed().is_none())
    }

    /// Returns the points that a refinement has added after the points of the axes. Each point is a list of
    /// positions, one along each axis.
    ///
    /// For example, the position 1.5 is midway between the second and the third value of the axis.
    pub fn added(&self) -> &[Vec<f64>] {
        &self.added
    }

    /// Returns the file that lists the points of the sample, if there is such a file.
    pub fn points_file(&self) -> Option<&PointsFile> {
        self.space.points_file.as_ref()
    }

    /// Returns the parameters that are computed from other parameters.
    pub fn derived(&self) -> &Derived {
        &self.space.derived
    }

    /// Returns the conditions. flap does not compute points that do not satisfy all conditions.
    pub fn conditions(&self) -> &[Condition] {
        &self.space.conditions
    }

    /// Returns the columns that the user defines by expressions. An expression can contain the model's
    /// measures and earlier columns of the user.
    pub fn measures(&self) -> &[OwnMeasure] {
        &self.space.measures
    }

    /// Returns the derivatives that rows contain, if there are any. Rows of responses contain no derivatives.
    pub fn gradient(&self) -> Option<&Gradient> {
        self.space.gradient.as_ref().filter(|_| self.followed().is_none())
    }

    /// Returns the tolerances and limits of the integration.
    pub fn solver(&self) -> &SolverSettings {
        &self.space.solver
    }

    /// Returns the path and the columns of the results file.
    pub fn output(&self) -> &Output {
        &self.space.output
    }

    /// Returns the parameters that the grid file sets or varies for all wings without effect, because each
    /// wing has its own value.
    pub fn unreached(&self) -> &[&'static Parameter<'static>] {
        &self.space.unreached
    }

    /// Returns the name and the text of the grid file, which are recorded with the results.
    pub fn source(&self) -> &Source {
        &self.space.source
    }

    /// Returns the selection of the points that flap computes.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// Returns the parameter that rises and falls, if the plan computes a response for each point.
    pub fn followed(&self) -> Option<&Along> {
        self.followed.as_ref()
    }

    /// Returns the names of the components of the state, if rows contain the state. If rows contain no state,
    /// the list is empty.
    pub fn states(&self) -> &[String] {
        &self.states
    }

    /// Returns the number of points, including the points that a refinement has added so far.
    pub fn len(&self) -> u64 {
        self.axes().points() + self.added.len() as u64
    }

    /// Returns the largest number of points that the plan can have after its refinement.
    pub fn most_points(&self) -> u64 {
        self.refine().map_or(0, |refine| refine.max_points).max(self.len())
    }

    /// Returns true if the plan has no points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns point number `index`, which must be less than [`Plan::len`].
    pub fn point(&self, index: u64) -> Point {
        let place = usize::try_from(index).unwrap_or(usize::MAX);
        let begin = self.initial_states.get(place).cloned().flatten();
        Point { begin, ..Point::at_rest(index, self.values(index, None)) }
    }

    /// Returns the parameter values of point number `index` after a change of `parameter`. `moved` computes
    /// the new value of the parameter, and the derived parameters are computed from the new value.
    pub(crate) fn values_with(&self, index: u64, parameter: usize, moved: impl Fn(f64) -> f64) -> Vec<f64> {
        self.values(index, Some((parameter, &moved)))
    }

    fn values(&self, index: u64, change: Option<(usize, &dyn Fn(f64) -> f64)>) -> Vec<f64> {
        let mut values: Vec<f64> = self.base().iter().map(|value| value.in_point()).collect();
        let beyond = index.checked_sub(self.axes().points()).and_then(|place| usize::try_from(place).ok());
        match beyond.and_then(|place| self.added.get(place)) {
            Some(positions) => self.axes().fill_between(positions, &mut values),
            None => self.axes().fill(index, &mut values),
        }
        self.fill_design(&mut values, &[]);
        if let Some((parameter, moved)) = change {
            values[parameter] = moved(values[parameter]);
        }
        self.derived().fill(&mut values, &[]);
        values
    }

    /// Writes the values of a design into `values`, for the parameters in which the designs differ. `values`
    /// already contains the index of the design. Parameters that vary and parameters in `set` keep their
    /// values.
    pub fn fill_design(&self, values: &mut [f64], set: &[usize]) {
        let is_set =
            |parameter| set.contains(&parameter) || self.axes().varied().any(|varied| varied == parameter);
        self.space.differences.fill(values, is_set);
    }

    /// Returns the number of selected points, which flap computes.
    pub fn selected(&self) -> u64 {
        self.selection.len(self.len())
    }

    /// Returns point number `position` of the selected points. `position` must be less than
    /// [`Plan::selected`].
    pub fn selected_point(&self, position: u64) -> Point {
        self.point(self.selection.index(position))
    }

    /// Returns the indices of the parameters that differ between points, in the order of their columns.
    ///
    /// The varied parameters are first, in the order of the axes, followed by the derived parameters.
    pub fn differing(&self) -> impl Iterator<Item = usize> + '_ {
        self.axes().varied().chain(self.derived().parameters())
    }

    /// If no part of the plan sets `parameter`, returns a description of the parameters that determine its
    /// value.
    pub(crate) fn unset(&self, parameter: usize) -> Option<&'static str> {
        match self.base()[parameter] {
            Value::Follows(follows) if self.differing().all(|differing| differing != parameter) => {
                Some(follows)
            }
            Value::Given(_) | Value::Follows(_) | Value::Resonance | Value::OfDesign => None,
        }
    }

    /// Returns the index of the parameter that determines the value of `parameter`, which is usually
    /// `parameter` itself. If a parameter of one wing is not set, the corresponding parameter of all wings
    /// determines its value.
    pub(crate) fn standing(&self, parameter: usize) -> usize {
        let shared = of_all_wings(self.parameters(), parameter).filter(|_| self.unset(parameter).is_some());
        shared.unwrap_or(parameter)
    }

    /// Adds the measures that the user defined to the `measures` of a row, if the row has measures.
    pub fn add_own_measures(&self, values: &[f64], measures: &mut Vec<f64>) {
        // A row of the model at a known resonance, or of a vehicle at a known trim, lacks the columns about it.
        if self.measures().is_empty() || measures.len() != self.rows().columns().len() {
            return;
        }
        let mut known = self.body().map_or_else(|| values.to_vec(), |body| body.at_hover(values, measures));
        known.extend_from_slice(measures);
        for own in self.measures() {
            known.push(own.value(&known));
        }
        measures.extend_from_slice(&known[values.len() + measures.len()..]);
    }
}

/// Path and columns of the results file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Output {
    /// Path that the grid file contains, relative to the working directory. If the grid file contains no
    /// path, this field is `None`.
    pub path: Option<PathBuf>,
    /// Indices of columns in the requested order, or `None` for all columns. The indices count first the
    /// model's columns, then the measures of the plan, and then the columns about the run.
    pub columns: Option<Vec<usize>>,
}

/// A file that lists the points of a sample.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PointsFile {
    /// Path of the file, relative to the working directory.
    pub path: PathBuf,
    /// 64-bit XXH3 hash of the text of the file.
    pub xxh3: u64,
}

impl PointsFile {
    /// Returns the hash of the file in hexadecimal digits.
    pub fn hash(&self) -> String {
        format!("{:016x}", self.xxh3)
    }
}

/// Text of a grid file or a device.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Name of the file in messages, usually its path.
    pub name: String,
    /// Text.
    pub text: String,
}
