//! Single motions of a model that contains the drive component: chirped, sampled, released, imposed.

use super::definition::{Instant, Model};
use super::signal::Signal;
use super::signals::SignalsOf;
use crate::drive::{Drive, DriveConstants, Samples, Waveform};
use crate::modes::Mode;

/// A motion that is given: states, their derivatives, and the inputs that go with them.
pub type Imposed<I, const N: usize> = ([f64; N], [f64; N], I);

/// A model of which single motions are followed, not only rows computed.
pub trait Motions<const N: usize>: Model<N> {
    /// The signals whose frequencies describe a free motion; first the one that an impulse excites.
    const FREE_SIGNALS: &'static [Signal];

    /// The model with another drive, common to all points of the variant.
    #[must_use]
    fn with_drive(&self, change: impl FnOnce(&Drive) -> Drive) -> Self;

    /// The constants of a point with another drive.
    fn with_drive_constants(c: &Self::Constants<f64>, drive: DriveConstants<f64>) -> Self::Constants<f64>;

    /// Small undamped motions; first the one that an impulse on the stroke is to excite.
    fn modes(c: &Self::Constants<f64>) -> Vec<Mode>;

    /// The voltage (V) in whose rest position all angles are zero.
    fn rest_voltage(c: &Self::Constants<f64>) -> f64;

    /// The state in that position right after a torque impulse on the stroke that gives it `stroke_rate` (rad/s).
    fn struck(c: &Self::Constants<f64>, stroke_rate: f64) -> [f64; N];

    /// The states of a wing whose stroke and pitch are given: value (rad), rate, second derivative. Inputs of the
    /// actuator are not numbers.
    fn placed(c: &Self::Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> Imposed<Self::Input<f64>, N>;

    /// The model with samples for a waveform.
    #[must_use]
    fn sampled(&self, samples: Samples) -> Self {
        self.with_drive(|drive| drive.with_waveform(Waveform::Samples(samples)))
    }

    /// The model and constants for one cycle of a chirp, which begins at `frequency` (Hz) and phase zero and
    /// changes by `rate` (Hz/s).
    fn chirped(&self, c: &Self::Constants<f64>, frequency: f64, rate: f64) -> (Self, Self::Constants<f64>) {
        let c = Self::with_drive_constants(c, Self::drive(c).chirped(frequency, rate));
        (self.with_drive(|drive| drive.with_waveform(Waveform::Chirp)), c)
    }

    /// The model and constants with the drive held still at [`Motions::rest_voltage`], and the state
    /// [`Motions::struck`].
    fn released(&self, c: &Self::Constants<f64>, stroke_rate: f64) -> (Self, Self::Constants<f64>, [f64; N]) {
        let still = Self::with_drive_constants(c, Self::drive(c).still(Self::rest_voltage(c)));
        (self.with_drive(|_| Drive::SINE), still, Self::struck(c, stroke_rate))
    }

    /// State and signals of a wing whose stroke and pitch are given: value (rad), rate, second derivative. Signals of
    /// the actuator are not numbers.
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
