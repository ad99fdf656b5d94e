//! Reads the section `[output]` of a grid file: the path of the results file, and the columns of this file.

use std::ops::Range;
use std::path::PathBuf;

use flap_core::parameter::Parameter;

use super::diagnostic::Problems;
use super::table::{self, Entry};
use super::value;
use crate::plan::{Output, Robot};
use crate::table::format::Format;
use crate::table::layout::{POINT, RUN, STATUS};

pub(super) const KEYS: [&str; 2] = ["path", "columns"];

/// A robot, and the names of its measures, including the user's measures.
type Measured<'m> = (&'m Robot, &'m [String]);

/// Reads the section `[output]`. Column names are checked only if the model is known.
pub(super) fn read(
    entry: Option<&Entry<'_>>,
    model: Option<Measured<'_>>,
    problems: &mut Problems,
) -> Output {
    let Some(entry) = entry else {
        return Output::default();
    };
    let entries = table::section(entry, problems);
    table::check_keys(&entries, &KEYS, "in [output]", problems);
    let path = table::find(&entries, "path").and_then(|entry| path_of(entry, problems));
    let columns = table::find(&entries, "columns").zip(model);
    Output { path, columns: columns.map(|(entry, model)| columns_of(model, entry, problems)) }
}

/// Returns the path of the results file, or `-` for stdout.
fn path_of(entry: &Entry<'_>, problems: &mut Problems) -> Option<PathBuf> {
    let path = PathBuf::from(value::text("path", entry.value, problems)?);
    if path.as_os_str() != "-"
        && let Err(error) = Format::of(&path)
    {
        problems.report(entry.value.span(), error.to_string());
    }
    Some(path)
}

/// Returns the indices of the columns that the list in `entry` names.
fn columns_of(model: Measured<'_>, entry: &Entry<'_>, problems: &mut Problems) -> Vec<usize> {
    let help = "remove `columns` to write all columns of the model";
    let mut chosen = Vec::new();
    for (name, span) in value::names(entry, "a list of column names", help, problems) {
        match names(model.1).position(|known| known == name) {
            Some(index) => chosen.push(index),
            None => report_unknown(model, name, span, problems),
        }
    }
    chosen
}

/// Returns the names of the columns that can be chosen: measures, then columns about the run, such as
/// `cycles`.
fn names(measures: &[String]) -> impl Iterator<Item = &str> {
    measures.iter().map(String::as_str).chain(RUN.iter().map(|column| column.name))
}

fn report_unknown((robot, columns): Measured<'_>, name: &str, span: Range<usize>, problems: &mut Problems) {
    if [POINT.name, STATUS.name].contains(&name) {
        problems
            .report(span, format!("`{name}` cannot be chosen: every row has it"))
            .help(format!("remove `{name}`"));
        return;
    }
    if Parameter::index(robot.parameters(), name).is_some() {
        problems
            .report(span, format!("`{name}` is a parameter, not a measure"))
            .note("rows contain all varied and derived parameters")
            .help(format!("remove `{name}`"));
        return;
    }
    problems
        .report(span, format!("model `{}` has no column `{name}`", robot.name()))
        .label("unknown column")
        .note(format!("columns: {}", names(columns).collect::<Vec<_>>().join(", ")))
        .did_you_mean(name, names(columns));
}
