//! Prints the meaning of parameters, columns, settings and statuses.

mod composed;
mod entry;
mod known;
mod tables;

use std::fmt::Write as _;

use entry::Entry;
use flap_core::simulate::Simulator;

use super::parameters::of_name;
use crate::args::ModelsArgs;
use crate::failure::Failure;
use crate::models;
use crate::print;
use crate::table::wrapped;

/// Columns of the output in csv and json.
const NAMES: [&str; 4] = ["name", "kind", "models", "text"];

/// Prints the meanings of the given names, for all models or only for the model of `--model`.
pub(super) fn explain(names: &[&str], args: &ModelsArgs) -> Result<(), Failure> {
    let models = match &args.model {
        None => models::all().to_vec(),
        Some(name) => vec![of_name(name)?.0],
    };
    let known = known::entries(&models);
    let (mut found, mut failures) = (Vec::new(), Vec::new());
    for name in names {
        match meanings(name, &known, &models) {
            Ok(entries) => found.push(entries),
            Err(failure) => failures.push(failure),
        }
    }
    // If one name is unknown, the meanings of the others are still printed.
    let rows: Vec<Vec<String>> = found.iter().flatten().map(Entry::row).collect();
    if !rows.is_empty() {
        print::table(args.format, &NAMES, &rows, || {
            found.iter().map(|entries| page(entries)).collect::<Vec<_>>().join("\n")
        })?;
    }
    let last = failures.pop();
    for failure in failures {
        failure.report();
    }
    last.map_or(Ok(()), Err)
}

/// Returns the meanings of a name. For example, a name can be a parameter of some models and a column of
/// other models.
fn meanings(name: &str, known: &[Entry], models: &[&'static dyn Simulator]) -> Result<Vec<Entry>, Failure> {
    let mut found: Vec<Entry> = known.iter().filter(|entry| entry.name == name).cloned().collect();
    if found.is_empty() {
        found = composed::entries(name, models);
    }
    if !found.is_empty() {
        return Ok(found);
    }
    if models.len() < models::all().len()
        && meanings(name, &known::entries(models::all()), models::all()).is_ok()
    {
        let failure = Failure::usage(format!("the model {} has no `{name}`", models[0].name()));
        return Err(failure.help(format!("other models have this name: `flap models {name}`")));
    }
    let failure =
        Failure::usage(format!("there is no model, preset, parameter, column, setting or status `{name}`"));
    let mut names: Vec<&str> =
        models::all().iter().map(|model| model.name()).chain(models::presets()).collect();
    names.extend(known.iter().map(|entry| entry.name.as_str()));
    Err(failure.nearest(name, names, "`flap models MODEL` lists the parameters and columns of a model"))
}

/// Returns the meanings of a name as text.
fn page(entries: &[Entry]) -> String {
    let mut page = String::new();
    for entry in entries {
        let _ = writeln!(page, "{}: {}", entry.name, entry.kind());
        for line in entry.text.lines() {
            let _ = writeln!(page, "{}", wrapped(line, line.len() - line.trim_start().len()));
        }
    }
    page
}
