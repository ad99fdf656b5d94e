//! Computes the derivatives of measures with respect to parameters, for a vehicle that keeps hovering.
//!
//! The mean force and torque w(p, u) depend on a design parameter p and on the inputs u. At hover, w equals
//! the targets t(p). If p changes, the inputs must change at the rate u' with w_p + w_u u' = t', where the
//! indices denote partial derivatives. A measure m(p, u) therefore has the derivative m_p + m_u u'.

use flap_core::simulate::{Change, Gradient, Gradients as _, NoSlope, PointRun, Unfinished};
use flap_core::vehicle::Vehicle;
use nalgebra::{DMatrix, DVector};

use super::control::{IDLE, Input, places};
use super::hover::targets;

/// The equation w_p + w_u u' = t' counts as solved if its error is at most this fraction of the largest
/// component.
const SOLVED: f64 = 1e-6;

/// Returns the derivatives of the measures of `vehicle`, and then the derivatives of the inputs in their
/// printed units. `run` contains parameter values at which the vehicle hovers. `state` is the state of the
/// settled motion. `changes` contains the changes of parameters at constant inputs.
///
/// Derivatives are missing if the inputs at hover are not unique, for example if more inputs have an effect
/// than there are targets.
///
/// # Errors
/// Returns an error if the computation is interrupted.
pub(super) fn gradient(
    vehicle: &Vehicle,
    run: &PointRun<'_>,
    state: &[f64],
    inputs: &[Input],
    changes: &[Change],
) -> Result<Gradient, Unfinished> {
    let of_inputs = inputs.iter().map(|input| input.change(vehicle, run.values, false).ok());
    let of_inputs: Vec<Change> = of_inputs.collect::<Option<_>>().unwrap_or_default();
    let all: Vec<Change> = changes.iter().cloned().chain(of_inputs).collect();
    let mut found = vehicle.gradient(run, state, &all)?;
    let by_inputs = found.slopes.split_off(changes.len());
    let sizes = inputs.iter().map(|input| input.size(vehicle, run.values).unwrap_or(f64::NAN));
    let sizes: Vec<f64> = sizes.collect();
    let at = targets(&vehicle.mass_properties(run.values)).unwrap_or_default();
    let components: Vec<usize> = at.iter().map(|target| places(vehicle)[target.component]).collect();
    let response = response(&components, &by_inputs, &sizes);
    for (slopes, change) in found.slopes.iter_mut().zip(changes) {
        let rates = required(vehicle, run.values, change, &components, slopes);
        let count = slopes.len() + inputs.len();
        *slopes = match rates.and_then(|rates| solve(response.as_ref().map_err(|reason| *reason)?, &rates)) {
            Err(reason) => vec![Err(reason); count],
            Ok(shares) => {
                let least = IDLE * shares.amax();
                let moved = |(place, slope): (usize, &Result<f64, NoSlope>)| {
                    let mut sum = effect(*slope)?;
                    for ((by_input, share), size) in by_inputs.iter().zip(shares.iter()).zip(&sizes) {
                        // A kink of a measure does not matter if the input stays.
                        if share.abs() > least {
                            sum += effect(by_input[place])? * share * size;
                        }
                    }
                    Ok(sum)
                };
                let of_inputs = inputs.iter().zip(shares.iter()).zip(&sizes);
                let of_inputs = of_inputs.map(|((input, share), size)| Ok(share * size / input.factor));
                slopes.iter().enumerate().map(moved).chain(of_inputs).collect()
            }
        };
    }
    Ok(found)
}

/// Returns a derivative as a number. If the changed input or parameter has no effect on the wings, the
/// derivative is zero.
fn effect(slope: Result<f64, NoSlope>) -> Result<f64, NoSlope> {
    if slope == Err(NoSlope::Zero) { Ok(0.0) } else { slope }
}

/// Returns w_u, the derivatives of the upward force and the torques with respect to relative changes of the
/// inputs.
fn response(
    places: &[usize],
    by_inputs: &[Vec<Result<f64, NoSlope>>],
    sizes: &[f64],
) -> Result<DMatrix<f64>, NoSlope> {
    let mut matrix = DMatrix::zeros(places.len(), sizes.len());
    for (j, (slopes, size)) in by_inputs.iter().zip(sizes).enumerate() {
        for (i, &place) in places.iter().enumerate() {
            matrix[(i, j)] = effect(slopes[place])? * size;
        }
    }
    let least = IDLE * matrix.amax();
    let effective = matrix.column_iter().filter(|column| column.amax() > least).count();
    let is_unique = matrix.rank(least) == effective;
    if is_unique { Ok(matrix) } else { Err(NoSlope::Missing) }
}

/// Returns u', the relative changes of the inputs. The linear equation for u' has the matrix `response` and
/// the right-hand side `rates`.
fn solve(response: &DMatrix<f64>, rates: &DVector<f64>) -> Result<DVector<f64>, NoSlope> {
    let decomposed = response.clone().svd(true, true);
    let least = IDLE * decomposed.singular_values.max();
    let shares = decomposed.solve(rates, least).map_err(|_| NoSlope::Missing)?;
    let is_solved = (response * &shares - rates).amax() <= SOLVED * rates.amax();
    if is_solved { Ok(shares) } else { Err(NoSlope::Missing) }
}

/// Returns t' − w_p, the rates at which the inputs must change the upward force and the torques when a
/// parameter changes.
///
/// `slopes` contains the derivatives of the measures at constant inputs.
fn required(
    vehicle: &Vehicle,
    values: &[f64],
    change: &Change,
    places: &[usize],
    slopes: &[Result<f64, NoSlope>],
) -> Result<DVector<f64>, NoSlope> {
    let is_same =
        |one: &[f64], other: &[f64]| one.iter().zip(other).all(|(one, other)| one.total_cmp(other).is_eq());
    if is_same(&change.ahead, &change.behind) {
        return Err(NoSlope::Zero);
    }
    let back = if is_same(&change.behind, values) { 0.0 } else { change.size };
    let [ahead, behind] =
        [&change.ahead, &change.behind].map(|values| targets(&vehicle.mass_properties(values)));
    let (ahead, behind) = ahead.zip(behind).ok_or(NoSlope::Edge)?;
    let rates = ahead.iter().zip(&behind).zip(places).map(|((ahead, behind), &place)| {
        Ok((ahead.value - behind.value) / (change.size + back) - effect(slopes[place])?)
    });
    Ok(DVector::from_vec(rates.collect::<Result<Vec<f64>, NoSlope>>()?))
}
