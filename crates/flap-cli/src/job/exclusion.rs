//! Text for messages about the number of excluded points.

use flap_sweep::notation::text::count;
use flap_sweep::run::Unsatisfied;

/// Returns a text with the number of excluded points, and for each condition the number of points that do not
/// satisfy the condition.
pub(crate) fn text(excluded: u64, unsatisfied: &[Unsatisfied]) -> String {
    let points = count(excluded, "point") + if excluded == 1 { " is" } else { " are" };
    let each: Vec<String> = unsatisfied
        .iter()
        .map(|Unsatisfied { condition, points }| {
            format!("condition `{condition}` fails at {}", count(*points, "point"))
        })
        .collect();
    format!("{points} excluded by [where]: {}", each.join(", "))
}
