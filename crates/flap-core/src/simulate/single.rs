//! One point on scalars: the readable path, and the oracle of the lanes.

use super::settings::SolverSettings;
use crate::model::Model;
use crate::num::{Backend, Scalar, ScalarKernel};
use crate::ode::Interrupt;

/// One point that is followed on scalars.
#[derive(Clone, Copy)]
pub(super) struct Single<'a, M> {
    /// The model's variant for this point.
    pub(super) model: &'a M,
    pub(super) solver: &'a SolverSettings,
    pub(super) values: &'a [f64],
    pub(super) interrupted: Interrupt<'a>,
}

/// A question about one point, answered in either arithmetic of scalars.
///
/// The model has N states, K = N (N + 1) states and responses, and S signals.
pub(super) trait Question<M: Model<N, S>, const N: usize, const K: usize, const S: usize> {
    type Answer;

    fn answer<R: Scalar>(self, point: &Single<'_, M>) -> Self::Answer;
}

impl<M> Single<'_, M> {
    /// The answer to `question`, in the arithmetic of `backend`.
    pub(super) fn ask<Q, const N: usize, const K: usize, const S: usize>(
        &self,
        backend: Backend,
        question: Q,
    ) -> Q::Answer
    where
        M: Model<N, S>,
        Q: Question<M, N, K, S>,
    {
        backend.dispatch_scalar(Asked::<M, Q, N, K, S> { point: self, question })
    }
}

/// A question with the point that it is about.
struct Asked<'p, 'a, M, Q, const N: usize, const K: usize, const S: usize> {
    point: &'p Single<'a, M>,
    question: Q,
}

impl<M, Q, const N: usize, const K: usize, const S: usize> ScalarKernel for Asked<'_, '_, M, Q, N, K, S>
where
    M: Model<N, S>,
    Q: Question<M, N, K, S>,
{
    type Output = Q::Answer;

    fn run<R: Scalar>(self) -> Q::Answer {
        self.question.answer::<R>(self.point)
    }
}
