//! Experiments on a model: chirps, sampled waveforms, impulses and imposed motions.

use super::definition::{Instant, Model};
use super::signal::Signal;
use super::signals::SignalsOf;
use crate::drive::{Drive, DriveConstants, Samples, Waveform};
use crate::modes::Mode;

/// An imposed motion at one time: the states, the derivatives of the states, and the inputs of the model.
pub type Imposed<I, const N: usize> = ([f64; N], [f64; N], I);

/// A model that computes experiments in addition to rows.
pub trait ExperimentModel<const N: usize>: Model<N> {
    /// Signals whose frequencies describe a free motion. The first signal in the list is the signal that an impulse
    /// excites.
    const FREE_SIGNALS: &'static [Signal];

    /// Returns the model with another drive for all points of the variant.
    #[must_use]
    fn with_drive(&self, change: impl FnOnce(&Drive) -> Drive) -> Self;

    /// Returns the constants of a point with another drive.
    fn with_drive_constants(c: &Self::Constants<f64>, drive: DriveConstants<f64>) -> Self::Constants<f64>;

    /// Returns the small undamped motions of the model. The first motion in the list is the motion that an impulse on
    /// the stroke excites.
    fn modes(c: &Self::Constants<f64>) -> Vec<Mode>;

    /// Returns the constants with the constant drive voltage at which all angles are zero in the rest position.
    fn resting(c: &Self::Constants<f64>) -> Self::Constants<f64>;

    /// Returns the state immediately after a torque impulse in the rest position, at which the stroke has the rate
    /// `stroke_rate` (rad/s).
    fn struck(c: &Self::Constants<f64>, stroke_rate: f64) -> [f64; N];

    /// Returns the states of a wing with imposed stroke and pitch. `stroke` and `pitch` contain value (rad), rate
    /// (rad/s) and second derivative (rad/s²). The inputs of the actuator are NaN.
    fn placed(c: &Self::Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<Self::Input<f64>, N>;

    /// Returns the model with the given samples as the waveform of its drive.
    #[must_use]
    fn sampled(&self, samples: Samples) -> Self {
        self.with_drive(|drive| drive.with_waveform(Waveform::Samples(samples)))
    }

    /// Returns the model and the constants for one cycle of a chirp.
    ///
    /// The cycle begins at phase zero with `frequency` (Hz), and the frequency changes by `rate` (Hz/s).
    fn chirped(&self, c: &Self::Constants<f64>, frequency: f64, rate: f64) -> (Self, Self::Constants<f64>) {
        let c = Self::with_drive_constants(c, Self::drive(c).chirped(frequency, rate));
        (self.with_drive(|drive| drive.with_waveform(Waveform::Chirp)), c)
    }

    /// Returns the model and the constants of a free motion. The third result is the state [`ExperimentModel::struck`].
    fn released(&self, c: &Self::Constants<f64>, stroke_rate: f64) -> (Self, Self::Constants<f64>, [f64; N]) {
        (self.with_drive(|_| Drive::SINE), Self::resting(c), Self::struck(c, stroke_rate))
    }

    /// Returns the state and the signals of a wing with imposed stroke and pitch. `stroke` and `pitch` contain value
    /// (rad), rate (rad/s) and second derivative (rad/s²). Signals of the actuator are NaN.
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
