//! Simulator of a plan's points: a model or a vehicle, with one or several designs.

use std::ops::Deref;
use std::sync::Arc;

use flap_core::aero::Wing;
use flap_core::num::Backend;
use flap_core::parameter::{Kind, Parameter, Preset};
use flap_core::simulate::{
    Column, Experiments, Gradients, Jobs, Motions, PointRun, Row, Rows, Simulator, SolverSettings, Unfinished,
};
use flap_core::vehicle::Vehicle;
use self_cell::self_cell;

use crate::notation::expression::of_choice;

/// Simulator of a plan's points: a model of one wing or a vehicle, with one or several designs.
#[derive(Clone)]
pub enum Robot {
    /// A model.
    Wing(&'static dyn Simulator),
    /// A vehicle with several wings of a model.
    Vehicle(Arc<Vehicle>),
    /// A model or a vehicle with one more parameter, which is the name of the design.
    Designs(Arc<Designs>),
}

impl Robot {
    /// Returns the model of the wings.
    pub fn model(&self) -> &'static dyn Simulator {
        match self {
            Robot::Wing(model) => *model,
            Robot::Vehicle(vehicle) => vehicle.model(),
            Robot::Designs(designs) => designs.robot().model(),
        }
    }

    /// Returns the vehicle, if there is one.
    pub fn vehicle(&self) -> Option<&Vehicle> {
        match self {
            Robot::Wing(_) => None,
            Robot::Vehicle(vehicle) => Some(vehicle),
            Robot::Designs(designs) => designs.robot().vehicle(),
        }
    }

    /// Returns the robot with one more parameter at the end: a choice called `name` between designs with these labels.
    pub(crate) fn with_designs(self, name: &'static str, labels: Vec<String>) -> Robot {
        let doc = if name == "preset" { PRESET_DOC } else { DEVICE_DOC };
        let labels = Labels::new(labels, |labels| labels.iter().map(String::as_str).collect());
        let table = Table::new((self, labels), |(robot, labels)| {
            let kind = Kind::Choice(labels.borrow_dependent());
            let own = Parameter { default: 0.0, group: "design", ..Parameter::new(name, "", "", kind, doc) };
            robot.parameters().iter().copied().chain([own]).collect()
        });
        Robot::Designs(Arc::new(Designs { table }))
    }
}

const DEVICE_DOC: &str = "Device of the design: the name of its file, without folder and ending.";
const PRESET_DOC: &str = "Preset of the design.";

impl Deref for Robot {
    type Target = dyn Simulator;

    fn deref(&self) -> &Self::Target {
        match self {
            Robot::Wing(model) => *model,
            Robot::Vehicle(vehicle) => &**vehicle,
            Robot::Designs(designs) => &**designs,
        }
    }
}

type Options<'a> = Vec<&'a str>;

self_cell!(
    /// Labels of designs, also as the options of a choice.
    struct Labels {
        owner: Vec<String>,
        #[covariant]
        dependent: Options,
    }
);

type Parameters<'a> = Vec<Parameter<'a>>;

self_cell!(
    /// All parameters, with the robot and the labels from which they borrow.
    struct Table {
        owner: (Robot, Labels),
        #[covariant]
        dependent: Parameters,
    }
);

/// A model or a vehicle with one more parameter, which is the name of the design.
///
/// The additional parameter only labels the points. The additional parameter has no effect on rows, because points
/// contain the values of their design.
pub struct Designs {
    table: Table,
}

impl Designs {
    fn robot(&self) -> &Robot {
        &self.table.borrow_owner().0
    }
}

impl Rows for Designs {
    fn columns(&self) -> &[Column] {
        self.robot().columns()
    }

    fn run(&self, backend: Backend, solver: &SolverSettings, jobs: &mut dyn Jobs) {
        self.robot().run(backend, solver, jobs);
    }

    fn run_point(&self, run: &PointRun<'_>, begin: Option<&[f64]>) -> Row {
        self.robot().run_point(run, begin)
    }
}

impl Simulator for Designs {
    fn name(&self) -> &'static str {
        self.robot().name()
    }

    fn doc(&self) -> &'static str {
        self.robot().doc()
    }

    fn parameters(&self) -> &[Parameter<'_>] {
        self.table.borrow_dependent()
    }

    fn presets(&self) -> &'static [Preset] {
        self.robot().presets()
    }

    fn pitch_sign(&self) -> i8 {
        self.robot().pitch_sign()
    }

    fn wing(&self, wing: &Wing) -> Vec<(&'static str, f64)> {
        self.robot().wing(wing)
    }

    fn has_loads(&self) -> bool {
        self.robot().has_loads()
    }

    fn gradients(&self) -> Result<&dyn Gradients, Unfinished> {
        self.robot().gradients()
    }

    fn motions(&self) -> Result<&dyn Motions, Unfinished> {
        self.robot().motions()
    }

    fn experiments(&self) -> Result<&dyn Experiments, Unfinished> {
        self.robot().experiments()
    }
}

/// Values of the parameters in which the designs of a plan differ.
#[derive(Clone, Debug, Default)]
pub(crate) struct Differences {
    /// Index of the parameter that names the design.
    pub(crate) design: usize,
    /// Parameters, each with its value in each design; NaN if the design does not set it.
    pub(crate) values: Vec<(usize, Vec<f64>)>,
}

impl Differences {
    /// Returns the value of a parameter in each design, if the values differ between the designs.
    pub(crate) fn of(&self, parameter: usize) -> Option<&[f64]> {
        self.values.iter().find(|(differing, _)| *differing == parameter).map(|(_, values)| values.as_slice())
    }

    /// Writes the values of the design that `values` names, except parameters for which `is_varied` returns true.
    pub(super) fn fill(&self, values: &mut [f64], is_varied: impl Fn(usize) -> bool) {
        let Some(design) = values.get(self.design).copied() else { return };
        for (parameter, of_designs) in self.values.iter().filter(|(parameter, _)| !is_varied(*parameter)) {
            values[*parameter] = of_choice(of_designs, design);
        }
    }

    /// Removes a parameter that has the same value in all designs.
    pub(crate) fn remove(&mut self, parameter: usize) {
        self.values.retain(|(differing, _)| *differing != parameter);
    }
}
