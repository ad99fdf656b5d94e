//! One period of a design's settled motion.

use std::sync::atomic::Ordering;

use flap_core::num::Backend;
use flap_core::simulate::{PointRun, TrajectoryRequest};
use serde::Serialize;
use serde_json::{Map, Value};

use super::context::{AnswerContext, unfinished};
use crate::description;
use crate::request::{MOST_ROWS, MotionRequest, Refused};

/// A motion, with one row for each instant at which the motion is sampled.
#[derive(Serialize)]
pub(crate) struct Motion {
    columns: Vec<String>,
    /// A number that is not finite is null in JSON.
    rows: Vec<Vec<f64>>,
    /// The value of each parameter.
    values: Map<String, Value>,
}

/// Computes the motion of a design.
pub(crate) fn motion(context: &AnswerContext<'_>, request: &MotionRequest) -> Result<Motion, Refused> {
    let MotionRequest { design, samples, begin } = request;
    if *samples < 2 || *samples as usize > MOST_ROWS {
        return Err(Refused::impossible(format!("a motion has 2 to {MOST_ROWS} samples, not {samples}")));
    }
    let plan = context.opened.design(design)?;
    let values = plan.point(0).values;
    let interrupted = || context.stop.load(Ordering::Relaxed);
    let run = PointRun::new(Backend::best(), plan.solver(), &values).until(&interrupted);
    let motions = plan.simulator().motions().map_err(unfinished)?;
    let request = TrajectoryRequest { cycles: 1, samples_per_cycle: *samples, settled: begin.is_none() };
    let motion = motions.trajectory_from(&run, begin.as_deref(), &request).map_err(unfinished)?;
    let values = description::values(plan.parameters(), &values);
    Ok(Motion { columns: motion.columns, rows: motion.rows, values })
}
