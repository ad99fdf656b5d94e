//! Derivatives of measures with respect to parameters: names and units of their columns, and reference sizes
//! for small changes of parameters.

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::{NoSlope, Simulator};
use flap_core::vehicle::standing;

/// Unit of the parameter change in a derivative: one per cent or one SI unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Per {
    /// The derivative is the change of the measure if the parameter changes by one per cent.
    Cent,
    /// The derivative is the change of the measure per SI unit of the parameter.
    Unit,
}

/// Returns the name of the column that contains the derivative of the measure `of` with respect to the
/// parameter `by`.
///
/// ```
/// use flap_sweep::derivative::{Per, column_name};
/// let of_lift = |per| column_name("lift_mean_mn", "hinge_stiffness", per);
/// assert_eq!(of_lift(Per::Cent), "d_lift_mean_mn_per_pct_hinge_stiffness");
/// assert_eq!(of_lift(Per::Unit), "d_lift_mean_mn_per_si_hinge_stiffness");
/// ```
pub fn column_name(of: &str, by: &str, per: Per) -> String {
    match per {
        Per::Cent => format!("d_{of}_per_pct_{by}"),
        Per::Unit => format!("d_{of}_per_si_{by}"),
    }
}

/// Splits a name that [`column_name`] returned into the measure, the parameter and the unit of the change. If
/// `column` is not the name of a column with a derivative, returns `None`.
///
/// ```
/// use flap_sweep::derivative::{Per, parts};
/// let found = parts("d_lift_mean_mn_per_pct_hinge_stiffness");
/// assert_eq!(found, Some(("lift_mean_mn", "hinge_stiffness", Per::Cent)));
/// assert_eq!(parts("lift_mean_mn"), None);
/// ```
pub fn parts(column: &str) -> Option<(&str, &str, Per)> {
    let rest = column.strip_prefix("d_")?;
    [("_per_pct_", Per::Cent), ("_per_si_", Per::Unit)]
        .into_iter()
        .find_map(|(between, per)| rest.split_once(between).map(|(of, by)| (of, by, per)))
}

/// Encodes the reasons why derivatives are missing as one number, with one bit for each reason. If there are
/// no reasons, returns NaN. A row can store the reasons only as a number, because all measures of a row are
/// numbers.
pub(crate) fn gap_code(reasons: impl Iterator<Item = NoSlope>) -> f64 {
    let set = reasons.fold(0_u32, |set, reason| set | 1 << reason as u32);
    if set == 0 { f64::NAN } else { f64::from(set) }
}

/// Decodes `code`, a number from [`gap_code`], into the reasons why derivatives are missing. The reasons are
/// in the order of [`NoSlope::ALL`].
pub(crate) fn reasons_of(code: f64) -> impl Iterator<Item = NoSlope> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a set of a few bits; NaN gives 0"
    )]
    let set = code as u32;
    NoSlope::ALL.into_iter().filter(move |reason| set >> *reason as u32 & 1 == 1)
}

/// Returns the unit of a derivative as text. `of` is the unit of the measure, and `by` is the SI unit of the
/// parameter.
///
/// ```
/// use flap_sweep::derivative::{Per, unit};
/// assert_eq!(unit("mN", "N*m/rad", Per::Unit), "mN/(N*m/rad)");
/// assert_eq!(unit("mN", "N*m/rad", Per::Cent), "mN/%");
/// assert_eq!(unit("", "Hz", Per::Unit), "1/Hz");
/// assert_eq!(unit("mN", "", Per::Unit), "mN");
/// ```
pub fn unit(of: &str, by: &str, per: Per) -> String {
    let by = match per {
        Per::Cent => "%",
        Per::Unit => by,
    };
    let above = if of.is_empty() { "1" } else { of };
    match by {
        "" => of.to_owned(),
        by if by.contains(['*', '/']) => format!("{above}/({by})"),
        by => format!("{above}/{by}"),
    }
}

