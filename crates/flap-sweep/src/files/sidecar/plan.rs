//! The plan that a sidecar records.

use flap_core::simulate::{Simulator, SolverSettings};

use super::Sidecar;
use crate::grid;
use crate::grid::diagnostic::Mistakes;
use crate::notation::text;
use crate::plan::selection::{self, Selection};
use crate::plan::{self, Plan};

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
}

impl Sidecar {
    /// The plan of these rows, with the presets of `models`.
    ///
    /// # Errors
    /// - [`PlanError::GridText`] if the grid file in it was edited
    /// - [`PlanError::Grid`] if it has mistakes: it is of another version of flap
    /// - [`PlanError::Solver`] if the solver settings are outside the limits of a grid file
    /// - [`PlanError::PointsFile`] if the file of points has changed
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
        if let Some(shard) = &self.shard {
            plan.selection = Selection::Shard(shard.parse().map_err(|_| PlanError::Points)?);
        }
        if let Some(rerun) = &self.rerun {
            let list = selection::read_list(&rerun.points, plan.len()).ok_or(PlanError::Points)?;
            plan.selection = Selection::Listed(list);
        }
        Ok(plan)
    }
}

/// True if a grid file may have these settings.
fn is_allowed(solver: &SolverSettings) -> bool {
    let tolerances = [solver.rtol, solver.atol, solver.settle_tol, solver.accuracy];
    let positive = tolerances.iter().all(|tolerance| *tolerance > 0.0);
    positive && solver.rtol < grid::LARGEST_RTOL && solver.max_cycles > 0 && solver.max_steps > 0
}
