//! Converts TOML tables to lists of entries in the order of the file.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostic::{Diagnostic, Problems};

/// Keys at the top of a grid file.
pub(super) const KEYS: [&str; 17] = [
    "description",
    "preset",
    "device",
    "params",
    "correlation",
    "vehicle",
    "resonance",
    "axes",
    "zip",
    "sample",
    "refine",
    "derived",
    "where",
    "measure",
    "gradient",
    "solver",
    "output",
];

/// An entry `key = value` of a table.
pub(super) struct Entry<'t> {
    pub(super) key: &'t str,
    pub(super) key_span: Range<usize>,
    pub(super) value: &'t Spanned<DeValue<'t>>,
}

/// Returns the entries of `table` in the order of the file. The TOML parser returns the entries in
/// alphabetical order of the keys.
pub(super) fn entries<'t>(table: &'t DeTable<'t>) -> Vec<Entry<'t>> {
    let mut entries: Vec<Entry<'t>> =
        table.iter().map(|(key, value)| Entry { key: key.get_ref(), key_span: key.span(), value }).collect();
    entries.sort_by_key(|entry| entry.key_span.start);
    entries
}

/// Returns the entry with the given key.
pub(super) fn find<'e, 't>(entries: &'e [Entry<'t>], key: &str) -> Option<&'e Entry<'t>> {
    entries.iter().find(|entry| entry.key == key)
}

/// Returns words for the type of a TOML value, for use in messages, such as "a number".
pub(super) fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "a boolean",
        DeValue::Datetime(_) => "a date or time",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

/// Returns the entries of a section, such as `[solver]`. If the section is not a table, reports a mistake.
pub(super) fn section<'t>(entry: &Entry<'t>, problems: &mut Problems) -> Vec<Entry<'t>> {
    if let DeValue::Table(table) = entry.value.get_ref() {
        return entries(table);
    }
    let key = entry.key;
    let message = format!("`{key}` must be a table, not {}", kind(entry.value.get_ref()));
    problems.report(entry.value.span(), message).help(format!("write [{key}] on a line of its own, once"));
    Vec::new()
}

/// Reports that the key of `entry` is unknown, with the `allowed` keys.
pub(super) fn report_unknown_key<'p>(
    entry: &Entry<'_>,
    allowed: &[&str],
    place: &str,
    problems: &'p mut Problems,
) -> &'p mut Diagnostic {
    problems
        .report(entry.key_span.clone(), format!("unknown key `{}` {place}", entry.key))
        .label("unknown key")
        .note(format!("keys {place}: {}", allowed.join(", ")))
        .did_you_mean(entry.key, allowed.iter().copied())
}

/// Reports every key that is not in the list `allowed`. Returns true if all keys are allowed.
pub(super) fn check_keys(
    entries: &[Entry<'_>],
    allowed: &[&str],
    place: &str,
    problems: &mut Problems,
) -> bool {
    let mut known = true;
    for entry in entries.iter().filter(|entry| !allowed.contains(&entry.key)) {
        report_unknown_key(entry, allowed, place, problems);
        known = false;
    }
    known
}
