//! The section `[derived]`: parameters that are computed from others.

use std::ops::Range;

use flap_core::parameter::Kind as ParameterKind;

use super::axes::Placed;
use super::formula::{self, Names};
use super::lookup::Lookup;
use super::problems::Problems;
use super::table::{self, Entry};
use crate::notation::expression::{Expression, Kind};
use crate::plan::formula::Derived;

/// A parameter that is set, and where.
pub(super) type Place = (usize, Range<usize>);

/// An entry of the section that is about a parameter.
pub(super) struct Draft<'t> {
    pub(super) parameter: usize,
    entry: Entry<'t>,
}

/// The parameters that the section names, with their entries.
pub(super) fn drafts<'t>(entry: Option<&Entry<'t>>, lookup: &mut Lookup<'_>) -> Vec<Draft<'t>> {
    let mut drafts = Vec::new();
    for entry in entry.map(|entry| table::section(entry, lookup.problems)).unwrap_or_default() {
        let Some((index, parameter)) = lookup.parameter(&entry) else {
            continue;
        };
        if let ParameterKind::Choice(_) = parameter.kind {
            lookup
                .problems
                .report(entry.key_span, format!("`{}` is a choice and cannot be derived", parameter.name))
                .help("expressions are numbers: set it under [params], or vary it under [axes]");
            continue;
        }
        drafts.push(Draft { parameter: index, entry });
    }
    drafts
}

/// Reports derived parameters that are varied as well, or `set` in the way that goes before each list.
pub(super) fn report_repeats(
    drafts: &[Draft<'_>],
    axes: &[Placed],
    set: &[(&str, &[Place])],
    problems: &mut Problems,
) {
    for Draft { parameter, entry } in drafts {
        let varied = axes.iter().flat_map(|placed| placed.axis.parameters().iter().zip(&placed.keys));
        let varied = varied.filter(|((other, _), _)| other == parameter).map(|(_, key)| (key, "varied"));
        let fixed = set.iter().flat_map(|(how, set)| set.iter().map(move |(other, key)| (other, key, *how)));
        let fixed = fixed.filter(|(other, ..)| *other == parameter).map(|(_, key, how)| (key, how));
        for (key, how) in varied.chain(fixed) {
            problems
                .report(entry.key_span.clone(), format!("`{}` is derived and {how}", entry.key))
                .label("derived here")
                .related(key.clone(), format!("{how} here"))
                .help("keep one of them");
        }
    }
}

/// The expressions of the section, in an order in which they can be computed.
pub(super) fn read(drafts: &[Draft<'_>], names: &Names<'_>, problems: &mut Problems) -> Derived {
    let mut formulas: Vec<(usize, Expression)> = Vec::new();
    let mut entries: Vec<&Entry<'_>> = Vec::new();
    for Draft { parameter, entry } in drafts {
        if let Some(expression) = formula::read(entry, names, Kind::Number, problems) {
            formulas.push((*parameter, expression));
            entries.push(entry);
        }
    }
    let needs: Vec<Vec<usize>> =
        formulas.iter().map(|(_, expression)| needs(expression, &formulas)).collect();
    let order = order(&needs);
    if order.len() < formulas.len() {
        report_cycles(&needs, &order, &entries, problems);
    }
    Derived::new(formulas, order)
}

/// Places of the formulas that `expression` reads.
fn needs(expression: &Expression, formulas: &[(usize, Expression)]) -> Vec<usize> {
    expression
        .reads()
        .filter_map(|parameter| formulas.iter().position(|(derived, _)| *derived == parameter))
        .collect()
}

/// Every formula behind those that it needs. Those in cycles, and those that need them, are left out.
fn order(needs: &[Vec<usize>]) -> Vec<usize> {
    let mut order: Vec<usize> = Vec::new();
    let mut waiting: Vec<usize> = (0..needs.len()).collect();
    loop {
        let ready = |place: &usize| needs[*place].iter().all(|needed| order.contains(needed));
        let (now, later): (Vec<usize>, Vec<usize>) = waiting.iter().partition(|place| ready(place));
        if now.is_empty() {
            return order;
        }
        order.extend(now);
        waiting = later;
    }
}

/// Reports formulas that need themselves, each cycle once. `order` has the formulas that do not.
fn report_cycles(needs: &[Vec<usize>], order: &[usize], entries: &[&Entry<'_>], problems: &mut Problems) {
    let mut visited: Vec<usize> = order.to_vec();
    for start in 0..needs.len() {
        // From formula to formula, until there is one that was met before: on this way, or on an earlier one.
        let mut way: Vec<usize> = Vec::new();
        let mut next = Some(start);
        while let Some(place) = next.filter(|place| !visited.contains(place)) {
            visited.push(place);
            way.push(place);
            next = needs[place].iter().copied().find(|needed| !order.contains(needed));
        }
        let Some(begin) = way.iter().position(|place| Some(*place) == next) else {
            continue;
        };
        let cycle = &way[begin..];
        let closed = cycle.iter().chain(cycle.first()).map(|&place| entries[place].key);
        let path = closed.collect::<Vec<_>>().join(" from ");
        let first = entries[cycle[0]];
        let diagnostic = problems
            .report(first.key_span.clone(), format!("`{}` is derived from itself: {path}", first.key));
        for &place in &cycle[1..] {
            diagnostic.related(entries[place].key_span.clone(), "by way of this");
        }
        diagnostic.help("use `preset.` for the value in the preset, or set one of them under [params]");
    }
}
