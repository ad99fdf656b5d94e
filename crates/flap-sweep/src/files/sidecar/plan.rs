//! The plan that a sidecar records.

use flap_core::parameter::{Kind, Parameter};
use flap_core::simulate::{Simulator, SolverSettings};
use toml::Value;

use super::{Followed, Sidecar};
use crate::grid;
use crate::grid::diagnostic::Mistakes;
use crate::notation::text;
use crate::plan::selection::{self, Selection};
use crate::plan::{self, Along, Plan};

/// A sidecar without a plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The grid file in it has mistakes for this version of flap.
    #[error("the grid in it has mistakes")]
    Grid(Mistakes),
    /// The grid file in it has another hash than the one that was run.
    #[error("the grid in it is not the one that was run: it was edited")]
    GridText,
    /// The points in it are not points of the grid.
    #[error("its points are not points of its grid")]
    Points,
    /// The solver settings in it are outside the limits of a grid file.
    #[error("its solver settings are not ones that a grid may have")]
    Solver,
    /// The file of points has changed.
    #[error("{} no longer holds the points that were run", path.as_deref().unwrap_or("its file of points"))]
    PointsFile {
        /// The file, if the sidecar names one.
        path: Option<String>,
    },
    /// The model has no parameter or no option of a name in it.
    #[error("its parameters are not those of its model")]
    Parameters,
}

impl Sidecar {
    /// The plan of these rows, with the presets of `models`.
    ///
    /// # Errors
    /// - [`PlanError::GridText`] if the grid file in it was edited
    /// - [`PlanError::Grid`] if it has mistakes: it is of another version of flap
    /// - [`PlanError::Solver`] if the solver settings are outside the limits of a grid file
    /// - [`PlanError::PointsFile`] if the file of points has changed
    /// - [`PlanError::Parameters`] if the model of a response has no parameter or no option of a name in it
    /// - [`PlanError::Points`] if the points that were run are not points of the grid
    pub fn plan(&self, models: &[&'static dyn Simulator]) -> Result<Plan, PlanError> {
        if self.grid.xxh3 != text::hash(&self.grid.text) {
            return Err(PlanError::GridText);
        }
        let mut plan = grid::parse(&self.grid.name, &self.grid.text, models).map_err(PlanError::Grid)?;
        if !is_allowed(&self.solver) {
            return Err(PlanError::Solver);
        }
        plan.solver = self.solver;
        let points_file = self.points_file.as_ref();
        if plan.points_file.as_ref().map(plan::PointsFile::hash) != points_file.map(|file| file.xxh3.clone())
        {
            return Err(PlanError::PointsFile { path: points_file.map(|file| file.path.clone()) });
        }
        if let Some(followed) = &self.followed {
            plan.followed = Some(self.follow(followed, &mut plan).ok_or(PlanError::Parameters)?);
        }
        if let Some(shard) = &self.shard {
            plan.selection = Selection::Shard(shard.parse().map_err(|_| PlanError::Points)?);
        }
        if let Some(rerun) = &self.rerun {
            let list = selection::read_list(&rerun.points, plan.len()).ok_or(PlanError::Points)?;
            plan.selection = Selection::Listed(list);
        }
        Ok(plan)
    }

    /// The parameter that is followed. Its axis is taken out of `plan`, which gets the parameters of the command line.
    fn follow(&self, followed: &Followed, plan: &mut Plan) -> Option<Along> {
        let parameters = plan.parameters();
        let place = |name: &str| parameters.iter().position(|parameter| parameter.name == name);
        let parameter = place(&followed.parameter)?;
        for (name, value) in &self.parameters {
            let index = place(name)?;
            plan.base[index] = number(&parameters[index], value)?;
        }
        plan.take_axis(parameter);
        let Followed { values, tolerance, unstable, .. } = followed.clone();
        Some(Along { parameter, values, tolerance, unstable })
    }
}

/// The value of a parameter in a sidecar: a number, or the name of an option.
fn number(parameter: &Parameter, value: &Value) -> Option<f64> {
    match (value, &parameter.kind) {
        (Value::Float(number), _) => Some(*number),
        (Value::String(option), Kind::Choice(options)) => {
            (0_u32..).zip(*options).find(|(_, known)| *known == option).map(|(index, _)| f64::from(index))
        }
        _ => None,
    }
}

/// True if a grid file may have these settings.
fn is_allowed(solver: &SolverSettings) -> bool {
    let tolerances = [solver.rtol, solver.atol, solver.settle_tol, solver.accuracy];
    let positive = tolerances.iter().all(|tolerance| *tolerance > 0.0);
    positive && solver.rtol < grid::LARGEST_RTOL && solver.max_cycles > 0 && solver.max_steps > 0
}
