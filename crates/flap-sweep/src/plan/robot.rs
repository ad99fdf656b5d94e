//! The simulator of a plan's points.

use std::ops::Deref;
use std::sync::Arc;

use flap_core::simulate::Simulator;
use flap_core::vehicle::Vehicle;

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
