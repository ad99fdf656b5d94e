//! Experiments of a model behind their object-safe face.

use super::imposed;
use crate::drive::Samples;
use crate::model::{Motions, Signal};
use crate::modes::Mode;
use crate::simulate::{
    ChirpRequest, ChirpResponse, Experiments, ImposedMotion, ImpulseRequest, PointRun, Runner, Simulator,
    Trajectory, Unfinished, ask,
};

impl<M: Motions<N>, const N: usize> Experiments for Runner<M, N> {
    fn chirp(&self, run: &PointRun<'_>, request: &ChirpRequest) -> Result<ChirpResponse, Unfinished> {
        ask::<M, _, N>(&self.model, run, request)
    }

    fn free_response(&self, run: &PointRun<'_>, request: &ImpulseRequest) -> Result<Trajectory, Unfinished> {
        ask::<M, _, N>(&self.model, run, request)
    }

    fn imposed(&self, values: &[f64], motion: &ImposedMotion) -> Result<Trajectory, Unfinished> {
        imposed::follow(&self.model, values, motion)
    }

    fn modes(&self, values: &[f64]) -> Result<Vec<Mode>, Unfinished> {
        let model = self.model.variant(values);
        Ok(M::modes(&model.start(values)?.constants))
    }

    fn free_signals(&self) -> &'static [Signal] {
        M::FREE_SIGNALS
    }

    fn with_samples(&self, samples: Samples) -> Box<dyn Simulator> {
        Box::new(Runner::<M, N>::with_experiments(self.model.sampled(samples)))
    }
}
