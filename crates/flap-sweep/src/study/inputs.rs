//! Finds the inputs of a vehicle by the names that a user gives.

use flap_core::vehicle::Vehicle;

use crate::grid::why_absent;
use crate::notation::UserError;
use crate::plan::Plan;
use crate::vehicle::control::Input;

/// Returns the vehicle of a plan. `what` names the design in the error message.
///
/// # Errors
/// An error if the plan describes one wing.
pub fn vehicle<'p>(plan: &'p Plan, what: &str) -> Result<&'p Vehicle, UserError> {
    let help = "add [vehicle] and [[vehicle.wings]] to a grid file: see the manual, How to, Vehicles";
    let message = || format!("{what} describes one wing, not a vehicle");
    plan.vehicle().ok_or_else(|| UserError::new(message(), Some(help)))
}

/// Returns the vehicle's input with the given name (see [`Input::of`]).
///
/// # Errors
/// An error if the plan has no vehicle, if no input has this name, or if a formula determines the parameter
/// of the input.
pub fn input(plan: &Plan, name: &str) -> Result<Input, UserError> {
    let input = Input::of(vehicle(plan, "the design")?, name).map_err(|error| {
        let help = why_absent(plan.parameters(), name).or(error.help);
        UserError { message: error.message, help }
    });
    independent(plan, input?)
}

/// Returns the vehicle's inputs with the given names (see [`input`]).
///
/// # Errors
/// The errors of [`input`], and an error if two of the names denote the same parameter.
pub fn named(plan: &Plan, names: &[String]) -> Result<Vec<Input>, UserError> {
    let mut inputs: Vec<Input> = Vec::new();
    for name in names {
        let input = input(plan, name)?;
        if inputs.iter().any(|other| other.parameter == input.parameter) {
            return Err(twice(name));
        }
        inputs.push(input);
    }
    Ok(inputs)
}

/// Returns the default inputs of a plan's vehicle (see [`Input::usual`]).
///
/// # Errors
/// An error if the plan describes one wing, or if a formula determines the parameter of an input.
pub fn usual(plan: &Plan, values: &[f64]) -> Result<Vec<Input>, UserError> {
    let inputs = Input::usual(vehicle(plan, "the design")?, values);
    inputs.into_iter().map(|input| independent(plan, input)).collect()
}

/// If the plan has derived parameters, returns a warning that derived parameters stay constant while inputs
/// change.
pub fn held_constant(plan: &Plan) -> Option<&'static str> {
    let mut derived = plan.derived().parameters();
    derived.next().map(|_| "derived parameters ([derived]) are held constant while inputs change")
}

/// Returns the error message for an input that the user gave twice.
pub(super) fn twice(name: &str) -> UserError {
    UserError::new(format!("`{name}` is named twice"), None)
}

/// Returns `input`, or an error if a formula under `[derived]` determines the parameter of the input.
fn independent(plan: &Plan, input: Input) -> Result<Input, UserError> {
    if plan.derived().parameters().any(|derived| derived == input.parameter) {
        let help = "choose the parameters from which it is derived, or remove it from [derived]";
        let message = format!("`{}` is derived from other parameters", input.name);
        return Err(UserError::new(message, Some(help)));
    }
    Ok(input)
}
