//! Finds the parameters that have the largest effect on a measure of a settled motion.

use flap_core::parameter::{Kind, Range};
use flap_core::simulate::{Change, NoSlope, PointRun, Row, Simulator, Unfinished};

use crate::derivative::{moved, size};
use crate::plan::Plan;

/// Derivatives of one measure with respect to the parameters that can have small relative changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Slopes {
    /// Pairs of the index of a parameter and the derivative of the measure, in descending order of the
    /// magnitude. The derivative is the change of the measure, in its unit, per relative change of the
    /// parameter.
    pub known: Vec<(usize, f64)>,
    /// Indices of the parameters whose derivative is missing, each with the reason.
    pub unknown: Vec<(usize, NoSlope)>,
}

/// Returns the derivatives of a measure for a point with a periodic motion. `measure` is the index of the
/// measure in the measures of `row`.
///
/// `row` is the row of the point `run`. If rows are computed at hover or with the damping matrix, the
/// derivatives come from [`Plan::body`]. For rows without hover and without the damping matrix, the
/// derivatives come from `simulator`, the model of the plan. When a parameter changes, derived parameters
/// change too, except the parameters in `fixed`. At hover, the inputs change so that the vehicle with the
/// changed parameter still hovers.
///
/// # Errors
/// [`Unfinished`], as in
/// [`Gradients::gradient`](flap_core::simulate::Gradients::gradient).
pub fn slopes(
    plan: &Plan,
    simulator: &dyn Simulator,
    run: &PointRun<'_>,
    row: &Row,
    measure: usize,
    fixed: &[usize],
) -> Result<Slopes, Unfinished> {
    let parameters = changing(plan, run.values);
    let changed = |parameter: usize, share: f64| {
        let mut values = run.values.to_vec();
        values[parameter] = moved(values[parameter], size(plan.simulator(), run.values, parameter), share);
        plan.derived().fill(&mut values, fixed);
        values
    };
    let changes = parameters.iter().map(|&index| Change {
        ahead: changed(index, Change::SHARE),
        behind: changed(index, -Change::SHARE),
        size: Change::SHARE,
    });
    let changes: Vec<Change> = changes.collect();
    let gradient = match plan.body() {
        Some(body) => body.gradient(run, row, &changes)?,
        None => simulator.gradients()?.gradient(run, &row.state, &changes)?,
    };
    let (mut known, mut unknown) = (Vec::new(), Vec::new());
    for (index, slopes) in parameters.into_iter().zip(gradient.slopes) {
        match slopes[measure] {
            Ok(slope) => {
                let value = run.values[index];
                let size = size(plan.simulator(), run.values, index).unwrap_or(value);
                known.push((index, slope * (value / size)));
            }
            Err(reason) => unknown.push((index, reason)),
        }
    }
    known.sort_by(|(_, one), (_, other)| other.abs().total_cmp(&one.abs()));
    Ok(Slopes { known, unknown })
}

/// Returns the parameters that can have small relative changes. The result leaves out choices, whole numbers,
/// derived parameters, and parameters that are zero or not set. The result also leaves out inputs that the
/// search for hover changes.
fn changing(plan: &Plan, values: &[f64]) -> Vec<usize> {
    let parameters = plan.parameters().iter().enumerate();
    let changing = parameters.filter(|(index, parameter)| {
        let value = values[*index];
        let has_shares = match parameter.kind {
            Kind::Choice(_) | Kind::Number(Range::Whole(..)) => false,
            Kind::Number(_) | Kind::Following(..) => value.is_finite() && value != 0.0,
        };
        let is_input = plan.body().is_some_and(|body| body.has_input(*index));
        has_shares && !is_input && !plan.derived().parameters().any(|derived| derived == *index)
    });
    changing.map(|(index, _)| index).collect()
}
