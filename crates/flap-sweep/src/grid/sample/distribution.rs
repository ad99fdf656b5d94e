//! Reads the distribution of a sampled parameter, such as `{ from, to }`, `{ mean, sd }` or a list of values.

use flap_core::parameter::Parameter;
use toml::de::DeValue;

use crate::grid::diagnostic::Problems;
use crate::grid::table::{self, Entry};
use crate::grid::{axes, uncertainty, value};
use crate::plan::Value;
use crate::plan::axes::Values;
use crate::plan::sample::Distribution;

pub(in crate::grid) const KEYS: [&str; 6] = ["from", "to", "scale", "mean", "sd", "relative_sd"];
pub(in crate::grid) const SCALES: [&str; 2] = ["linear", "log"];
const TOO_WIDE: &str = "the range is too wide for 64-bit floats";
const NOTE: &str = "distributions look like { from = 1, to = 5 }, { from = 1, to = 5, scale = \"log\" }, \
                    { mean = 3, sd = 0.1 }, { relative_sd = \"5 %\" } or [1, 2, 5]";

/// Returns the distribution of `parameter`. If the distribution has mistakes, reports the mistakes and
/// returns `None`.
///
/// `base` is the value that the parameter has without the sample, and the default mean of a normal
/// distribution.
pub(super) fn read(
    parameter: &Parameter,
    base: Value,
    entry: &Entry<'_>,
    problems: &mut Problems,
) -> Option<Distribution> {
    let table = match entry.value.get_ref() {
        DeValue::Array(_) => {
            return match axes::values(parameter, entry, problems)? {
                Values::List(values) => Some(Distribution::Among(values)),
                _ => None,
            };
        }
        DeValue::Table(table) => table,
        other => {
            let message =
                format!("`{}` must be a distribution or a list, not {}", entry.key, table::kind(other));
            problems
                .report(entry.value.span(), message)
                .note(NOTE)
                .help(format!("to give `{}` a single value, put it under [params]", entry.key));
            return None;
        }
    };
    let help = "list the options to choose from at random";
    if value::report_choice(parameter, entry, "such distribution", help, problems) {
        return None;
    }
    let entries = &table::entries(table);
    if !table::check_keys(entries, &KEYS, "in a distribution", problems) {
        return None;
    }
    let has = |key: &str| table::find(entries, key).is_some();
    let mut reader = Reader { parameter, whole: entry, entries, problems };
    if has("mean") || has("sd") || has("relative_sd") { reader.normal(base) } else { reader.uniform() }
}

/// Reads one distribution. If the distribution has mistakes, the methods of this type report the mistakes and
/// return `None`.
struct Reader<'a, 't> {
    parameter: &'a Parameter<'a>,
    /// Entry of the sampled parameter in the file.
    whole: &'a Entry<'t>,
    /// Entries of the distribution.
    entries: &'a [Entry<'t>],
    problems: &'a mut Problems,
}

impl Reader<'_, '_> {
    /// Returns the number after `key`, or `None` if the distribution does not contain `key`. If the number is
    /// wrong, reports a mistake and returns `Err`.
    fn end(&mut self, key: &str) -> Result<Option<f64>, ()> {
        match table::find(self.entries, key) {
            Some(entry) => {
                value::of_parameter(self.parameter, entry.value, self.problems).map(Some).ok_or(())
            }
            None => Ok(None),
        }
    }

    fn uniform(&mut self) -> Option<Distribution> {
        let (from, to) = (self.end("from"), self.end("to"));
        let scale = match table::find(self.entries, "scale") {
            Some(entry) => value::option("scale", &SCALES, entry.value, self.problems)?,
            None => 0,
        };
        let (Some(from), Some(to)) = (from.ok()?, to.ok()?) else {
            let message = format!("the distribution of `{}` needs `from` and `to`, or `sd`", self.whole.key);
            self.problems.report(self.whole.value.span(), message).note(NOTE);
            return None;
        };
        self.checked(if scale == 0 {
            Distribution::Uniform { from, to }
        } else {
            Distribution::LogUniform { from, to }
        })
    }

    fn normal(&mut self, base: Value) -> Option<Distribution> {
        let (from, to) = (self.end("from"), self.end("to"));
        let mean = self.end("mean").ok()?;
        if let Some(scale) = table::find(self.entries, "scale") {
            self.problems
                .report(scale.key_span.clone(), "a normal distribution has no `scale`")
                .help("remove it, or give `from` and `to` alone");
            return None;
        }
        let Some(mean) = mean.or(base.given()) else {
            let why = if base == Value::OfDesign { "differs between the designs" } else { "is not set" };
            let message = format!("`{}` {why}, so it has no value for the mean", self.whole.key);
            self.problems.report(self.whole.value.span(), message).help("give the distribution a `mean`");
            return None;
        };
        let sd = self.sd(mean)?;
        let (from, to) = (from.ok()?.unwrap_or(f64::NEG_INFINITY), to.ok()?.unwrap_or(f64::INFINITY));
        self.checked(Distribution::Normal { mean, sd, from, to })
    }

    /// Returns the standard deviation of a normal distribution, in the SI unit of the parameter.
    fn sd(&mut self, mean: f64) -> Option<f64> {
        let (absolute, relative) =
            (table::find(self.entries, "sd"), table::find(self.entries, "relative_sd"));
        let (entry, unit) = match (absolute, relative) {
            (Some(absolute), None) => (absolute, Some(self.parameter.unit)),
            (None, Some(relative)) => (relative, None),
            (Some(_), Some(relative)) => {
                let message = "a normal distribution takes `sd` or `relative_sd`, not both";
                self.problems.report(relative.key_span.clone(), message).help("keep one of them");
                return None;
            }
            (None, None) => {
                let message = format!("the distribution of `{}` has no `sd`", self.whole.key);
                self.problems.report(self.whole.value.span(), message).note(NOTE);
                return None;
            }
        };
        if unit.is_some() && uncertainty::report_share(entry, self.problems) {
            return None;
        }
        let number = value::quantity(entry.key, unit.unwrap_or_default(), entry.value, self.problems)?;
        let sd = if unit.is_some() { number } else { number * mean.abs() };
        if sd > 0.0 && sd.is_finite() {
            return Some(sd);
        }
        let message = format!(
            "`{}` must give a standard deviation of more than zero, not {}",
            entry.key,
            value::shown(sd)
        );
        let diagnostic = self.problems.report(entry.value.span(), message);
        if unit.is_none() && mean == 0.0 {
            diagnostic.help("the mean is zero: give `sd` in the unit of the parameter");
        }
        None
    }

    /// Returns the distribution if values can be drawn from it. If no values can be drawn, reports a mistake
    /// and returns `None`.
    fn checked(&mut self, distribution: Distribution) -> Option<Distribution> {
        let mistake = match distribution {
            Distribution::Uniform { from, to }
            | Distribution::LogUniform { from, to }
            | Distribution::Normal { from, to, .. }
                if from >= to =>
            {
                "`from` must be less than `to`"
            }
            Distribution::LogUniform { from, to } if from <= 0.0 && to >= 0.0 => {
                "a logarithmic scale needs ends that are not zero and have the same sign"
            }
            Distribution::Uniform { from, to } if !(to - from).is_finite() => TOO_WIDE,
            Distribution::LogUniform { from, to } if !(to / from).is_normal() => TOO_WIDE,
            Distribution::Normal { .. } if !distribution.is_possible() => {
                "the normal distribution has no values between `from` and `to`"
            }
            _ => return Some(distribution),
        };
        self.problems.report(self.whole.value.span(), mistake);
        None
    }
}
