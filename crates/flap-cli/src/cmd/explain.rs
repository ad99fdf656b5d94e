//! `flap explain`: the meaning of parameters, columns, settings and statuses.

mod composed;
mod entry;
mod known;
mod tables;

use std::fmt::Write as _;

use entry::Entry;
use flap_core::simulate::Simulator;

use super::params::{of_name, wrapped};
use crate::args::ExplainArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::models;

pub(crate) fn run(args: &ExplainArgs) -> Result<Exit, Failure> {
    let models = match &args.model {
        None => models::all().to_vec(),
        Some(name) => vec![of_name(name)?.0],
    };
    let (mut pages, mut failures) = (Vec::new(), Vec::new());
    for name in &args.names {
        match page(name, &models) {
            Ok(page) => pages.push(page),
            Err(failure) => failures.push(failure),
        }
    }
    // An unknown name does not hide what is known of the others.
    console::results(&pages.join("\n"))?;
    let last = failures.pop();
    for failure in failures {
        failure.report();
    }
    last.map_or(Ok(Exit::Done), Err)
}

/// All that is known of a name: it may be a parameter of several models, and a column of others.
fn page(name: &str, models: &[&'static dyn Simulator]) -> Result<String, Failure> {
    let entries = known::entries(models);
    let mut found: Vec<&Entry> = entries.iter().filter(|entry| entry.name == name).collect();
    let composed = if found.is_empty() { composed::entries(name, models) } else { Vec::new() };
    found.extend(&composed);
    let mut page = String::new();
    for entry in found {
        let _ = writeln!(page, "{name}: {}", entry.kind());
        for line in entry.text.lines() {
            let _ = writeln!(page, "{}", wrapped(line, line.len() - line.trim_start().len()));
        }
    }
    if !page.is_empty() {
        return Ok(page);
    }
    if models.len() < models::all().len() && self::page(name, models::all()).is_ok() {
        let failure = Failure::usage(format!("the model {} has no `{name}`", models[0].name()));
        return Err(failure.help(format!("other models have it: `flap explain {name}`")));
    }
    let failure = Failure::usage(format!("there is no parameter, column, setting or status `{name}`"));
    let current = entries.iter().filter(|entry| !entry.is_former).map(|entry| entry.name.as_str());
    Err(failure.nearest(name, current, "`flap params MODEL` lists parameters and columns"))
}
