//! A model behind the object-safe faces [`Simulator`], [`Motions`] and [`Experiments`].

use std::sync::OnceLock;

use super::column::{Column, columns};
use super::error::Unfinished;
use super::imposed;
use super::jobs::Jobs;
use super::lanes::LanesKernel;
use super::period::PeriodFrom;
use super::request::{
    ChirpRequest, ChirpResponse, ImposedMotion, ImpulseRequest, Period, Trajectory, TrajectoryRequest,
};
use super::row::Row;
use super::settings::SolverSettings;
use super::settle::RowFrom;
use super::simulator::{Experiments, Motions, Rows, Simulator};
use super::single::{Question, Single};
use crate::drive::Samples;
use crate::model::{self, Model};
use crate::modes::Mode;
use crate::num::InstructionSet;
use crate::ode::{Interrupt, never};
use crate::parameter::{Parameter, Preset};

/// A model with N states, K = N (N + 1) states and responses to their changes, and S signals.
pub(super) struct Runner<M, const N: usize, const K: usize, const S: usize> {
    model: M,
    columns: OnceLock<Vec<Column>>,
    experiments: fn(&Self) -> Option<&dyn Experiments>,
}

impl<M: model::Motions<N, S>, const N: usize, const K: usize, const S: usize> Runner<M, N, K, S> {
    /// The faces of a model that knows experiments too. Does not compile unless K is N (N + 1).
    pub(super) const fn with_experiments(model: M) -> Self {
        const { Self::CHECKED }
        Runner { model, columns: OnceLock::new(), experiments: |runner| Some(runner) }
    }
}

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Runner<M, N, K, S> {
    /// Compiles if K is right.
    const CHECKED: () = assert!(K == N * (N + 1), "K counts states and responses: it is N (N + 1)");

    /// The faces of a model: rows and motions. Does not compile unless K is N (N + 1).
    pub(super) const fn new(model: M) -> Self {
        const { Self::CHECKED }
        Runner { model, columns: OnceLock::new(), experiments: |_| None }
    }

    /// The answer to a question about one point, on scalars.
    fn ask<Q: Question<M, N, K, S>>(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        question: Q,
        interrupted: Interrupt<'_>,
    ) -> Q::Answer {
        let model = &self.model.variant(values);
        Single { model, solver, values, interrupted }.ask(set, question)
    }
}

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Rows for Runner<M, N, K, S> {
    fn columns(&self) -> &[Column] {
        self.columns.get_or_init(columns::<M, N, S>)
    }

    fn run(&self, set: InstructionSet, solver: &SolverSettings, jobs: &mut dyn Jobs) {
        set.dispatch(LanesKernel::<M, N, K, S> { model: &self.model, solver, jobs });
    }

    fn run_point(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        begin: Option<&[f64]>,
    ) -> Row {
        self.ask(set, solver, values, RowFrom(begin), &never)
    }
}

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Simulator for Runner<M, N, K, S> {
    fn name(&self) -> &'static str {
        M::DESCRIPTION.name
    }

    fn doc(&self) -> &'static str {
        M::DESCRIPTION.doc
    }

    fn parameters(&self) -> &'static [Parameter] {
        M::DESCRIPTION.parameters
    }

    fn presets(&self) -> &'static [Preset] {
        M::DESCRIPTION.presets
    }

    fn row(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        interrupted: Interrupt<'_>,
    ) -> Result<Row, Unfinished> {
        let row = self.ask(set, solver, values, RowFrom(None), interrupted);
        if interrupted() { Err(Unfinished::Interrupted) } else { Ok(row) }
    }

    fn motions(&self) -> Result<&dyn Motions, Unfinished> {
        Ok(self)
    }

    fn experiments(&self) -> Result<&dyn Experiments, Unfinished> {
        (self.experiments)(self).ok_or(Unfinished::NoExperiments { model: self.name() })
    }
}

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Motions for Runner<M, N, K, S> {
    fn period(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        begin: &[f64],
        interrupted: Interrupt<'_>,
    ) -> Result<Period, Unfinished> {
        self.ask(set, solver, values, PeriodFrom(begin), interrupted)
    }

    fn trajectory(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        request: &TrajectoryRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<Trajectory, Unfinished> {
        self.ask(set, solver, values, request, interrupted)
    }
}

impl<M: model::Motions<N, S>, const N: usize, const K: usize, const S: usize> Experiments
    for Runner<M, N, K, S>
{
    fn chirp(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        request: &ChirpRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<ChirpResponse, Unfinished> {
        self.ask(set, solver, values, request, interrupted)
    }

    fn free_response(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        request: &ImpulseRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<Trajectory, Unfinished> {
        self.ask(set, solver, values, request, interrupted)
    }

    fn imposed(&self, values: &[f64], motion: &ImposedMotion) -> Result<Trajectory, Unfinished> {
        imposed::follow(&self.model, values, motion)
    }

    fn modes(&self, values: &[f64]) -> Result<[Mode; 2], Unfinished> {
        let model = self.model.variant(values);
        Ok(M::modes(&model.start(values)?.constants))
    }

    fn with_samples(&self, samples: Samples) -> Box<dyn Simulator> {
        Box::new(Runner::<M, N, K, S>::with_experiments(self.model.sampled(samples)))
    }
}
