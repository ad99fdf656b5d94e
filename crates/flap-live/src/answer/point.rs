//! The measures and natural frequencies of a design and of the published design, and the derivatives of a
//! measure.

use std::sync::atomic::Ordering;

use flap_core::num::Backend;
use flap_core::simulate::{Point, PointRun, Row, Rows, Status};
use flap_sweep::plan::{Admission, Plan};
use flap_sweep::study::deviation::{self, Deviation};
use flap_sweep::study::strongest;
use flap_sweep::table::layout::Layout;
use serde::Serialize;
use serde_json::{Map, Value};

use super::context::AnswerContext;
use crate::request::{PointRequest, Refused};
use crate::{description, rows};

/// The computed numbers of a design.
#[derive(Serialize)]
pub(crate) struct Numbers {
    columns: Vec<String>,
    row: Vec<Value>,
    /// The value of each parameter.
    values: Map<String, Value>,
    /// The row of the published design.
    published: Vec<Value>,
    /// The reason why the parameters are impossible, or why a sweep excludes the design.
    reason: Option<String>,
    /// Warnings about changed parameters whose values are far from the values of the preset.
    warnings: Vec<String>,
    /// The natural frequencies, if the model has natural frequencies.
    modes: Option<Vec<Mode>>,
    /// The natural frequencies of the published design.
    published_modes: Option<Vec<Mode>>,
    /// Derivatives of a measure, in falling order of magnitude.
    gradient: Option<Vec<Slope>>,
    /// The reason why the derivatives are missing.
    gradient_reason: Option<String>,
}

#[derive(Serialize)]
struct Mode {
    name: &'static str,
    frequency_hz: f64,
}

#[derive(Serialize)]
struct Slope {
    parameter: String,
    /// The change of the measure, in the unit of the measure, per 1 % of the parameter.
    per_percent: f64,
}

/// Computes measures, natural frequencies and derivatives of a design.
pub(crate) fn point(context: &AnswerContext<'_>, request: &PointRequest) -> Result<Numbers, Refused> {
    let plan = context.opened.design(&request.design)?;
    let values = plan.point(0).values;
    let interrupted = || context.stop.load(Ordering::Relaxed);
    let run = PointRun::new(Backend::best(), plan.solver(), &values).until(&interrupted);
    let mut reason = None;
    let row = match plan.judge(&values) {
        Admission::Invalid(invalid) => Row::invalid(invalid),
        verdict => {
            if let Admission::Excluded(unsatisfied) = verdict {
                let names = unsatisfied.iter().map(|&number| plan.conditions()[number].name.as_str());
                let names: Vec<&str> = names.collect();
                reason = Some(format!(
                    "a sweep excludes this design, because it does not satisfy {}",
                    names.join(", ")
                ));
            }
            let mut row = plan.rows().run_point(&run, None);
            plan.add_own_measures(&values, &mut row.measures);
            row
        }
    };
    context.check_wanted()?;
    let (mut gradient, mut gradient_reason) = (None, None);
    if let Some(measure) = &request.gradient {
        match slopes(&plan, &run, &row, measure) {
            Ok(slopes) => gradient = Some(slopes),
            Err(reason) => gradient_reason = Some(reason),
        }
        context.check_wanted()?;
    }
    let layout = Layout::of(&plan);
    let cells = |row: &Row, values: Vec<f64>| -> Vec<Value> {
        layout.cells(&Point::at_rest(0, values), row).into_iter().map(rows::value).collect()
    };
    let published = context.opened.published();
    let deviations = deviation::of_point(&plan, &values, |parameter| plan.has_unit(parameter));
    let changed = deviations.iter().filter(|deviation| request.design.contains_key(deviation.parameter.name));
    Ok(Numbers {
        warnings: changed.filter_map(Deviation::warning).collect(),
        columns: layout.names(),
        values: description::values(plan.parameters(), &values),
        reason: row.reason.clone().or(reason),
        modes: modes(&plan, &values),
        published_modes: modes(&plan, &published),
        published: cells(context.opened.published_row(), published),
        row: cells(&row, values),
        gradient,
        gradient_reason,
    })
}

/// Returns the natural frequencies of a design.
fn modes(plan: &Plan, values: &[f64]) -> Option<Vec<Mode>> {
    let modes = plan.simulator().experiments().ok()?.modes(values).ok()?;
    let modes = modes.into_iter().filter(|mode| mode.frequency.is_finite());
    Some(modes.map(|mode| Mode { name: mode.name, frequency_hz: mode.frequency }).collect())
}

/// Returns the derivatives of a measure with respect to all parameters that can change, or the reason why the measure
/// has no derivatives.
fn slopes(plan: &Plan, run: &PointRun<'_>, row: &Row, measure: &str) -> Result<Vec<Slope>, String> {
    let columns = plan.body().map_or_else(|| plan.simulator().columns(), Rows::columns);
    let place = columns.iter().position(|column| column.name == measure);
    let place = place.ok_or_else(|| format!("there is no measure `{measure}` with derivatives"))?;
    if row.status != Status::Periodic {
        return Err(format!(
            "the motion is {}, and only periodic motions have derivatives",
            row.status.name()
        ));
    }
    let strongest = strongest::slopes(plan, plan.simulator(), run, row, place, &[]);
    let known = strongest.map_err(|reason| reason.to_string())?.known;
    let parameters = plan.parameters();
    Ok(known
        .into_iter()
        .map(|(index, slope)| Slope {
            parameter: parameters[index].name.to_owned(),
            per_percent: 0.01 * slope,
        })
        .collect())
}
