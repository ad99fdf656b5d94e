//! The tables `[[zip]]`: parameters that move together along one axis.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::axes::{self, Placed};
use super::lookup::Lookup;
use super::table::{self, Entry};
use super::value;
use crate::plan::axis::Axis;

/// One axis per table.
pub(super) fn read(entry: Option<&Entry<'_>>, lookup: &mut Lookup<'_>) -> Vec<Placed> {
    let Some(entry) = entry else {
        return Vec::new();
    };
    let DeValue::Array(tables) = entry.value.get_ref() else {
        report_not_tables(entry.value, lookup);
        return Vec::new();
    };
    let mut axes = Vec::new();
    for table in tables {
        match table.get_ref() {
            DeValue::Table(parameters) => axes.extend(axis(parameters, table.span(), lookup)),
            _ => report_not_tables(table, lookup),
        }
    }
    axes
}

fn report_not_tables(value: &Spanned<DeValue<'_>>, lookup: &mut Lookup<'_>) {
    let message = match value.get_ref() {
        DeValue::Table(_) => "`zip` takes double brackets: there may be several".to_owned(),
        other => format!("`zip` must be a table of parameters, not {}", table::kind(other)),
    };
    lookup
        .problems
        .report(value.span(), message)
        .help("write [[zip]] above the parameters that move together");
}

fn axis(table: &DeTable<'_>, span: Range<usize>, lookup: &mut Lookup<'_>) -> Option<Placed> {
    let entries = table::entries(table);
    if entries.is_empty() {
        lookup
            .problems
            .report(span, "this zip has no parameters")
            .help("list the parameters that move together below it, or remove it");
        return None;
    }
    let mut parameters = Vec::new();
    let mut keys: Vec<Range<usize>> = Vec::new();
    let mut with_units = Vec::new();
    // The first list of values that could be read: the others must be as long.
    let mut first: Option<(&Entry<'_>, u64)> = None;
    for entry in &entries {
        let Some((index, parameter)) = lookup.parameter(entry) else {
            continue;
        };
        let values = axes::values(parameter, entry, lookup.problems);
        if let Some(values) = &values {
            let (model, length) = *first.get_or_insert((entry, values.len()));
            if values.len() != length {
                report_unequal(entry, values.len(), model, length, lookup);
            }
        }
        parameters.push((index, values.unwrap_or_else(axes::none)));
        keys.push(entry.key_span.clone());
        with_units.push(value::has_units(entry.value));
    }
    Some(Placed { axis: Axis::new(parameters), span, keys, with_units })
}

fn report_unequal(entry: &Entry<'_>, length: u64, first: &Entry<'_>, wanted: u64, lookup: &mut Lookup<'_>) {
    let message = format!(
        "`{}` has {length} values but `{}` has {wanted}: parameters that move together need as many each",
        entry.key, first.key
    );
    lookup
        .problems
        .report(entry.value.span(), message)
        .label(format!("values: {length}"))
        .related(first.value.span(), format!("values: {wanted}"))
        .help("make them equally long, or use [axes] for every combination");
}
