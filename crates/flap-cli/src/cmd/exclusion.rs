//! Points that conditions exclude, in words.

/// How many points are excluded, and how many do not satisfy each condition.
pub(crate) fn text(excluded: u64, unsatisfied: &[(String, u64)]) -> String {
    let points = if excluded == 1 { "1 point is".to_owned() } else { format!("{excluded} points are") };
    let each: Vec<String> = unsatisfied.iter().map(|(name, count)| format!("{name} {count}")).collect();
    format!("{points} excluded by [where]; not satisfied: {}", each.join(", "))
}
