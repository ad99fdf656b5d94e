//! Single motions of a model that contains the drive component: chirp, sampled waveform, impulse, imposed motion.

use super::definition::{Instant, Model};
use super::signal::Signal;
use super::signals::SignalsOf;
use crate::drive::{Drive, DriveConstants, Samples, Waveform};
use crate::modes::Mode;

/// An imposed motion at one time: states, their derivatives, and the inputs that go with them.
pub type Imposed<I, const N: usize> = ([f64; N], [f64; N], I);

/// A model whose single motions can be computed, besides rows.
pub trait Motions<const N: usize>: Model<N> {
    /// Signals whose frequencies describe a free motion. The first one is the signal that an impulse excites.
    const FREE_SIGNALS: &'static [Signal];

    /// Returns the model with another drive, common to all points of the variant.
    #[must_use]
    fn with_drive(&self, change: impl FnOnce(&Drive) -> Drive) -> Self;

    /// Returns the constants of a point with another drive.
    fn with_drive_constants(c: &Self::Constants<f64>, drive: DriveConstants<f64>) -> Self::Constants<f64>;

    /// Returns the small undamped motions. The first one is the motion that an impulse on the stroke excites.
    fn modes(c: &Self::Constants<f64>) -> Vec<Mode>;

    /// Returns the voltage (V) at whose rest position all angles are zero.
    fn rest_voltage(c: &Self::Constants<f64>) -> f64;

    /// Returns the state in that position right after a torque impulse that gives the stroke the rate `stroke_rate`
    /// (rad/s).
    fn struck(c: &Self::Constants<f64>, stroke_rate: f64) -> [f64; N];

    /// Returns the states of a wing with imposed stroke and pitch: value (rad), rate, second derivative. Inputs of
    /// the actuator are NaN.
    fn placed(c: &Self::Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<Self::Input<f64>, N>;

    /// Returns the model with samples as its waveform.
    #[must_use]
    fn sampled(&self, samples: Samples) -> Self {
        self.with_drive(|drive| drive.with_waveform(Waveform::Samples(samples)))
    }

    /// Returns model and constants for one cycle of a chirp.
    ///
    /// The cycle begins at phase zero and `frequency` (Hz), which changes by `rate` (Hz/s).
    fn chirped(&self, c: &Self::Constants<f64>, frequency: f64, rate: f64) -> (Self, Self::Constants<f64>) {
        let c = Self::with_drive_constants(c, Self::drive(c).chirped(frequency, rate));
        (self.with_drive(|drive| drive.with_waveform(Waveform::Chirp)), c)
    }

    /// Returns model and constants with the constant drive voltage [`Motions::rest_voltage`], and the state
    /// [`Motions::struck`].
    fn released(&self, c: &Self::Constants<f64>, stroke_rate: f64) -> (Self, Self::Constants<f64>, [f64; N]) {
        let still = Self::with_drive_constants(c, Self::drive(c).still(Self::rest_voltage(c)));
        (self.with_drive(|_| Drive::SINE), still, Self::struck(c, stroke_rate))
    }

    /// Returns state and signals of a wing with imposed stroke and pitch: value (rad), rate, second derivative.
    /// Signals of the actuator are NaN.
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
