//! Reads the section `[solver]` of a grid file: tolerances and limits of the integration.

use flap_core::simulate::{SettingKind, SolverSettings};
use toml::Spanned;
use toml::de::DeValue;

use super::diagnostic::Problems;
use super::table::{self, Entry};
use super::value;

/// Returns the solver settings. Settings that the grid file does not contain have their default values.
pub(super) fn read(entry: Option<&Entry<'_>>, problems: &mut Problems) -> SolverSettings {
    let mut settings = SolverSettings::default();
    let Some(entry) = entry else {
        return settings;
    };
    let entries = table::section(entry, problems);
    let keys: Vec<&str> = SolverSettings::TABLE.iter().map(|setting| setting.name).collect();
    table::check_keys(&entries, &keys, "in [solver]", problems);
    for setting in SolverSettings::TABLE {
        let Some(Entry { key, value, .. }) = table::find(&entries, setting.name) else { continue };
        match setting.kind {
            SettingKind::Number { below, set, .. } => {
                if let Some(number) = tolerance(key, below, value, problems) {
                    set(&mut settings, number);
                }
            }
            SettingKind::Count { set, .. } => {
                let count = value::count(key, u64::from(u32::MAX), value, problems);
                if let Some(count) = count.and_then(|count| u32::try_from(count).ok()) {
                    set(&mut settings, count);
                }
            }
            SettingKind::Flag { set, .. } => {
                if let Some(flag) = value::boolean(key, value, problems) {
                    set(&mut settings, flag);
                }
            }
        }
    }
    settings
}

/// Returns the number in `value`, which must be more than zero and less than `limit`.
fn tolerance(key: &str, limit: f64, value: &Spanned<DeValue<'_>>, problems: &mut Problems) -> Option<f64> {
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
