//! Excluded points in words.

use flap_sweep::notation::text::count;

/// The number of excluded points, and for each condition the number of points that do not satisfy it.
pub(crate) fn text(excluded: u64, unsatisfied: &[(String, u64)]) -> String {
    let points = count(excluded, "point") + if excluded == 1 { " is" } else { " are" };
    let each: Vec<String> = unsatisfied
        .iter()
        .map(|(name, failed)| format!("condition `{name}` fails at {}", count(*failed, "point")))
        .collect();
    format!("{points} excluded by [where]: {}", each.join(", "))
}
