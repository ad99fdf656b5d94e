//! Experiments on a model: chirps, sampled waveforms, impulses and imposed motions.

use super::definition::{Instant, Model};
use super::signal::Signal;
use super::signals::SignalsOf;
use crate::drive::{Drive, DriveConstants, Samples, Waveform};
use crate::modes::Mode;

/// An imposed motion at one time: the states, the derivatives of the states, and the inputs of the model.
pub type Imposed<I, const N: usize> = ([f64; N], [f64; N], I);

/// A model for which flap can compute experiments in addition to the rows of a sweep.
pub trait ExperimentModel<const N: usize>: Model<N> {
    /// Signals whose frequencies flap reports for a free motion. The first signal in the list is the stroke,
    /// on which the impulse acts.
    const FREE_SIGNALS: &'static [Signal];

    /// Returns a copy of the model in which the function `change` has replaced the drive.
    #[must_use]
    fn with_drive(&self, change: impl FnOnce(&Drive) -> Drive) -> Self;

    /// Returns a copy of the constants `c` in which `drive` replaces the constants of the drive.
    fn with_drive_constants(c: &Self::Constants<f64>, drive: DriveConstants<f64>) -> Self::Constants<f64>;

    /// Returns the natural modes of the model, which are small motions without damping. The first mode in the
    /// list is the mode that an impulse on the stroke excites.
    fn modes(c: &Self::Constants<f64>) -> Vec<Mode>;

    /// Returns the constants of a point for a constant drive voltage. With the returned constants, all angles
    /// are zero in the rest position.
    fn resting(c: &Self::Constants<f64>) -> Self::Constants<f64>;

    /// Returns the state immediately after a torque impulse on the wing at rest. The impulse gives the stroke
    /// the rate `stroke_rate` (rad/s).
    fn struck(c: &Self::Constants<f64>, stroke_rate: f64) -> [f64; N];

    /// Returns states, derivatives and inputs of a wing with imposed stroke and pitch. `stroke` and `pitch`
    /// contain an angle (rad) and its first and second time derivatives (rad/s, rad/s²). Inputs that describe
    /// the actuator are NaN.
    fn placed(c: &Self::Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<Self::Input<f64>, N>;

    /// Returns a copy of the model whose drive has the waveform `samples`.
    #[must_use]
    fn sampled(&self, samples: Samples) -> Self {
        self.with_drive(|drive| drive.with_waveform(Waveform::Samples(samples)))
    }

    /// Returns the model and the constants for one cycle of a chirp.
    ///
    /// The cycle begins at phase zero with the frequency `frequency` (Hz). The frequency changes at the rate
    /// `rate` (Hz/s).
    fn chirped(&self, c: &Self::Constants<f64>, frequency: f64, rate: f64) -> (Self, Self::Constants<f64>) {
        let c = Self::with_drive_constants(c, Self::drive(c).chirped(frequency, rate));
        (self.with_drive(|drive| drive.with_waveform(Waveform::Chirp)), c)
    }

    /// Returns the model, the constants and the initial state of a free motion. [`ExperimentModel::struck`]
    /// computes the initial state.
    fn released(&self, c: &Self::Constants<f64>, stroke_rate: f64) -> (Self, Self::Constants<f64>, [f64; N]) {
        (self.with_drive(|_| Drive::SINE), Self::resting(c), Self::struck(c, stroke_rate))
    }

    /// Returns the state and the signals of a wing with imposed stroke and pitch. `stroke` and `pitch`
    /// contain an angle (rad) and its first and second time derivatives (rad/s, rad/s²). Signals of the
    /// actuator, such as its current, are NaN.
    fn imposed(
        &self,
        c: &Self::Constants<f64>,
        stroke: [f64; 3],
        pitch: [f64; 3],
    ) -> ([f64; N], SignalsOf<Self::Signals, f64>) {
        let (y, dy, input) = Self::placed(c, stroke, pitch);
        let prescribed = self.with_drive(|_| Drive::PRESCRIBED);
        let [direction, _] = prescribed.switch(c, &y, &dy);
        let at = Instant { input: &input, side: 1.0_f64.copysign(direction), y: &y, dy: &dy };
        (y, prescribed.signals(c, at))
    }
}
