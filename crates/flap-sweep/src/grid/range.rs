//! Reads ranges of values, such as `{ from = 60, to = 200, n = 15 }`. A range can have `step` in place of
//! `n`, and can be linear or logarithmic.

use flap_core::parameter::Parameter;
use toml::de::DeValue;

use super::diagnostic::Problems;
use super::table::{self, Entry};
use super::value;
use crate::plan::axes::{Axes, Values};

pub(super) const KEYS: [&str; 5] = ["from", "to", "n", "step", "scale"];
pub(super) const SCALES: [&str; 2] = ["linear", "log"];

/// If the distance from a value of the range to `to` is at most this fraction of a step, `to` is the last
/// value. The tolerance is necessary because numbers such as 0.1 are not exact in binary.
const HIT: f64 = 1e-9;

/// The first and the last value of a range, with their entries in the file for messages.
struct Ends<'e, 't> {
    from: f64,
    to: f64,
    from_entry: &'e Entry<'t>,
    to_entry: &'e Entry<'t>,
}

/// The number of values or the step of a range, with its entry in the file for messages.
enum Spacing<'e, 't> {
    /// Number of values in the range.
    Count(&'e Entry<'t>, u64),
    /// Distance between neighbouring values.
    Step(&'e Entry<'t>, f64),
}

/// Returns the values of a range. If the range has mistakes, reports the mistakes and returns `None`.
pub(super) fn read(parameter: &Parameter, axis: &Entry<'_>, problems: &mut Problems) -> Option<Values> {
    let DeValue::Table(table) = axis.value.get_ref() else {
        return None;
    };
    if value::report_choice(parameter, axis, "ranges", "list the options to try", problems) {
        return None;
    }
    let entries = table::entries(table);
    // If a key is misspelt, the report of a missing key would be misleading.
    let has_known_keys = table::check_keys(&entries, &KEYS, "in a range", problems);
    let from = end(parameter, "from", &entries, problems);
    let to = end(parameter, "to", &entries, problems);
    let scale = match table::find(&entries, "scale") {
        Some(entry) => value::option("scale", &SCALES, entry.value, problems),
        None => Some(0),
    };
    let spacing = spacing(parameter, &entries, problems);
    let missing = missing_keys(&entries);
    if has_known_keys && !missing.is_empty() {
        problems
            .report(axis.value.span(), format!("the range of `{}` has no {missing}", parameter.name))
            .note("ranges look like { from = 1, to = 5, n = 9 } or { from = 1, to = 5, step = 0.5 }");
    }

    let is_log = scale? == 1;
    let spacing = spacing?;
    if let (Spacing::Step(step, _), true) = (&spacing, is_log) {
        problems
            .report(step.key_span.clone(), "a logarithmic range takes `n`, not `step`")
            .help("its values keep a constant ratio, not a constant step: give their number `n`");
        return None;
    }
    let (from, from_entry) = from?;
    let (to, to_entry) = to?;
    let ends = Ends { from, to, from_entry, to_entry };
    match spacing {
        Spacing::Count(entry, count) => counted(&ends, entry, count, is_log, problems),
        Spacing::Step(entry, step) => stepped(&ends, entry, step, problems),
    }
}

/// Returns the value of the key `from` or `to` of a range, with its entry in the file.
fn end<'e, 't>(
    parameter: &Parameter,
    key: &str,
    entries: &'e [Entry<'t>],
    problems: &mut Problems,
) -> Option<(f64, &'e Entry<'t>)> {
    let entry = table::find(entries, key)?;
    let value = value::of_parameter(parameter, entry.value, problems)?;
    Some((value, entry))
}

/// Returns the value of the key `n` or `step` of a range, with its entry in the file.
fn spacing<'e, 't>(
    parameter: &Parameter,
    entries: &'e [Entry<'t>],
    problems: &mut Problems,
) -> Option<Spacing<'e, 't>> {
    let n = table::find(entries, "n");
    let step = table::find(entries, "step");
    if let (Some(n), Some(step)) = (n, step) {
        problems
            .report(step.key_span.clone(), "a range takes `n` or `step`, not both")
            .related(n.key_span.clone(), "`n` is here")
            .help("remove one of them");
        return None;
    }
    if let Some(entry) = n {
        let count = value::count("n", Axes::MAX_POINTS, entry.value, problems)?;
        return Some(Spacing::Count(entry, count));
    }
    let entry = step?;
    let size = value::quantity("step", parameter.unit, entry.value, problems)?;
    Some(Spacing::Step(entry, size))
}

