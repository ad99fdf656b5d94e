//! The section `[solver]`: how exactly points are integrated, and for how long.

use flap_core::simulate::SolverSettings;

use super::problems::Problems;
use super::table::{self, Entry};
use super::value;

const KEYS: [&str; 7] = ["rtol", "atol", "settle_tol", "max_cycles", "max_steps", "accuracy", "newton"];

/// Looser than this, an error estimate means nothing.
pub(crate) const LARGEST_RTOL: f64 = 0.1;

/// The settings, with defaults for what is not set.
pub(super) fn read(entry: Option<&Entry<'_>>, problems: &mut Problems) -> SolverSettings {
    let mut settings = SolverSettings::default();
    let Some(entry) = entry else {
        return settings;
    };
    let entries = table::section(entry, problems);
    table::check_keys(&entries, &KEYS, "in [solver]", problems);
    if let Some(rtol) = tolerance(&entries, "rtol", LARGEST_RTOL, problems) {
        settings = settings.with_rtol(rtol);
    }
    if let Some(atol) = tolerance(&entries, "atol", f64::INFINITY, problems) {
        settings.atol = atol;
    }
    if let Some(settle_tol) = tolerance(&entries, "settle_tol", f64::INFINITY, problems) {
        settings.settle_tol = settle_tol;
    }
    if let Some(max_cycles) = whole(&entries, "max_cycles", problems) {
        settings.max_cycles = max_cycles;
    }
    if let Some(max_steps) = whole(&entries, "max_steps", problems) {
        settings.max_steps = max_steps;
    }
    if let Some(accuracy) = tolerance(&entries, "accuracy", f64::INFINITY, problems) {
        settings.accuracy = accuracy;
    }
    if let Some(entry) = table::find(&entries, "newton") {
        settings.newton = value::boolean("newton", entry.value, problems).unwrap_or(settings.newton);
    }
    settings
}

/// A number more than zero and less than `limit`.
fn tolerance(entries: &[Entry<'_>], key: &str, limit: f64, problems: &mut Problems) -> Option<f64> {
    let value = table::find(entries, key)?.value;
    let number = value::number(key, value, problems)?;
    if number > 0.0 && number < limit {
        return Some(number);
    }
    let allowed = if limit.is_finite() {
        format!("more than zero and less than {limit}")
    } else {
        "more than zero".into()
    };
    problems.report(value.span(), format!("`{key}` must be {allowed}, not {}", value::shown(number)));
    None
}

fn whole(entries: &[Entry<'_>], key: &str, problems: &mut Problems) -> Option<u32> {
    let entry = table::find(entries, key)?;
    let count = value::count(key, u64::from(u32::MAX), entry.value, problems)?;
    u32::try_from(count).ok()
}
