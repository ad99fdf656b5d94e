//! The section `[measure]`: columns that are computed from measures.

use super::formula::{self, Names};
use super::problems::Problems;
use super::table::{self, Entry};
use crate::notation::expression::{self, Problem};
use crate::plan::formula::OwnMeasure;
use crate::table::fixed::is_fixed;

/// Puts the measures of the section into `names`, one by one: each may use those above it.
///
/// Returns the names that measures may have, also those of measures whose expressions are wrong.
pub(super) fn read(entry: Option<&Entry<'_>>, names: &mut Names<'_>, problems: &mut Problems) -> Vec<String> {
    let entries = entry.map(|entry| table::section(entry, problems)).unwrap_or_default();
    for (place, entry) in entries.iter().enumerate() {
        if !name_is_sound(entry.key, names) {
            report_name(entry, problems);
            continue;
        }
        match formula::check(entry, names, problems) {
            Ok(Some(expression)) => names.own.push(OwnMeasure { name: entry.key.to_owned(), expression }),
            Ok(None) => {}
            Err(errors) => {
                for error in errors {
                    let unknown = match &error.problem {
                        Problem::UnknownName { name, .. } => {
                            entries.iter().position(|entry| entry.key == name)
                        }
                        _ => None,
                    };
                    // The mistakes in a measure above are reported there.
                    if unknown.is_some_and(|unknown| unknown < place) {
                        continue;
                    }
                    let diagnostic = formula::report(entry, &error, problems);
                    if unknown.is_some() {
                        diagnostic.help.clear();
                        diagnostic.help("a measure can use only measures above it");
                    }
                }
            }
        }
    }
    let sound = entries.iter().filter(|entry| name_is_sound(entry.key, names));
    sound.map(|entry| entry.key.to_owned()).collect()
}

/// True if a column may be called `name`, and be used in expressions.
fn name_is_sound(name: &str, names: &Names<'_>) -> bool {
    expression::is_free_name(name)
        && !is_fixed(name)
        && names.parameters.iter().all(|parameter| parameter.name != name)
        && names.columns.iter().all(|column| column.name != name)
}

fn report_name(entry: &Entry<'_>, problems: &mut Problems) {
    problems
        .report(entry.key_span.clone(), format!("a measure cannot be called `{}`", entry.key))
        .note("a name has letters, digits and _, and differs from names of parameters, columns and functions")
        .help("give it another name");
}
