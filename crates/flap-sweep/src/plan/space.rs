//! A checked design space, the model or vehicle of its points, and the files that it comes from and goes to.
//!
//! A plan is never materialised: [`Plan::point`] computes any point in constant time.

use std::ops::Deref;
use std::path::PathBuf;
use std::sync::Arc;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Point, Rows, Simulator, SolverSettings};
use flap_core::vehicle::Vehicle;
use serde::{Deserialize, Serialize};

use super::axes::{Along, Axes};
use super::formula::{Condition, Derived, OwnMeasure};
use super::gradient::Gradient;
use super::selection::Selection;
use super::uncertainty::Uncertainty;
use super::value::{Value, WithUnits};
use crate::resonance::AtResonance;

/// A design space that has passed every check, and the settings with which its points are run.
///
/// [`crate::grid`] makes plans from grid files. The methods that change a plan keep it true: values are in their ranges,
/// each parameter is set, varied or derived in one place, and the points that are run are points of the plan.
#[derive(Clone)]
pub struct Plan {
    pub(super) space: Space,
    pub(super) selection: Selection,
    pub(super) followed: Option<Along>,
    /// One state per point from which its motion begins; `None` for a motion from rest. Empty if all begin at rest.
    pub(super) begins: Vec<Option<Vec<f64>>>,
    /// The components of the state that rows have; empty if they have none.
    pub(super) states: Vec<String>,
}

/// The contents of a grid file that has passed every check.
#[derive(Clone)]
pub(crate) struct Space {
    /// The simulator of the points.
    pub(crate) robot: Robot,
    /// The search for resonances if each design is run at its own.
    pub(crate) resonance: Option<AtResonance>,
    /// Name of the preset that the parameters start from.
    pub(crate) preset: &'static str,
    /// One value per parameter: the preset or the device with `[params]` on top.
    pub(crate) base: Vec<Value>,
    /// The parameters whose values, here or along an axis, are written with their units.
    pub(crate) with_units: WithUnits,
    /// Standard errors of these values, and their correlations.
    pub(crate) uncertainty: Uncertainty,
    /// The devices that the grid begins with: its own, then those that this one begins with.
    pub(crate) devices: Vec<Source>,
    /// The varied parameters.
    pub(crate) axes: Axes,
    /// The file that lists the points of the sample, if one does.
    pub(crate) points_file: Option<PointsFile>,
    /// The parameters that are computed from others.
    pub(crate) derived: Derived,
    /// The conditions that points satisfy, or are not run.
    pub(crate) conditions: Vec<Condition>,
    /// The columns that are computed from the model's measures. Each may use those before it.
    pub(crate) measures: Vec<OwnMeasure>,
    /// The derivatives that rows have.
    pub(crate) gradient: Option<Gradient>,
    /// Tolerances and limits of the integration.
    pub(crate) solver: SolverSettings,
    /// The file that rows go to, and its columns.
    pub(crate) output: Output,
    /// The parameters that the grid file calls by their former names.
    pub(crate) renamed: Vec<&'static Parameter<'static>>,
    /// The parameters of all wings that the grid sets or varies, although each wing has one of its own.
    pub(crate) unreached: Vec<&'static Parameter<'static>>,
    /// The grid file itself, for provenance.
    pub(crate) source: Source,
}

impl Plan {
    /// The plan of a design space, of which all points are run.
    pub(crate) fn new(space: Space) -> Plan {
        Plan { space, selection: Selection::All, followed: None, begins: Vec::new(), states: Vec::new() }
    }

    /// The simulator of the points: a model or a vehicle.
    pub fn robot(&self) -> &Robot {
        &self.space.robot
    }

    /// The model, or the vehicle if the points are vehicles.
    pub fn simulator(&self) -> &dyn Simulator {
        &**self.robot()
    }

    /// The vehicle, if the points are vehicles.
    pub fn vehicle(&self) -> Option<&Vehicle> {
        self.robot().vehicle()
    }

    /// The model's parameter table.
    pub fn parameters(&self) -> &[Parameter<'_>] {
        self.simulator().parameters()
    }

    /// The search for resonances if each design is run at its own.
    pub fn resonance(&self) -> Option<&AtResonance> {
        self.space.resonance.as_ref()
    }

    /// The maker of rows: the model, or the model at the resonance of each design.
    pub fn rows(&self) -> &dyn Rows {
        match self.resonance() {
            Some(resonance) => resonance,
            None => self.simulator(),
        }
    }

