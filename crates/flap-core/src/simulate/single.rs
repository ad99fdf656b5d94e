//! One point on scalars: the readable path, and the oracle of the lanes.

use super::settings::SolverSettings;
use crate::model::Model;
use crate::num::{Arithmetic, InstructionSet, Scalar, Unfused};
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
    /// The answer to `question`, in the arithmetic class of `set`.
    pub(super) fn ask<Q, const N: usize, const K: usize, const S: usize>(
        &self,
        set: InstructionSet,
        question: Q,
    ) -> Q::Answer
    where
        M: Model<N, S>,
        Q: Question<M, N, K, S>,
    {
        match set.arithmetic() {
            Arithmetic::Fused => question.answer::<f64>(self),
            Arithmetic::Unfused => question.answer::<Unfused>(self),
        }
    }
}
