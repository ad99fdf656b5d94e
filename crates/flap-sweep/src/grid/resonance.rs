//! Reads `drive_frequency = "resonance"` and the section `[resonance]`, which set the drive frequency to the
//! resonance of each design.

use flap_core::simulate::Simulator;
use toml::Spanned;
use toml::de::DeValue;

use super::diagnostic::Problems;
use super::table::{self, Entry};
use super::value;
use crate::plan::Value;
use crate::resonance::{AT_RESONANCE, AtResonance, DRIVE_FREQUENCY, Objective, Range};

pub(super) const KEYS: [&str; 4] = ["of", "from", "to", "tolerance"];

/// Returns true if `entry` sets the drive frequency to the resonance.
pub(super) fn sets_resonance(entry: &Entry<'_>) -> bool {
    entry.key == DRIVE_FREQUENCY && entry.value.get_ref().as_str() == Some(AT_RESONANCE)
}

/// If the section `[params]` requests rows at the resonance of each design, returns the object that computes
/// these rows. For rows at the resonance, the function sets the drive frequency in `base` to
/// [`Value::Resonance`].
pub(super) fn read(
    root: &[Entry<'_>],
    simulator: &'static dyn Simulator,
    is_vehicle: bool,
    base: &mut [Value],
    problems: &mut Problems,
) -> Option<AtResonance> {
    let params = table::find(root, "params").and_then(|entry| entry.value.get_ref().as_table());
    let params = params.map(table::entries).unwrap_or_default();
    let asked = params.iter().find(|entry| sets_resonance(entry));
    let section = table::find(root, "resonance");
    let Some(asked) = asked else {
        if let Some(section) = section {
            problems
                .report(
                    section.key_span.clone(),
                    "[resonance] has no effect: the drive frequency is not \"resonance\"",
                )
                .help(format!("write {DRIVE_FREQUENCY} = \"{AT_RESONANCE}\" under [params]"));
        }
        return None;
    };
    if is_vehicle {
        problems
            .report(asked.value.span(), "vehicles are not run at their resonance")
            .note("different wings have different resonances")
            .help("vary drive_frequency under [axes], or give it the number that `flap test resonance` prints for one wing");
        return None;
    }
    let range = section.map_or_else(Range::default, |section| range(section, problems));
    let resonance = AtResonance::new(simulator, range);
    if resonance.is_none() {
        let message = format!("the model {} does not measure a {}", simulator.name(), range.of.name());
        problems.report(asked.value.span(), message);
    }
    let frequency = simulator.parameters().iter().position(|parameter| parameter.name == DRIVE_FREQUENCY);
    if let Some(frequency) = frequency {
        base[frequency] = Value::Resonance;
    }
    resonance
}

fn range(section: &Entry<'_>, problems: &mut Problems) -> Range {
    let entries = table::section(section, problems);
    table::check_keys(&entries, &KEYS, "in [resonance]", problems);
    let mut range = Range::default();
    if let Some(of) = table::find(&entries, "of") {
        let index = value::option("of", &Objective::NAMES, of.value, problems);
        range.of = index.map_or(range.of, |index| Objective::ALL[index]);
    }
    let mut positive = |key: &str| -> Option<f64> {
        let entry = table::find(&entries, key)?;
        frequency(key, entry.value, problems)
    };
    [range.from, range.to] = [positive("from"), positive("to")];
    range.tolerance = positive("tolerance").unwrap_or(range.tolerance);
    if let (Some(from), Some(to)) = (range.from, range.to)
        && from >= to
        && let Some(entry) = table::find(&entries, "to")
    {
        let message = format!("`to` must be more than `from`, {} Hz", value::shown(from));
        problems.report(entry.value.span(), message);
    }
    range
}

/// Returns a frequency in Hz, which must be more than zero.
fn frequency(key: &str, value: &Spanned<DeValue<'_>>, problems: &mut Problems) -> Option<f64> {
    let number = value::quantity(key, "Hz", value, problems)?;
    if number > 0.0 && number.is_finite() {
        return Some(number);
    }
    let message = format!("`{key}` must be more than zero, not {} Hz", value::shown(number));
    problems.report(value.span(), message);
    None
}
