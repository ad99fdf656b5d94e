//! Names that consist of several parts: columns of derivatives, and names that begin with the name of a wing.
//! This module also explains the names of a vehicle's parameters and columns.

use flap_core::parameter::Parameter;
use flap_core::simulate::{Rows, Simulator};
use flap_core::vehicle::{Mount, Vehicle};
use flap_sweep::derivative::{meaning, parts};

use super::entry::{Entry, of_measure, of_table};

/// Returns all meanings of a name that consists of several parts.
pub(super) fn entries(name: &str, models: &[&'static dyn Simulator]) -> Vec<Entry> {
    let mut entries = derivative(name, models);
    if entries.is_empty() {
        for wing in wings(name) {
            for &model in models {
                of_wing(model, wing, name, &mut entries);
            }
        }
    }
    entries
}

/// If `name` is a column of derivatives, returns the meanings of this column in the models.
fn derivative(name: &str, models: &[&'static dyn Simulator]) -> Vec<Entry> {
    let mut entries = Vec::new();
    let Some((of, by, per)) = parts(name) else { return entries };
    for model in models {
        let parameter = model.parameters().iter().find(|parameter| parameter.name == by);
        let column = model.columns().iter().find(|column| column.name == of);
        if let (Some(parameter), Some(column)) = (parameter, column) {
            let text = format!(
                "  {}\n  {of}: {}\n  {by}: {}\n",
                meaning(of, column.unit, by, per),
                column.doc,
                parameter.doc
            );
            let entry = Entry::of(model.name(), name, "a derivative", text);
            entry.with_rest(" ([gradient] in a grid file)").add(&mut entries);
        }
    }
    entries
}

/// Returns the prefixes of `name` that may be the name of a wing.
fn wings(name: &str) -> impl Iterator<Item = &str> {
    name.match_indices('_').map(|(end, _)| &name[..end])
}

/// Returns a vehicle with two wings of the model. The first wing has the name `left`, and the second wing is
/// the mirror image of the first wing.
fn vehicle(model: &'static dyn Simulator, left: &str) -> Option<Vehicle> {
    let mount = |name: &str, mirrored| Mount { name: name.to_owned(), mirrored };
    let right = if left == "right" { "other" } else { "right" };
    Vehicle::of(model, &[mount(left, false), mount(right, true)]).ok()
}

/// Adds entries for the parameters and columns of vehicles of the model, except names that begin with the
/// name of a wing.
pub(super) fn of_vehicles(model: &'static dyn Simulator, entries: &mut Vec<Entry>) {
    let Some(vehicle) = vehicle(model, "left") else { return };
    let is_own = |name: &str| !["left_", "right_"].iter().any(|wing| name.starts_with(wing));
    for parameter in vehicle.parameters().iter().filter(|parameter| is_own(parameter.name)) {
        if Parameter::index(model.parameters(), parameter.name).is_none() {
            let text = of_table(parameter);
            Entry::of(model.name(), parameter.name, "a parameter of vehicles", text).add(entries);
        }
    }
    for column in vehicle.columns().iter().filter(|column| is_own(&column.name)) {
        if model.columns().iter().all(|other| other.name != column.name) {
            let text = of_measure(column);
            Entry::of(model.name(), &column.name, "a measure of vehicles", text).add(entries);
        }
    }
}

/// If a vehicle with a wing called `wing` has a parameter or a column called `name`, adds its entry to
/// `entries`.
fn of_wing(model: &'static dyn Simulator, wing: &str, name: &str, entries: &mut Vec<Entry>) {
    let Some(vehicle) = vehicle(model, wing) else { return };
    let rest = format!(" with a wing called {wing}");
    if let Some(parameter) = vehicle.parameters().iter().find(|parameter| parameter.name == name) {
        let entry = Entry::of(model.name(), name, "a parameter of vehicles", of_table(parameter));
        entry.with_rest(rest.clone()).add(entries);
    }
    if let Some(column) = vehicle.columns().iter().find(|column| column.name == name) {
        let entry = Entry::of(model.name(), name, "a measure of vehicles", of_measure(column));
        entry.with_rest(rest).add(entries);
    }
}
