//! The response of a design while a parameter rises and falls.

use flap_core::parameter::Parameter;
use flap_sweep::plan::Along;
use flap_sweep::run::{Outcome, RowWriter, Summary};
use flap_sweep::study::response::Responses;
use flap_sweep::table::layout::Layout;

use serde::Serialize;

use super::context::AnswerContext;
use crate::request::{HysteresisRequest, MOST_ROWS, Refused};
use crate::rows::Rows;

/// The rows of a response, and the state at the beginning of the motion of each row. A row without a motion has no
/// state.
#[derive(Serialize)]
pub(crate) struct Response {
    #[serde(flatten)]
    rows: Rows,
    states: Vec<Vec<f64>>,
}

/// Computes the rows of `flap respond`: the rising branch, then the falling branch.
pub(crate) fn hysteresis(
    context: &AnswerContext<'_>,
    request: &HysteresisRequest,
) -> Result<Response, Refused> {
    let HysteresisRequest { design, x } = request;
    if x.n < 2 || 2 * x.n as usize > MOST_ROWS {
        let error = format!("a response has 2 to {} values, not {}", MOST_ROWS / 2, x.n);
        return Err(Refused::impossible(error));
    }
    let plan = context.opened.plan_of(&context.opened.grid(design, Some(x), None)?)?;
    let Some(index) = Parameter::index(plan.parameters(), &x.name) else {
        return Err(Refused::impossible(format!("there is no parameter `{}`", x.name)));
    };
    let (plan, along) = Along::new(plan, index, None, None, false).map_err(|error| Refused::Impossible {
        error: error.message,
        help: error.help,
        parameter: Some(x.name.clone()),
    })?;
    let plan = plan.following(along);
    let responses =
        Responses::of(&plan).ok_or_else(|| Refused::Fault("no parameter is followed".to_owned()))?;
    let layout = Layout::of(&plan);
    let (mut rows, mut states) = (Rows::of(&plan), Vec::new());
    let mut output = RowWriter::begin(&plan, Summary::default(), &mut rows)?;
    let mut run = responses.curves(&context.options, 0);
    while let Some(batch) = run.next_batch()? {
        context.check_wanted()?;
        for outcome in &batch {
            output.write_curve(outcome)?;
            if let Outcome::Ran(curve) = outcome {
                states.extend(curve.rows(&plan, &layout).map(|(_, row)| row.state.clone()));
            }
        }
    }
    Ok(Response { rows, states })
}