    /// Name of the preset that the parameters start from; empty if the plan does without.
    pub fn preset(&self) -> &'static str {
        self.space.preset
    }

    /// One value per parameter before the axes are applied: the preset with `[params]` on top.
    pub fn base(&self) -> &[Value] {
        &self.space.base
    }

    /// True if the value of a parameter, or all of its values along an axis, are written with their unit.
    pub fn has_unit(&self, parameter: usize) -> bool {
        self.space.with_units.contain(parameter)
    }

    /// Standard errors of these values, and their correlations.
    pub fn uncertainty(&self) -> &Uncertainty {
        &self.space.uncertainty
    }

    /// The devices that the plan begins with, as read: the grid's own, then those that this one begins with.
    pub fn devices(&self) -> &[Source] {
        &self.space.devices
    }

    /// The varied parameters.
    pub fn axes(&self) -> &Axes {
        &self.space.axes
    }

    /// The file that lists the points of the sample, if one does.
    pub fn points_file(&self) -> Option<&PointsFile> {
        self.space.points_file.as_ref()
    }

    /// The parameters that are computed from others.
    pub fn derived(&self) -> &Derived {
        &self.space.derived
    }

    /// The conditions that points satisfy, or are not run.
    pub fn conditions(&self) -> &[Condition] {
        &self.space.conditions
    }

    /// The columns that are computed from the model's measures. Each may use those before it.
    pub fn measures(&self) -> &[OwnMeasure] {
        &self.space.measures
    }

    /// The derivatives that rows have, if they have any. Rows of curves have none.
    pub fn gradient(&self) -> Option<&Gradient> {
        self.space.gradient.as_ref().filter(|_| self.followed().is_none())
    }

    /// Tolerances and limits of the integration.
    pub fn solver(&self) -> &SolverSettings {
        &self.space.solver
    }

    /// The file that rows go to, and its columns.
    pub fn output(&self) -> &Output {
        &self.space.output
    }

    /// The parameters that the grid file calls by the names of earlier versions.
    pub fn renamed(&self) -> &[&'static Parameter<'static>] {
        &self.space.renamed
    }

    /// The parameters of all wings that the grid file sets or varies in vain: each wing has one of its own.
    pub fn unreached(&self) -> &[&'static Parameter<'static>] {
        &self.space.unreached
    }

    /// The grid file itself, for provenance.
    pub fn source(&self) -> &Source {
        &self.space.source
    }

    /// The points that are run.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The parameter that rises and falls, if each point is a design with a curve of rows.
    pub fn followed(&self) -> Option<&Along> {
        self.followed.as_ref()
    }

    /// The components of the state at the beginning of a motion's period that rows have; empty if they have none.
    pub fn states(&self) -> &[String] {
        &self.states
    }

    /// Number of points.
    pub fn len(&self) -> u64 {
        self.axes().points()
    }

    /// True if there are no points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Point number `index`, which must be less than [`Plan::len`].
    pub fn point(&self, index: u64) -> Point {
        let place = usize::try_from(index).unwrap_or(usize::MAX);
        let begin = self.begins.get(place).cloned().flatten();
        Point { begin, ..Point::at_rest(index, self.values(index, None)) }
    }

    /// The values of point number `index` with one parameter `moved`. Derived parameters follow it.
    pub(crate) fn changed(&self, index: u64, parameter: usize, moved: impl Fn(f64) -> f64) -> Vec<f64> {
        self.values(index, Some((parameter, &moved)))
    }

    fn values(&self, index: u64, change: Option<(usize, &dyn Fn(f64) -> f64)>) -> Vec<f64> {
        let mut values: Vec<f64> = self.base().iter().map(|value| value.in_point()).collect();
        self.axes().fill(index, &mut values);
        if let Some((parameter, moved)) = change {
            values[parameter] = moved(values[parameter]);
        }
        self.derived().fill(&mut values, &[]);
        values
    }

    /// Number of points that are run.
    pub fn selected(&self) -> u64 {
        self.selection.len(self.len())
    }

    /// Number `position` of the points that are run, which must be less than [`Plan::selected`].
    pub fn selected_point(&self, position: u64) -> Point {
        self.point(self.selection.index(position))
    }

    /// Indices of the parameters that differ from point to point, in the order of their columns: the varied ones in the order
    /// of the axes, then the derived ones.
    pub fn differing(&self) -> impl Iterator<Item = usize> + '_ {
        self.axes().varied().chain(self.derived().parameters())
    }

    /// Adds the plan's own measures to those of a row, if the point has them.
    pub fn add_own_measures(&self, values: &[f64], measures: &mut Vec<f64>) {
        // A row that the model made at a resonance found before lacks the columns about that resonance.
        if self.measures().is_empty() || measures.len() != self.rows().columns().len() {
            return;
        }
        let mut known = values.to_vec();
        known.extend_from_slice(measures);
        for own in self.measures() {
            known.push(own.value(&known));
        }
        measures.extend_from_slice(&known[values.len() + measures.len()..]);
    }
}

/// The simulator of a plan's points: a model of one wing, or a vehicle.
#[derive(Clone)]
pub enum Robot {
    /// A model.
    Wing(&'static dyn Simulator),
    /// Several wings of a model.
    Vehicle(Arc<Vehicle>),
}

impl Robot {
    /// The model of the wings.
    pub fn model(&self) -> &'static dyn Simulator {
        match self {
            Robot::Wing(model) => *model,
            Robot::Vehicle(vehicle) => vehicle.model(),
        }
    }

    /// The vehicle, if it is one.
    pub fn vehicle(&self) -> Option<&Vehicle> {
        match self {
            Robot::Wing(_) => None,
            Robot::Vehicle(vehicle) => Some(vehicle),
        }
    }
}

impl Deref for Robot {
    type Target = dyn Simulator;

    fn deref(&self) -> &Self::Target {
        match self {
            Robot::Wing(model) => *model,
            Robot::Vehicle(vehicle) => &**vehicle,
        }
    }
}

/// The file that rows go to, and its columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Output {
    /// Path as written in the grid file, relative to the working directory; `None` if it names none.
    pub path: Option<PathBuf>,
    /// Indices into the model's columns, followed by the plan's own measures and the columns on the course of a run, in the
    /// order wanted; `None` for all.
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

/// A grid file or a device as read.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Name for messages, usually the path.
    pub name: String,
    /// The text.
    pub text: String,
}
