//! Settings for columns that contain derivatives of measures.

use flap_core::parameter::{Kind, Parameter, Range};

use crate::derivative::Per;
use crate::notation::text;

/// The derivatives that rows contain: derivatives of some measures with respect to some parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gradient {
    /// Indices of measures in a list that contains the model's columns and then the measures of the plan.
    pub of: Vec<usize>,
    /// Indices of parameters in the model's parameter table.
    pub with_respect_to: Vec<usize>,
    /// Size of the parameter change to which each derivative refers: one per cent or one SI unit.
    pub per: Per,
}

impl Gradient {
    /// Returns the number of derivatives.
    pub fn len(&self) -> usize {
        self.of.len() * self.with_respect_to.len()
    }

    /// Returns true if there are no derivatives.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the measure and the parameter of each derivative, in the order of the columns.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.of.iter().flat_map(|&of| self.with_respect_to.iter().map(move |&by| (of, by)))
    }
}

/// Reason why rows cannot have derivatives with respect to a parameter. The message is the second part of a
/// sentence that begins with the parameter's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoDerivative {
    /// The value of the parameter is computed by formulas.
    #[error("is derived from other parameters")]
    Derived,
    /// The search for hover determines the value of the parameter.
    #[error("is an input that the search for hover changes")]
    Input,
    /// The parameter is a choice of options.
    #[error("is a choice, so there is no derivative with respect to it")]
    Choice,
    /// The parameter is a whole number.
    #[error("has whole numbers as values, so there is no derivative with respect to it")]
    Whole,
    /// The parameter is not set. The text describes the parameters that determine the value of this
    /// parameter.
    #[error("is not set: {}", following(.0))]
    Unset(&'static str),
}

/// Returns text about a parameter that is not set. The text names the parameters that determine the value, or
/// states that there is no default.
fn following(others: &str) -> String {
    text::no_default(others).unwrap_or_else(|| format!("it follows {others}"))
}

impl NoDerivative {
    /// Returns advice for changing the grid file. If there is no advice, the text is empty.
    pub fn help(self) -> &'static str {
        match self {
            NoDerivative::Derived => {
                "list these parameters instead: their derivatives include the effect of derived parameters"
            }
            NoDerivative::Input | NoDerivative::Choice | NoDerivative::Whole => "",
            NoDerivative::Unset(_) => "set it under [params]",
        }
    }
}

/// Checks that rows can have derivatives with respect to `parameter`.
///
/// # Errors
/// [`NoDerivative`] if rows cannot have derivatives with respect to the parameter.
pub(crate) fn check(
    parameter: &Parameter,
    is_derived: bool,
    is_input: bool,
    follows: Option<&'static str>,
) -> Result<(), NoDerivative> {
    match (&parameter.kind, follows) {
        _ if is_derived => Err(NoDerivative::Derived),
        _ if is_input => Err(NoDerivative::Input),
        (Kind::Choice(_), _) => Err(NoDerivative::Choice),
        (Kind::Number(Range::Whole(..)), _) => Err(NoDerivative::Whole),
        (_, Some(follows)) => Err(NoDerivative::Unset(follows)),
        _ => Ok(()),
    }
}
