//! Former names of parameters in a grid file.

use flap_core::parameter::Parameter;
use toml::de::{DeTable, DeValue};

/// Returns the parameters that the grid calls by former names, in keys, lists and expressions.
pub(super) fn used(
    root: &DeTable<'_>,
    parameters: &'static [Parameter<'static>],
) -> Vec<&'static Parameter<'static>> {
    let mut words = Vec::new();
    collect(root, &mut words);
    let is_used = |parameter: &&Parameter<'_>| words.contains(&parameter.former);
    parameters.iter().filter(|parameter| !parameter.former.is_empty()).filter(is_used).collect()
}

/// Collects keys and the words of texts.
fn collect<'t>(table: &'t DeTable<'_>, words: &mut Vec<&'t str>) {
    for (key, value) in table {
        words.push(key.get_ref());
        collect_from(value.get_ref(), words);
    }
}

fn collect_from<'t>(value: &'t DeValue<'_>, words: &mut Vec<&'t str>) {
    match value {
        DeValue::Table(table) => collect(table, words),
        DeValue::Array(items) => items.iter().for_each(|item| collect_from(item.get_ref(), words)),
        DeValue::String(text) => {
            words.extend(text.split(|letter: char| !letter.is_alphanumeric() && letter != '_'));
        }
        _ => {}
    }
}
