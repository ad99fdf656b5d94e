//! Experiments of a model behind their object-safe face; forces along a motion that is given.

use crate::drive::Samples;
use crate::model::{Motions, Signal};
use crate::modes::Mode;
use crate::simulate::{
    ChirpRequest, ChirpResponse, Experiments, ImposedMotion, ImpulseRequest, PointRun, RequestError, Runner,
    Simulator, Trajectory, Unfinished, ask, shown, trajectory_columns,
};

impl<M: Motions<N>, const N: usize> Experiments for Runner<M, N> {
    fn chirp(&self, run: &PointRun<'_>, request: &ChirpRequest) -> Result<ChirpResponse, Unfinished> {
        ask::<M, _, N>(&self.model, run, request)
    }

    fn free_response(&self, run: &PointRun<'_>, request: &ImpulseRequest) -> Result<Trajectory, Unfinished> {
        ask::<M, _, N>(&self.model, run, request)
    }

    /// Nothing to integrate: forces are evaluated at equal distances from the first sample to the last.
    fn imposed(&self, values: &[f64], motion: &ImposedMotion) -> Result<Trajectory, Unfinished> {
        let ImposedMotion { stroke, pitch, samples } = motion;
        let (duration, other) = (stroke.duration(), pitch.duration());
        if (duration - other).abs() > 1e-9 * duration {
            return Err(RequestError::Durations { stroke: duration, pitch: other }.into());
        }
        let model = self.model.variant(values);
        let constants = model.start(values)?.constants;
        let rows = (0..=*samples).map(|i| {
            let time = duration * (f64::from(i) / f64::from((*samples).max(1)));
            let (y, signals) = model.imposed(&constants, stroke.motion(time), pitch.motion(time));
            let mut row = vec![time];
            row.extend(y);
            row.extend(shown::<M::Signals>(&signals));
            row
        });
        Ok(Trajectory { columns: trajectory_columns::<M, N>(), rows: rows.collect() })
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
