//! Derivatives of measures, as columns of rows.

use flap_core::parameter::{Kind, Parameter, Range};
use flap_core::simulate::Simulator;
use flap_core::vehicle::standing;

use crate::notation::text;

/// The derivatives that rows have: of each of some measures by each of some parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gradient {
    /// Indices of the measures: the model's columns, then the plan's own.
    pub of: Vec<usize>,
    /// Indices into the model's parameter table.
    pub with_respect_to: Vec<usize>,
    /// The change of the parameter that they are per.
    pub per: Per,
}

/// The change of a parameter that derivatives are per.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Per {
    /// One per cent of the parameter.
    Cent,
    /// One of its SI unit.
    Unit,
}

impl Gradient {
    /// The number of derivatives.
    pub fn len(&self) -> usize {
        self.of.len() * self.with_respect_to.len()
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The derivatives in the order of their columns: measure and parameter.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.of.iter().flat_map(|&of| self.with_respect_to.iter().map(move |&by| (of, by)))
    }
}

/// The name of the column with the change of the measure `of` per per cent or per SI unit of the parameter `by`.
///
/// ```
/// use flap_sweep::plan::gradient::{Per, column_name};
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

/// Measure, parameter and change in the name of a column, as [`column_name`] writes it; `None` for other names.
///
/// ```
/// use flap_sweep::plan::gradient::{Per, parts};
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

/// The unit of a derivative: the unit `of` of the measure per per cent, or per unit `by` of the parameter.
///
/// ```
/// use flap_sweep::plan::gradient::{Per, unit};
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

/// The meaning of the column with the change of the measure `of`, which has this unit, by the parameter `by`.
pub fn meaning(of: &str, unit: &str, by: &str, per: Per) -> String {
    let change = match per {
        Per::Cent => "1 %",
        Per::Unit => "SI unit",
    };
    let unit = if unit.is_empty() { String::new() } else { format!(" ({unit})") };
    format!("change of {of}{unit} per {change} of {by}")
}

/// The reason why rows cannot have derivatives by a parameter, as the end of a sentence about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoShares {
    /// Formulas decide it.
    #[error("is derived from other parameters")]
    Derived,
    /// It is a named option.
    #[error("has fixed values, so there is no derivative by it")]
    Choice,
    /// It is a count.
    #[error("has fixed values, so there is no derivative by it")]
    Whole,
    /// It has no value of its own, and follows those that are told.
    #[error("is not set: {}", following(.0))]
    Unset(&'static str),
}

/// The parameters that one that is not set follows, as a sentence, or that it has no default.
fn following(others: &str) -> String {
    text::no_default(others).unwrap_or_else(|| format!("it follows {others}"))
}

impl NoShares {
    /// The remedy in a grid file; empty if there is none.
    pub fn help(self) -> &'static str {
        match self {
            NoShares::Derived => "name those: derivatives by them include what follows from them",
            NoShares::Choice | NoShares::Whole => "",
            NoShares::Unset(_) => "set it under [params]",
        }
    }
}

/// The share of the largest published value below which a value of a parameter is small. It is no larger because robots may be
/// far smaller than the published ones.
const SMALL: f64 = 1e-3;

/// The size of a parameter (SI), of which a small share changes it: its value or, where that is zero or so small that its shares
/// would be lost in rounding, a typical size. `None` if it is zero and none is known.
pub(crate) fn size(simulator: &dyn Simulator, values: &[f64], index: usize) -> Option<f64> {
    let value = standing(simulator.parameters(), values, index);
    let known = (value != 0.0 && value.is_finite()).then_some(value);
    match simulator.parameters()[index].kind {
        Kind::Number(range) | Kind::Following(range, _) if !range.contains(0.0) => return known,
        Kind::Number(_) | Kind::Following(..) | Kind::Choice(_) => {}
    }
    let typical = typical(simulator, values, index);
    typical.filter(|typical| known.is_none_or(|value| value.abs() < *typical)).or(known)
}

/// True if a parameter is zero and can be no less: its differences are one-sided.
pub(crate) fn is_least(parameters: &[Parameter], values: &[f64], index: usize) -> bool {
    let range = match parameters[index].kind {
        Kind::Number(range) | Kind::Following(range, _) => range,
        Kind::Choice(_) => return false,
    };
    standing(parameters, values, index) == 0.0 && !range.contains(-f64::MIN_POSITIVE)
}

/// A value after a change by a share of its [`size`].
pub(crate) fn moved(value: f64, size: Option<f64>, share: f64) -> f64 {
    match size {
        Some(size) if size != value => share.mul_add(size, value),
        _ => value * (1.0 + share),
    }
}

/// The size below which values of a parameter are small (SI): that of all wings' for one wing's and for a difference, the
/// published ones', else that of such quantities in robots of the size of an insect.
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
        "" | "rad" => Some(1.0),
        "m" => Some(1e-3),
        "N*m*s" => Some(1e-9),
        "rad/m^3" => Some(1e9),
        "kg" => Some(1e-6),
        "kg*m^2" => Some(1e-11),
        _ => None,
    }
}

/// The largest value of a parameter in the presets of the model; zero if they have none.
fn published(simulator: &dyn Simulator, index: usize) -> f64 {
    let values = simulator.presets().iter().filter_map(|preset| (preset.values)().get(index).copied());
    values.filter(|value| value.is_finite()).fold(0.0, |largest, value| value.abs().max(largest))
}

/// Checks that rows can have derivatives by `parameter`, which is derived or follows others, or has a value.
///
/// # Errors
/// The reason why not.
pub(crate) fn check(
    parameter: &Parameter,
    is_derived: bool,
    follows: Option<&'static str>,
) -> Result<(), NoShares> {
    match (&parameter.kind, follows) {
        _ if is_derived => Err(NoShares::Derived),
        (Kind::Choice(_), _) => Err(NoShares::Choice),
        (Kind::Number(Range::Whole(..)), _) => Err(NoShares::Whole),
        (_, Some(follows)) => Err(NoShares::Unset(follows)),
        _ => Ok(()),
    }
}
