//! Searches trims of a vehicle: values of the inputs at which the vehicle has a given mean force and torque.

use core::iter::successors;

use nalgebra::{DMatrix, DVector};

use super::control::{COMPONENTS, ControlError, Effectiveness, Input, VehicleRun, own_values};

/// Largest number of Newton steps in the search for a trim.
const MOST_STEPS: usize = 40;

/// A target is reached if the deviation from the target is at most this fraction of the target. If Newton's
/// iteration cannot reduce the deviation to this fraction, a deviation up to the numerical error of the row
/// is also accepted.
const TOLERANCE: f64 = 1e-6;

/// Largest deviation that is accepted because of the row's numerical error, as a fraction of the largest
/// component.
const LOOSEST: f64 = 5e-3;

/// In one step, an input may change by at most this fraction of its typical size.
const LARGEST_STEP: f64 = 0.2;

/// If a full Newton step is not successful, the search tries shorter steps, down to this fraction of the full
/// step.
const SMALLEST_PART: f64 = 1e-3;

/// A target of a trim: the required value of one force or torque component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Index of the component in [`COMPONENTS`].
    pub component: usize,
    /// Required value of the component (mN or uN·m).
    pub value: f64,
}

/// A trim: inputs at which the vehicle has the required force and torque.
#[derive(Clone, Debug, PartialEq)]
pub struct Trim {
    /// Control effectiveness at the trim, which also contains the values of the inputs.
    pub at: Effectiveness,
    /// Number of Newton steps until the targets were reached.
    pub steps: usize,
}

/// Searches inputs at which the vehicle reaches the `targets`, by Newton's iteration with exact derivatives.
/// The search begins at the parameter values `values`.
///
/// If there are more inputs than targets, Newton's equation has many solutions. The iteration uses the
/// solution with the shortest step, measured in typical sizes of the inputs.
///
/// # Errors
/// An error if there are fewer inputs than targets, if the initial motion is not periodic, or if the
/// iteration does not reach the targets.
pub fn to_targets(
    vehicle_run: &VehicleRun<'_>,
    values: &[f64],
    inputs: &[Input],
    targets: &[Target],
) -> Result<Trim, ControlError> {
    if targets.len() > inputs.len() {
        let names: Vec<&str> = inputs.iter().map(|input| input.name.as_str()).collect();
        return Err(ControlError::FewInputs { targets: targets.len(), inputs: names.join(", ") });
    }
    let mut values = own_values(vehicle_run.vehicle, values, inputs);
    let sizes = inputs.iter().map(|input| input.size(vehicle_run.vehicle, &values));
    let sizes: Vec<f64> = sizes.collect::<Result<_, _>>()?;
    let mut at = vehicle_run.effectiveness(&values, inputs, None)?;
    let first = largest(&at.wrench, targets);
    let own = targets.iter().map(|target| if target.value == 0.0 { first } else { target.value.abs() });
    let own = DVector::from_iterator(targets.len(), own);
    let mut steps = 0;
    while steps < MOST_STEPS {
        let missed = missed_by(&at.wrench, targets);
        if is_met(&missed, &own, TOLERANCE) {
            return Ok(Trim { at, steps });
        }
        let slopes = DMatrix::from_fn(targets.len(), inputs.len(), |i, j| {
            at.matrix[(targets[i].component, j)] / inputs[j].factor * sizes[j]
        });
        let step =
            slopes.svd(true, true).solve(&missed, 1e-12).unwrap_or_else(|_| DVector::zeros(inputs.len()));
        let first = (LARGEST_STEP / step.amax()).min(1.0);
        let mut parts =
            successors(Some(first), |part| Some(0.5 * part).filter(|part| *part >= SMALLEST_PART));
        let next = parts.find_map(|part| {
            let mut tried = values.clone();
            for ((input, size), step) in inputs.iter().zip(&sizes).zip(step.iter()) {
                tried[input.parameter] += part * size * step;
            }
            let row = vehicle_run.settled(&tried, Some(&at.row.state)).ok()?;
            let left = missed_by(&vehicle_run.wrench(&row), targets);
            let is_closer = left.component_div(&own).norm() < missed.component_div(&own).norm();
            is_closer.then_some((tried, row))
        });
        let Some((tried, row)) = next else { break };
        values = tried;
        steps += 1;
        at = vehicle_run.effectiveness(&values, inputs, Some(&row.state))?;
    }
    let all = DVector::from_element(targets.len(), largest(&at.wrench, targets));
    // Newton's iteration cannot reduce a distance below the error of the row.
    let tolerance = TOLERANCE.max(at.row.error_estimate.min(LOOSEST));
    if is_met(&missed_by(&at.wrench, targets), &all, tolerance) {
        return Ok(Trim { at, steps });
    }
    let allowed = tolerance * all[0];
    let is_missed = |target: &&Target| (at.wrench[target.component] - target.value).abs() > allowed;
    let nearest = targets.iter().filter(is_missed).map(|Target { component, value }| {
        let (name, found) = (COMPONENTS[*component], at.wrench[*component]);
        let [fixed, wanted] = [found, *value].map(|number| format!("{number:.7}"));
        let [fixed, wanted] =
            if fixed == wanted { [found, *value].map(|n| format!("{n:e}")) } else { [fixed, wanted] };
        format!("{name} = {fixed} instead of {wanted}")
    });
    let nearest = nearest.collect::<Vec<_>>().join(", ");
    Err(ControlError::NotReached(format!("{nearest}, but a trim allows a difference of {allowed:.1e}")))
}

/// Returns the required value minus the present value of each component with a target.
fn missed_by(wrench: &[f64; 6], targets: &[Target]) -> DVector<f64> {
    let missed = targets.iter().map(|target| target.value - wrench[target.component]);
    DVector::from_iterator(targets.len(), missed)
}

/// Returns the largest magnitude among the six components of force and torque and the target values.
fn largest(wrench: &[f64; 6], targets: &[Target]) -> f64 {
    let targets = targets.iter().map(|target| &target.value);
    wrench.iter().chain(targets).fold(0.0, |one: f64, other| one.max(other.abs()))
}

/// Returns true if the deviation from each target is at most `tolerance` times the size of the target.
fn is_met(missed: &DVector<f64>, sizes: &DVector<f64>, tolerance: f64) -> bool {
    missed.iter().zip(sizes.iter()).all(|(missed, size)| missed.abs() <= tolerance * size)
}
