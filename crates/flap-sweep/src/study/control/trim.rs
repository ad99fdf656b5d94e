//! Trims: the inputs that give a wanted force and torque.

use flap_core::simulate::Status;
use nalgebra::{DMatrix, DVector};

use super::effectiveness::{COMPONENTS, ControlError, Effectiveness, Flight, own_values};
use super::input::Input;

/// Steps of Newton's iteration.
const MOST_STEPS: usize = 40;

/// The share of a target to which it is met; where the error of the motion allows no more, of the largest component.
const TOLERANCE: f64 = 1e-6;

/// The largest change of the inputs in a step, in their typical sizes.
const LARGEST_STEP: f64 = 0.2;

/// The smallest part of a step that is tried.
const SMALLEST_PART: f64 = 1e-3;

/// A wanted component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Its place in [`COMPONENTS`].
    pub component: usize,
    /// The wanted value (mN or uN·m).
    pub value: f64,
}

/// Inputs that give the wanted force and torque.
#[derive(Clone, Debug, PartialEq)]
pub struct Trim {
    /// The control effectiveness there, with the values of the inputs.
    pub at: Effectiveness,
    /// Steps of Newton's iteration.
    pub steps: usize,
}

/// The reason why there is no trim.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TrimError {
    /// More targets than inputs.
    #[error("{targets} targets need as many inputs, not {inputs}")]
    FewInputs {
        /// Number of targets.
        targets: usize,
        /// Number of inputs.
        inputs: usize,
    },
    /// The iteration comes no nearer.
    #[error("the targets are not reached: {}", nearest(at, targets))]
    NotReached {
        /// The nearest point.
        at: Box<Effectiveness>,
        /// The targets.
        targets: Vec<Target>,
    },
    /// The effectiveness is not known.
    #[error(transparent)]
    Control(#[from] ControlError),
}

fn nearest(at: &Effectiveness, targets: &[Target]) -> String {
    let parts = targets.iter().map(|target| {
        format!(
            "{} = {:.4} instead of {}",
            COMPONENTS[target.component], at.wrench[target.component], target.value
        )
    });
    parts.collect::<Vec<_>>().join(", ")
}

/// The inputs near `values` that give the `targets`, by Newton's iteration with exact derivatives. Where there are more inputs
/// than targets, each step is the smallest one, in typical sizes of the inputs.
///
/// # Errors
/// If there are fewer inputs than targets, the motion is not periodic at the beginning, or the targets are not reached.
pub fn trim(
    flight: &Flight<'_>,
    values: &[f64],
    inputs: &[Input],
    targets: &[Target],
) -> Result<Trim, TrimError> {
    if targets.len() > inputs.len() {
        return Err(TrimError::FewInputs { targets: targets.len(), inputs: inputs.len() });
    }
    let mut values = own_values(flight.vehicle, values, inputs);
    let sizes: Option<Vec<f64>> = inputs.iter().map(|input| input.size(flight.vehicle, &values)).collect();
    let Some(sizes) = sizes else {
        let without = inputs.iter().find(|input| input.size(flight.vehicle, &values).is_none());
        let name = without.map_or_else(String::new, |input| input.name.clone());
        return Err(ControlError::NoSize(name).into());
    };
    let mut at = flight.effectiveness(&values, inputs, None)?;
    let mut taken = 0;
    let own = own_sizes(&at.wrench, targets);
    for steps in 0..MOST_STEPS {
        let missed = missed_by(&at.wrench, targets);
        if is_met(&missed, &own) {
            return Ok(Trim { at, steps });
        }
        let slopes = DMatrix::from_fn(targets.len(), inputs.len(), |i, j| {
            at.matrix[(targets[i].component, j)] / inputs[j].factor * sizes[j]
        });
        let step =
            slopes.svd(true, true).solve(&missed, 1e-12).unwrap_or_else(|_| DVector::zeros(inputs.len()));
        let largest = step.amax();
        let mut part = if largest > LARGEST_STEP { LARGEST_STEP / largest } else { 1.0 };
        let next = loop {
            let mut tried = values.clone();
            for ((input, size), step) in inputs.iter().zip(&sizes).zip(step.iter()) {
                tried[input.parameter] += part * size * step;
            }
            let row = flight.row(&tried, Some(&at.row.state));
            let better = row.status == Status::Periodic && {
                let left = missed_by(&flight.wrench(&row), targets);
                left.component_div(&own).norm() < missed.component_div(&own).norm()
            };
            if better {
                break Some((tried, row));
            }
            part *= 0.5;
            if part < SMALLEST_PART {
                break None;
            }
        };
        let Some((tried, row)) = next else { break };
        values = tried;
        taken = steps + 1;
        at = flight.effectiveness(&values, inputs, Some(&row.state))?;
    }
    let all = DVector::from_element(targets.len(), largest(&at.wrench, targets));
    if is_met(&missed_by(&at.wrench, targets), &all) {
        return Ok(Trim { at, steps: taken });
    }
    Err(TrimError::NotReached { at: Box::new(at), targets: targets.to_vec() })
}

/// The targets less the components.
fn missed_by(wrench: &[f64; 6], targets: &[Target]) -> DVector<f64> {
    let missed = targets.iter().map(|target| target.value - wrench[target.component]);
    DVector::from_iterator(targets.len(), missed)
}

/// The largest of the components and the targets.
fn largest(wrench: &[f64; 6], targets: &[Target]) -> f64 {
    let targets = targets.iter().map(|target| &target.value);
    wrench.iter().chain(targets).fold(0.0, |one: f64, other| one.max(other.abs()))
}

/// The size of each target: its own, or the largest of all if it is zero.
fn own_sizes(wrench: &[f64; 6], targets: &[Target]) -> DVector<f64> {
    let largest = largest(wrench, targets);
    let own = targets.iter().map(|target| if target.value == 0.0 { largest } else { target.value.abs() });
    DVector::from_iterator(targets.len(), own)
}

/// True if all targets are met but for a small share of these sizes.
fn is_met(missed: &DVector<f64>, sizes: &DVector<f64>) -> bool {
    missed.iter().zip(sizes.iter()).all(|(missed, size)| missed.abs() <= TOLERANCE * size)
}
