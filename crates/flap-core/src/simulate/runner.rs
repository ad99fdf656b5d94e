//! A model behind the object-safe [`Simulator`].

use std::sync::OnceLock;

use super::lanes::{LanesKernel, Sized};
use super::scalar::Scalars;
use super::simulator::{
    ChirpRequest, ChirpResponse, Column, ImposedMotion, ImpulseRequest, Jobs, Period, Row, Rows, Simulator,
    SolverSettings, Trajectory, TrajectoryRequest, Unfinished,
};
use super::{imposed, row};
use crate::drive::Samples;
use crate::model::{Model, Motions};
use crate::modes::Mode;
use crate::num::InstructionSet;
use crate::ode::{Interrupt, never};
use crate::parameter::{Invalid, Parameter, Preset};

/// A model with N states, K = N (N + 1) states and responses, and S signals.
pub(super) struct Runner<M, const N: usize, const K: usize, const S: usize> {
    model: M,
    columns: OnceLock<Vec<Column>>,
}

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Runner<M, N, K, S> {
    pub(super) const fn new(model: M) -> Self {
        Runner { model, columns: OnceLock::new() }
    }
}

impl<M: Model<N, S>, const N: usize, const K: usize, const S: usize> Rows for Runner<M, N, K, S> {
    fn columns(&self) -> &[Column] {
        self.columns.get_or_init(row::columns::<M, N, S>)
    }

    fn run(&self, set: InstructionSet, solver: &SolverSettings, jobs: &mut dyn Jobs) {
        set.dispatch(Sized::<_, N, K, S>(LanesKernel { model: &self.model, solver, jobs }));
    }

    fn run_point(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        begin: Option<&[f64]>,
    ) -> Row {
        Scalars { model: &self.model, solver, values }.row::<N, K, S>(set, begin, &never)
    }
}

impl<M: Motions<N, S>, const N: usize, const K: usize, const S: usize> Simulator for Runner<M, N, K, S> {
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
        let row = Scalars { model: &self.model, solver, values }.row::<N, K, S>(set, None, interrupted);
        if interrupted() { Err(Unfinished::Interrupted) } else { Ok(row) }
    }

    fn period(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        begin: &[f64],
        interrupted: Interrupt<'_>,
    ) -> Result<Period, Unfinished> {
        Scalars { model: &self.model, solver, values }.period::<N, K, S>(set, begin, interrupted)
    }

    fn trajectory(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        request: &TrajectoryRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<Trajectory, Unfinished> {
        Scalars { model: &self.model, solver, values }.trajectory::<N, K, S>(set, request, interrupted)
    }

    fn chirp(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        request: &ChirpRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<ChirpResponse, Unfinished> {
        Scalars { model: &self.model, solver, values }.chirp::<N, S>(set, request, interrupted)
    }

    fn imposed(&self, values: &[f64], motion: &ImposedMotion) -> Result<Trajectory, Invalid> {
        imposed::follow::<M, N, S>(&self.model, values, motion)
    }

    fn with_samples(&self, samples: Samples) -> Box<dyn Simulator> {
        Box::new(Runner::<M, N, K, S>::new(self.model.sampled(samples)))
    }

    fn modes(&self, values: &[f64]) -> Result<[Mode; 2], Invalid> {
        let model = self.model.variant(values);
        Ok(M::modes(&model.start(values)?.constants))
    }

    fn free_response(
        &self,
        set: InstructionSet,
        solver: &SolverSettings,
        values: &[f64],
        request: &ImpulseRequest,
        interrupted: Interrupt<'_>,
    ) -> Result<Trajectory, Unfinished> {
        Scalars { model: &self.model, solver, values }.free_response::<N, S>(set, request, interrupted)
    }
}
