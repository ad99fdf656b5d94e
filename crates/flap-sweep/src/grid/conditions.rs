//! The section `[where]`: conditions that points satisfy, or are not run.

use super::formula::{self, Names};
use super::problems::Problems;
use super::table::{self, Entry};
use crate::notation::expression::Kind;
use crate::plan::formula::Condition;

/// The conditions of the section, in the order of the file.
pub(super) fn read(entry: Option<&Entry<'_>>, names: &Names<'_>, problems: &mut Problems) -> Vec<Condition> {
    let mut conditions = Vec::new();
    for entry in entry.map(|entry| table::section(entry, problems)).unwrap_or_default() {
        if let Some(expression) = formula::read(&entry, names, Kind::Condition, problems) {
            conditions.push(Condition { name: entry.key.to_owned(), expression });
        }
    }
    conditions
}