/// Returns text for a message that lists the missing keys of a range. If no key is missing, the text is
/// empty.
fn missing_keys(entries: &[Entry<'_>]) -> String {
    let has = |key: &str| table::find(entries, key).is_some();
    let keys = [
        (has("from"), "`from`"),
        (has("to"), "`to`"),
        (has("n") || has("step"), "`n` (the number of values) or `step`"),
    ];
    let missing: Vec<&str> = keys.iter().filter(|(is_there, _)| !is_there).map(|(_, key)| *key).collect();
    missing.join(", ")
}

/// Returns a range of `count` values, including both ends of the range.
fn counted(
    ends: &Ends<'_, '_>,
    n: &Entry<'_>,
    count: u64,
    is_log: bool,
    problems: &mut Problems,
) -> Option<Values> {
    let Ends { from, to, .. } = *ends;
    if is_log && !check_log_ends(ends, problems) {
        return None;
    }
    if count == 1 && from != to {
        problems
            .report(n.value.span(), "a single value cannot be at both `from` and `to`")
            .related(ends.from_entry.value.span(), "starts here")
            .related(ends.to_entry.value.span(), "ends here")
            .help("use `n = 2` or more, or make a list of the one value");
        return None;
    }
    if count > 1 && from == to {
        problems
            .report(
                n.value.span(),
                format!("`from` and `to` are equal: all {count} values would be the same"),
            )
            .help("use `n = 1`, or different ends");
        return None;
    }
    if is_log {
        return Some(Values::Log { from, to, count });
    }
    // Largest number in the computation of the values between the ends.
    if !((to - from) * count as f64).is_finite() {
        report_too_wide(ends, problems);
        return None;
    }
    Some(Values::Linear { from, to, count })
}

/// If the ends of a logarithmic range are zero, have different signs or are too far apart, reports a mistake.
/// Returns true if both ends of the range are allowed.
fn check_log_ends(ends: &Ends<'_, '_>, problems: &mut Problems) -> bool {
    for (value, entry) in [(ends.from, ends.from_entry), (ends.to, ends.to_entry)] {
        if value == 0.0 {
            problems
                .report(
                    entry.value.span(),
                    format!("a logarithmic range cannot include zero, but `{}` is zero", entry.key),
                )
                .help("use a small number of the right sign, or scale = \"linear\"");
            return false;
        }
    }
    if ends.from.signum() != ends.to.signum() {
        problems
            .report(
                ends.to_entry.value.span(),
                "a logarithmic range cannot pass through zero: both ends need the same sign",
            )
            .related(ends.from_entry.value.span(), "of the other sign")
            .help("use ends of the same sign, or scale = \"linear\"");
        return false;
    }
    let ratio = ends.to / ends.from;
    let is_normal = ratio.is_normal();
    if !is_normal {
        report_too_wide(ends, problems);
    }
    is_normal
}

fn report_too_wide(ends: &Ends<'_, '_>, problems: &mut Problems) {
    problems
        .report(ends.to_entry.value.span(), "the range is too wide for 64-bit floats")
        .related(ends.from_entry.value.span(), "from here");
}

/// Returns the values of a range whose neighbouring values have the distance `step`.
fn stepped(ends: &Ends<'_, '_>, entry: &Entry<'_>, step: f64, problems: &mut Problems) -> Option<Values> {
    let Ends { from, to, .. } = *ends;
    if step == 0.0 {
        problems
            .report(entry.value.span(), "`step` is zero")
            .help("use a step that leads from `from` to `to`");
        return None;
    }
    let steps = (to - from) / step;
    if steps < 0.0 {
        let (direction, sign) = if to > from { ("up", "positive") } else { ("down", "negative") };
        problems
            .report(entry.value.span(), "`step` leads away from `to`")
            .related(ends.from_entry.value.span(), "starts here")
            .related(ends.to_entry.value.span(), "ends here")
            .help(format!("the range goes {direction}: make the step {sign}"));
        return None;
    }
    if !(to - from).is_finite() {
        report_too_wide(ends, problems);
        return None;
    }
    let whole = (steps + HIT).floor();
    if whole >= Axes::MAX_POINTS as f64 {
        problems.report(entry.value.span(), "the range has more than 2^63 values").help("use a larger step");
        return None;
    }
    // A whole number that is not negative and less than 2^63.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked just above")]
    let count = whole as u64 + 1;
    let hits_end = (steps - whole).abs() <= HIT;
    if count == 1 {
        return Some(Values::List(vec![from]));
    }
    // Evenly spaced between exact ends, so that the last value is `to` as written.
    if hits_end && ((to - from) * count as f64).is_finite() {
        return Some(Values::Linear { from, to, count });
    }
    Some(Values::Step { from, step, count })
}
