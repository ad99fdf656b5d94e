//! Signals, loads and modes of a model at one state, for all models.

use flap_core::model::{ExperimentModel, Instant, Load, Model, SignalsOf};

/// A model with its constants under an input, on one side of its switching surface.
#[derive(Clone, Copy)]
pub(crate) struct Probe<'a, M: Model<4>> {
    pub(crate) model: &'a M,
    pub(crate) constants: &'a M::Constants<f64>,
    pub(crate) input: &'a M::Input<f64>,
    pub(crate) side: f64,
}

impl<M: Model<4>> Probe<'_, M> {
    /// The signals at a state with this derivative.
    pub(crate) fn signals(&self, y: &[f64; 4], dy: &[f64; 4]) -> SignalsOf<M::Signals, f64> {
        self.model.signals(self.constants, Instant { input: self.input, side: self.side, y, dy })
    }

    /// The load of the air on the wing at a state with this derivative.
    pub(crate) fn load(&self, y: &[f64; 4], dy: &[f64; 4]) -> Load<f64> {
        self.model.load(self.constants, Instant { input: self.input, side: self.side, y, dy })
    }
}

/// Natural frequencies (Hz) of both modes.
pub(crate) fn modes<M: ExperimentModel<4>>(c: &M::Constants<f64>) -> [f64; 2] {
    let modes = M::modes(c);
    [modes[0].frequency, modes[1].frequency]
}
