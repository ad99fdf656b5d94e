//! Restores the plan that a sidecar records.

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::Simulator;
use toml::Value;

use super::{Followed, Sidecar};
use crate::grid;
use crate::grid::diagnostic::Mistakes;
use crate::notation::text;
use crate::notation::value::{self, UnitOf};
use crate::plan::selection;
use crate::plan::{Along, Plan, PointsFile};
use crate::run::identity::{self, Identity};

/// Reason why the plan of a sidecar cannot be restored.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// According to this version of flap, the recorded grid file has mistakes.
    #[error("the recorded grid has mistakes")]
    Grid(Mistakes),
    /// The recorded grid file or a recorded device does not have the recorded hash.
    #[error("the recorded grid was edited after the sweep")]
    GridText,
    /// The file that lists the points of the sample has changed.
    #[error("{} has changed since the points were run", .0.as_deref().unwrap_or("its file of points"))]
    PointsFile(Option<String>),
    /// The recorded points, solver settings or parameters do not match the recorded grid file. The error
    /// contains the reason.
    #[error("the recorded {0}")]
    Changed(&'static str),
}

const POINTS: PlanError = PlanError::Changed("points are not points of the recorded grid");
const SOLVER: PlanError = PlanError::Changed("solver settings are outside the limits of a grid file");
const PARAMETERS: PlanError = PlanError::Changed("parameters are not parameters of the model");

impl Sidecar {
    /// Returns the plan from which the rows were computed. The grid of the plan may name presets of `models`.
    ///
    /// # Errors
    /// - [`PlanError::GridText`] if the recorded grid file or a recorded device was edited.
    /// - [`PlanError::Grid`] if the grid file has mistakes, for example because a different version of flap
    ///   wrote the sidecar.
    /// - [`PlanError::PointsFile`] if the file of points has changed.
    /// - [`PlanError::Changed`] if the solver settings exceed the limits of a grid file.
    /// - [`PlanError::Changed`] if the model of a response lacks a recorded parameter or option.
    /// - [`PlanError::Changed`] if the grid does not contain the recorded points.
    pub fn plan(&self, models: &[&'static dyn Simulator]) -> Result<Plan, PlanError> {
        let Identity { grid, devices, points_file, solver, .. } = &self.identity;
        if *grid != text::hash(&self.grid.text) || *devices != identity::devices(&self.devices) {
            return Err(PlanError::GridText);
        }
        let plan = grid::parse_recorded(&self.grid.name, &self.grid.text, &self.devices, models)
            .map_err(PlanError::Grid)?;
        let plan = plan.with_solver(*solver).map_err(|_| SOLVER)?;
        if plan.points_file().map(PointsFile::hash) != *points_file {
            return Err(PlanError::PointsFile(self.points_file.clone()));
        }
        let plan = match &self.followed {
            Some(followed) => self.follow(followed, plan).ok_or(PARAMETERS)?,
            None => plan,
        };
        if let Some(rerun) = &self.rerun {
            let plan = plan.with_added(rerun.added.clone()).map_err(|_| POINTS)?;
            let list = selection::read_list(&rerun.points, plan.len()).ok_or(POINTS)?;
            return plan.with_points(list).map_err(|_| POINTS);
        }
        match &self.shard {
            Some(shard) => Ok(plan.with_shard(shard.parse().map_err(|_| POINTS)?)),
            None => Ok(plan),
        }
    }

    /// Converts a plan of points into a plan of response curves, with one curve for each design.
    ///
    /// The new plan has no axis for the parameter that varies along the curves. The parameters of the new
    /// plan have the values that the sidecar records, including values from the command line.
    fn follow(&self, followed: &Followed, plan: Plan) -> Option<Plan> {
        let parameter = Parameter::index(plan.parameters(), &followed.parameter)?;
        let (mut plan, _) = plan.without_axis(parameter);
        for (name, value) in &self.parameters {
            let index = Parameter::index(plan.parameters(), name)?;
            let number = number(&plan.parameters()[index], value)?;
            if plan.base()[index].given() != Some(number) {
                plan = plan.with_parameter(index, number).ok()?;
            }
        }
        let Followed { values, tolerance, unstable, .. } = followed.clone();
        Some(plan.following(Along { parameter, values, tolerance, unstable }))
    }
}

/// Converts the value of a parameter in a sidecar, a number or the name of an option, into a number.
fn number(parameter: &Parameter, recorded: &Value) -> Option<f64> {
    match (recorded, &parameter.kind) {
        (Value::Float(number), _) => Some(*number),
        (Value::String(option), Kind::Choice(_)) => value::of_text(parameter, option, UnitOf::Text).ok(),
        _ => None,
    }
}
