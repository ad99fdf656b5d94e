//! Layout of a vehicle: its model and its wings.

use super::columns::Columns;
use super::geometry::Wrench;
use super::mount::{Mount, VehicleError, check};
use super::parameters::{self, MassProperties, Table};
use crate::parameter::Parameter;
use crate::simulate::{Gradients, Simulator};

/// Vehicle whose wings all have the same model.
pub struct Vehicle {
    pub(super) model: &'static dyn Simulator,
    pub(super) mounts: Vec<Mount>,
    pub(super) table: Table,
    pub(super) columns: Columns,
    /// Names of the states of all wings, wing by wing.
    pub(super) states: Vec<String>,
}

impl Vehicle {
    /// Returns the vehicle with the wings `mounts`, which all have the given model.
    ///
    /// # Errors
    /// [`VehicleError`] if the number of wings is zero or too large, a name is not allowed or not unique, or the model
    /// computes no loads.
    pub fn of(model: &'static dyn Simulator, mounts: &[Mount]) -> Result<Vehicle, VehicleError> {
        check(model, mounts)?;
        let of_wing = model.gradients().map(Gradients::states).unwrap_or_default();
        let names =
            |mount: &Mount| of_wing.iter().map(|state| format!("{}_{state}", mount.name)).collect::<Vec<_>>();
        Ok(Vehicle {
            model,
            mounts: mounts.to_vec(),
            table: Table::new(model.parameters(), mounts)?,
            columns: Columns::new(model.columns(), mounts),
            states: mounts.iter().flat_map(names).collect(),
        })
    }

    /// Returns the model of the wings.
    pub fn model(&self) -> &'static dyn Simulator {
        self.model
    }

    /// Returns the wings.
    pub fn mounts(&self) -> &[Mount] {
        &self.mounts
    }

    /// Returns the reference point of the torques and of the body motion (m).
    pub fn about(&self, values: &[f64]) -> [f64; 3] {
        self.table.about(values)
    }

    /// Returns the mass properties of the whole vehicle.
    pub fn mass_properties(&self, values: &[f64]) -> MassProperties {
        self.table.mass_properties(values)
    }

    /// Returns the index, in the vehicle's table, of a parameter of one wing, such as `drive_voltage_pp` or
    /// `position_x`.
    pub fn own_parameter(&self, wing: usize, name: &str) -> Option<usize> {
        let name = format!("{}_{name}", self.mounts.get(wing)?.name);
        self.table.parameters().iter().position(|parameter| parameter.name == name)
    }

    /// Returns the measures of the vehicle, one for each column, from the measures and the loads of its wings.
    pub(super) fn measures(&self, values: &[f64], wings: &[&[f64]]) -> Vec<f64> {
        let loads = self.model.columns().len();
        let mut wrench = Wrench::ZERO;
        for (i, (mount, measures)) in self.mounts.iter().zip(wings).enumerate() {
            let load = core::array::from_fn(|j| measures[loads + j]);
            wrench = wrench + Wrench::of_wing(&load, &self.table.place(values, i), mount.mirrored);
        }
        let wrench = wrench.about(self.table.about(values));
        self.columns.values(&wrench, &self.table.mass_properties(values), wings)
    }

    /// Returns true if the wings may have different values of a parameter of the model. All numeric
    /// parameters except the drive frequency and the motion of the body may differ between wings.
    pub fn may_differ(parameter: &Parameter<'_>) -> bool {
        parameters::may_differ(parameter)
    }
}
