//! One point on scalars: the readable path, and the oracle of the lanes.

use super::begin::begin;
use super::lanes::run_alone;
use super::row::{Row, Status};
use super::search::settle;
use super::settings::SolverSettings;
use crate::model::Model;
use crate::num::{Backend, Scalar, ScalarKernel};
use crate::ode::{Interrupt, never};

/// The run of a single point on scalars.
#[derive(Clone, Copy)]
pub struct PointRun<'a> {
    /// The backend in whose arithmetic class the point is followed.
    pub backend: Backend,
    /// Solver settings.
    pub solver: &'a SolverSettings,
    /// One value per parameter of the model.
    pub values: &'a [f64],
    /// Ends the run early.
    pub interrupted: Interrupt<'a>,
}

impl<'a> PointRun<'a> {
    /// A run that nothing interrupts.
    pub fn new(backend: Backend, solver: &'a SolverSettings, values: &'a [f64]) -> PointRun<'a> {
        PointRun { backend, solver, values, interrupted: &never }
    }

    /// The same run, which ends early once `interrupted` says so.
    #[must_use]
    pub fn until(self, interrupted: Interrupt<'a>) -> PointRun<'a> {
        PointRun { interrupted, ..self }
    }
}

/// A question about one point, answered in either arithmetic of scalars.
///
/// The model has N states. It is the point's variant.
pub(crate) trait Question<M: Model<N>, const N: usize> {
    type Answer;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Self::Answer;
}

/// The answer to a question about the point of `run`.
pub(crate) fn ask<M, Q, const N: usize>(model: &M, run: &PointRun<'_>, question: Q) -> Q::Answer
where
    M: Model<N>,
    Q: Question<M, N>,
{
    let model = &model.variant(run.values);
    run.backend.dispatch_scalar(Asked::<M, Q, N> { model, run, question })
}

/// A question with the point that it is about.
struct Asked<'a, M, Q, const N: usize> {
    model: &'a M,
    run: &'a PointRun<'a>,
    question: Q,
}

impl<M, Q, const N: usize> ScalarKernel for Asked<'_, M, Q, N>
where
    M: Model<N>,
    Q: Question<M, N>,
{
    type Output = Q::Answer;

    fn run<R: Scalar>(self) -> Q::Answer {
        self.question.answer::<R>(self.model, self.run)
    }
}

/// The row of a point from this state, or from rest. Interrupted, the row means nothing.
pub(super) struct RowFrom<'a>(pub(super) Option<&'a [f64]>);

impl<M: Model<N>, const N: usize> Question<M, N> for RowFrom<'_> {
    type Answer = Row;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Row {
        let PointRun { solver, values, interrupted, .. } = *run;
        let start = match begin(model, values, self.0) {
            Ok(start) => start,
            Err(error) => return Row::invalid(error),
        };
        let settled = run_alone::<_, R, _, _, N>(model, solver, &start, interrupted, |exchange| {
            settle(model, solver, start, self.0.is_some(), exchange)
        });
        settled.map_or_else(|| Row::empty(Status::Unsettled), |settled| settled.row)
    }
}
