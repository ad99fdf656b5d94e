//! The layout of a vehicle: its model and its wings.

use std::sync::{Mutex, PoisonError};

use super::columns::Columns;
use super::geometry::Wrench;
use super::mount::{Mount, VehicleError, check, kept};
use super::parameters::{self, Table};
use crate::parameter::Parameter;
use crate::simulate::Simulator;

/// Several wings of one model.
pub struct Vehicle {
    pub(super) model: &'static dyn Simulator,
    pub(super) mounts: Vec<Mount>,
    pub(super) table: Table,
    pub(super) columns: Columns,
    /// Names of the states of all wings, one wing after the other.
    pub(super) states: &'static [&'static str],
}

/// The vehicles made so far. Their number is that of layouts, which are few: they are kept for good.
static MADE: Mutex<Vec<&'static Vehicle>> = Mutex::new(Vec::new());

impl Vehicle {
    /// The vehicle with these wings of a model. It is kept for the life of the process, and the next one of the same layout
    /// is the same.
    ///
    /// # Errors
    /// If there are no wings or too many, a name is not allowed or taken, or the model does not know the loads of its wing.
    pub fn of(model: &'static dyn Simulator, mounts: &[Mount]) -> Result<&'static Vehicle, VehicleError> {
        let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
        let known = made.iter().find(|vehicle| {
            vehicle.model.name() == model.name()
                && std::ptr::addr_eq(vehicle.model, model)
                && vehicle.mounts == mounts
        });
        if let Some(vehicle) = known {
            return Ok(vehicle);
        }
        check(model, mounts)?;
        let table = Table::new(model.parameters(), mounts)?;
        let columns = Columns::new(model.columns(), mounts);
        let states = states(model, mounts);
        let vehicle: &'static Vehicle =
            Box::leak(Box::new(Vehicle { model, mounts: mounts.to_vec(), table, columns, states }));
        made.push(vehicle);
        Ok(vehicle)
    }

    /// The model of the wings.
    pub fn model(&self) -> &'static dyn Simulator {
        self.model
    }

    /// The wings.
    pub fn mounts(&self) -> &[Mount] {
        &self.mounts
    }

    /// The index, in the vehicle's table, of a wing's own parameter, such as `drive_voltage_pp` or `position_x`.
    pub fn own_parameter(&self, wing: usize, name: &str) -> Option<usize> {
        let name = format!("{}_{name}", self.mounts.get(wing)?.name);
        self.table.parameters.iter().position(|parameter| parameter.name == name)
    }

    /// The measures of the vehicle, one per column, from those of its wings with their loads.
    pub(super) fn measures(&self, values: &[f64], wings: &[&[f64]]) -> Vec<f64> {
        let loads = self.model.columns().len();
        let mut wrench = Wrench::ZERO;
        for (i, (mount, measures)) in self.mounts.iter().zip(wings).enumerate() {
            let load = core::array::from_fn(|j| measures[loads + j]);
            wrench = wrench + Wrench::of_wing(&load, &self.table.place(values, i), mount.mirrored);
        }
        let wrench = wrench.about(self.table.about(values));
        self.columns.values(&wrench, self.table.total_mass(values), wings)
    }

    /// True if wings may have a value of their own of this parameter of the model: all numbers but the drive frequency.
    pub fn may_differ(parameter: &Parameter) -> bool {
        parameters::may_differ(parameter)
    }
}

/// Names of the states of all wings.
fn states(model: &'static dyn Simulator, mounts: &[Mount]) -> &'static [&'static str] {
    let of_wing = model.motions().map_or(&[][..], |motions| motions.states());
    let names =
        mounts.iter().flat_map(|mount| of_wing.iter().map(|state| kept(format!("{}_{state}", mount.name))));
    Box::leak(names.collect())
}
