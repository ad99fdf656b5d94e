//! Names that flap finds in its tables: parameters, columns, settings and statuses.

use flap_core::simulate::{Simulator, SolverSettings, Status};
use flap_sweep::notation::text;
use flap_sweep::resonance::measures;
use flap_sweep::table::labels::split_unit;
use flap_sweep::table::layout::{fixed_columns, special_columns};

use super::composed;
use super::entry::{Entry, of_column, of_measure, of_parameter};
use super::tables::TABLES;
use crate::statuses;

/// Returns entries for all names of the given models, and for the names that all models have.
pub(super) fn entries(models: &[&'static dyn Simulator]) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for status in Status::ALL {
        let text = format!("  {}\n", statuses::meaning(status));
        entries.push(Entry::new(status.name(), "a status of rows", text));
    }
    for column in fixed_columns() {
        let kind = "a column of the rows of every model";
        entries.push(Entry::new(column.name, kind, of_column(&column.doc, "")));
    }
    for column in special_columns() {
        let kind = match column.name.as_str() {
            "branch" | "bistable" => "a column of response curves (`flap respond --out`)",
            _ => "a column of rows with derivatives ([gradient] in a grid file)",
        };
        entries.push(Entry::new(column.name, kind, of_column(&column.doc, "")));
    }
    entries.extend(settings());
    for &model in models {
        for entry in of_model(model) {
            entry.add(&mut entries);
        }
    }
    for &model in models {
        of_trajectory(model, &mut entries);
    }
    for (kind, columns) in TABLES {
        for (name, doc) in *columns {
            entries.push(Entry::new(*name, *kind, of_column(doc, split_unit(name).1)));
        }
    }
    for &model in models {
        composed::of_vehicles(model, &mut entries);
    }
    entries
}

/// Returns entries for the settings of the solver.
fn settings() -> impl Iterator<Item = Entry> {
    SolverSettings::TABLE.iter().map(|setting| {
        let value = text::setting(setting.kind, &SolverSettings::DEFAULT);
        let follows = setting.follows.map(|follows| format!(" ({follows})")).unwrap_or_default();
        let text = format!("  {}\n  default   {value}{follows}\n", setting.doc);
        Entry::new(setting.name, "a setting of [solver] in a grid file", text)
    })
}

/// Returns entries for the parameters and measures of a model.
fn of_model(model: &'static dyn Simulator) -> impl Iterator<Item = Entry> {
    let parameters = model.parameters().iter().enumerate().map(move |(index, parameter)| {
        Entry::of(model.name(), parameter.name, "a parameter", of_parameter(model, index, parameter))
    });
    let own = model.columns().len();
    let columns = measures(model).into_iter().enumerate().map(move |(place, column)| {
        let text = of_measure(&column);
        let entry = Entry::of(model.name(), column.name, "a measure", text);
        if place < own { entry } else { entry.with_rest(" with drive_frequency = \"resonance\"") }
    });
    parameters.chain(columns)
}

/// Adds entries for the columns of the motions that `flap run --trajectory` writes for a model.
fn of_trajectory(model: &'static dyn Simulator, entries: &mut Vec<Entry>) {
    let Ok(motions) = model.motions() else { return };
    for (name, doc) in motions.trajectory_columns().into_iter().zip(motions.meanings()) {
        let text = of_column(&doc, split_unit(&name).1);
        let entry = Entry::of(model.name(), name, "a column of motions", text);
        entry.with_rest(" (`flap run --trajectory`)").add(entries);
    }
}
