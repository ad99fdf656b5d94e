//! The simulator that computes the points of a plan: a model or a vehicle, with one or several designs.

use std::ops::Deref;
use std::sync::Arc;

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::Simulator;
use flap_core::vehicle::Vehicle;
use self_cell::self_cell;

use crate::notation::expression::of_choice;

/// The simulator that computes the points of a plan: a model of one wing or a vehicle, with one or several
/// designs.
#[derive(Clone)]
pub struct Robot {
    wings: Wings,
    /// Parameters of a plan with several designs. The last parameter is the index of the design. The
    /// simulator ignores this index, because each point contains the parameter values of its design.
    designs: Option<Arc<Table>>,
}

#[derive(Clone)]
enum Wings {
    /// A model of one wing.
    One(&'static dyn Simulator),
    /// A vehicle, whose wings all have the same model.
    Vehicle(Arc<Vehicle>),
}

impl Robot {
    /// Returns a robot that is one wing of `model`.
    pub fn of_wing(model: &'static dyn Simulator) -> Robot {
        Robot { wings: Wings::One(model), designs: None }
    }

    pub(crate) fn of_vehicle(vehicle: Arc<Vehicle>) -> Robot {
        Robot { wings: Wings::Vehicle(vehicle), designs: None }
    }

    /// Returns the model of the wings.
    pub fn model(&self) -> &'static dyn Simulator {
        match &self.wings {
            Wings::One(model) => *model,
            Wings::Vehicle(vehicle) => vehicle.model(),
        }
    }

    /// Returns the vehicle, if the robot is a vehicle.
    pub fn vehicle(&self) -> Option<&Arc<Vehicle>> {
        match &self.wings {
            Wings::One(_) => None,
            Wings::Vehicle(vehicle) => Some(vehicle),
        }
    }

    /// Returns the parameters of points: the parameters of the simulator, and the parameter that names the design if
    /// there are several designs.
    pub fn parameters(&self) -> &[Parameter<'_>] {
        match &self.designs {
            Some(table) => table.borrow_dependent(),
            None => self.wings.parameters(),
        }
    }

    /// Returns true if the plan has several designs.
    pub(crate) fn has_designs(&self) -> bool {
        self.designs.is_some()
    }

    /// Returns the robot with an additional last parameter: a choice called `name`, whose options are the
    /// labels of the designs.
    pub(crate) fn with_designs(self, name: &'static str, labels: Vec<String>) -> Robot {
        let doc = if name == "preset" { PRESET_DOC } else { DEVICE_DOC };
        let labels = Labels::new(labels, |labels| labels.iter().map(String::as_str).collect());
        let table = Table::new((self.wings.clone(), labels), |(wings, labels)| {
            let kind = Kind::Choice(labels.borrow_dependent());
            let own = Parameter { default: 0.0, group: "design", ..Parameter::new(name, "", "", kind, doc) };
            wings.parameters().iter().copied().chain([own]).collect()
        });
        Robot { designs: Some(Arc::new(table)), ..self }
    }
}

const DEVICE_DOC: &str = "Device of the design: the name of its file, without folder and ending.";
const PRESET_DOC: &str = "Preset of the design.";

/// Dereferences to the model or vehicle. In contrast to [`Robot::parameters`], the parameters of the model or
/// vehicle do not include the parameter that names the design.
impl Deref for Robot {
    type Target = dyn Simulator;

    fn deref(&self) -> &Self::Target {
        &*self.wings
    }
}

impl Deref for Wings {
    type Target = dyn Simulator;

    fn deref(&self) -> &Self::Target {
        match self {
            Wings::One(model) => *model,
            Wings::Vehicle(vehicle) => &**vehicle,
        }
    }
}

type Options<'a> = Vec<&'a str>;

self_cell!(
    /// Labels of designs, which are also the options of the choice that names the design.
    struct Labels {
        owner: Vec<String>,
        #[covariant]
        dependent: Options,
    }
);

type Parameters<'a> = Vec<Parameter<'a>>;

self_cell!(
    /// All parameters of a robot with several designs. The parameters borrow data from the wings and
    /// the labels of the designs, so this struct also owns the wings and the labels.
    struct Table {
        owner: (Wings, Labels),
        #[covariant]
        dependent: Parameters,
    }
);

/// Values of the parameters in which the designs of a plan differ.
#[derive(Clone, Debug, Default)]
pub(crate) struct Differences {
    /// Index of the parameter that names the design.
    pub(crate) design: usize,
    /// Indices of parameters, each with its value in each design. If a design does not set the parameter, the
    /// value is NaN.
    pub(crate) values: Vec<(usize, Vec<f64>)>,
}

impl Differences {
    /// Returns the value of a parameter in each design, if the values differ between the designs.
    pub(crate) fn of(&self, parameter: usize) -> Option<&[f64]> {
        self.values.iter().find(|(differing, _)| *differing == parameter).map(|(_, values)| values.as_slice())
    }

    /// Writes the values of a design into `values`, which already contains the index of the design.
    /// Parameters for which `is_varied` returns true keep their values.
    pub(super) fn fill(&self, values: &mut [f64], is_varied: impl Fn(usize) -> bool) {
        let Some(design) = values.get(self.design).copied() else { return };
        for (parameter, of_designs) in self.values.iter().filter(|(parameter, _)| !is_varied(*parameter)) {
            values[*parameter] = of_choice(of_designs, design);
        }
    }

    /// Removes a parameter that now has the same value in all designs.
    pub(crate) fn remove(&mut self, parameter: usize) {
        self.values.retain(|(differing, _)| *differing != parameter);
    }
}
