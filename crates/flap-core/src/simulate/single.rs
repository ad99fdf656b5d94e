//! One point on scalars: the readable path, and the oracle of the lanes.

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
/// The model has N states, K = N (N + 1) states and responses, and S signals. It is the point's variant.
pub(super) trait Question<M: Model<N, S>, const N: usize, const K: usize, const S: usize> {
    type Answer;

    fn answer<R: Scalar>(self, model: &M, run: &PointRun<'_>) -> Self::Answer;
}

/// The answer to a question about the point of `run`.
pub(super) fn ask<M, Q, const N: usize, const K: usize, const S: usize>(
    model: &M,
    run: &PointRun<'_>,
    question: Q,
) -> Q::Answer
where
    M: Model<N, S>,
    Q: Question<M, N, K, S>,
{
    let model = &model.variant(run.values);
    run.backend.dispatch_scalar(Asked::<M, Q, N, K, S> { model, run, question })
}

/// A question with the point that it is about.
struct Asked<'a, M, Q, const N: usize, const K: usize, const S: usize> {
    model: &'a M,
    run: &'a PointRun<'a>,
    question: Q,
}

impl<M, Q, const N: usize, const K: usize, const S: usize> ScalarKernel for Asked<'_, M, Q, N, K, S>
where
    M: Model<N, S>,
    Q: Question<M, N, K, S>,
{
    type Output = Q::Answer;

    fn run<R: Scalar>(self) -> Q::Answer {
        self.question.answer::<R>(self.model, self.run)
    }
}