/// Returns the description of a column that contains a derivative. `of` is the measure, `unit` is the unit of
/// the measure, and `by` is the parameter.
pub fn meaning(of: &str, unit: &str, by: &str, per: Per) -> String {
    let change = match per {
        Per::Cent => "1 %",
        Per::Unit => "SI unit",
    };
    let unit = if unit.is_empty() { String::new() } else { format!(" ({unit})") };
    format!("change of {of}{unit} per {change} of {by}")
}

/// A parameter value counts as small if it is less than this fraction of the largest value in the presets.
///
/// The fraction is small, because some robots are far smaller than the robots of the presets.
const SMALL: f64 = 1e-3;

/// Returns the reference size of a parameter in SI units: a change of one per cent is one per cent of this
/// size. If the parameter is zero and has no typical size, returns `None`.
///
/// The reference size is usually the parameter's value. If the value is zero or small, and zero is allowed,
/// the reference size is a typical size of the parameter.
pub(crate) fn size(simulator: &dyn Simulator, values: &[f64], index: usize) -> Option<f64> {
    let value = standing(simulator.parameters(), values, index);
    let known = (value != 0.0 && value.is_finite()).then_some(value);
    if let Kind::Number(range) | Kind::Following(range, _) = simulator.parameters()[index].kind
        && !range.contains(0.0)
    {
        return known;
    }
    let typical = typical(simulator, values, index);
    typical.filter(|typical| known.is_none_or(|value| value.abs() < *typical)).or(known)
}

/// Returns true if a parameter is zero and cannot be negative. Finite differences with respect to a parameter
/// at its lower limit must be one-sided.
pub(crate) fn is_least(parameters: &[Parameter], values: &[f64], index: usize) -> bool {
    let (Kind::Number(range) | Kind::Following(range, _)) = parameters[index].kind else { return false };
    standing(parameters, values, index) == 0.0 && !range.contains(-f64::MIN_POSITIVE)
}

/// Returns `value` plus `share` times the reference size that [`size`] returned. Without a reference size,
/// the function adds `share` times `value`.
pub(crate) fn moved(value: f64, size: Option<f64>, share: f64) -> f64 {
    match size {
        Some(size) if size != value => share.mul_add(size, value),
        _ => value * (1.0 + share),
    }
}

/// Returns the typical size of a parameter in SI units.
///
/// For a parameter of one wing or a left-right difference, the typical size is the reference size of the
/// corresponding parameter of all wings. For a parameter with published values, the typical size is the
/// largest published value. If the value of a parameter with published values is not small, the parameter has
/// no typical size. For a parameter without published values, the typical size is a usual value for
/// insect-scale robots.
fn typical(simulator: &dyn Simulator, values: &[f64], index: usize) -> Option<f64> {
    let parameters = simulator.parameters();
    let parameter = &parameters[index];
    let of = |name: &str| {
        let other = Parameter::index(parameters, name).filter(|other| *other != index)?;
        size(simulator, values, other).map(f64::abs)
    };
    let shared = match parameter.kind {
        Kind::Following(_, follows) => Some(follows),
        Kind::Number(_) | Kind::Choice(_) => parameter.name.strip_prefix("difference_"),
    };
    if let Some(size) = shared.and_then(of) {
        return Some(size);
    }
    let published = published(simulator, index);
    if published > 0.0 {
        return Some(published).filter(|published| values[index].abs() < SMALL * published);
    }
    match parameter.unit {
        "V" => of("drive_voltage_pp"),
        "" | "rad" | "m/s" => Some(1.0),
        "m" => Some(1e-3),
        "N*m*s" => Some(1e-9),
        "rad/m^3" => Some(1e9),
        "rad/s" => Some(100.0),
        "m/V" => Some(1e-7),
        "kg" | "N*m/rad" | "N*m/rad^3" => Some(1e-6),
        "kg*m^2" => Some(1e-11),
        _ => None,
    }
}

/// Returns the largest magnitude of a parameter in the presets of the model, or zero if no preset has a
/// value.
fn published(simulator: &dyn Simulator, index: usize) -> f64 {
    let values = simulator.presets().iter().filter_map(|preset| (preset.values)().get(index).copied());
    values.filter(|value| value.is_finite()).fold(0.0, |largest, value| value.abs().max(largest))
}
