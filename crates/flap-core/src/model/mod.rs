//! The papers' models: parameters in SI units → constants of a point → equations of motion → signals.
//!
//! Each paper has a folder of its own. What a model is made of:
//!
//! - a parameter struct with its table ([`crate::parameters!`]) and the published presets,
//! - constants derived from the parameters once per point ([`crate::per_lane!`]),
//! - equations of motion ([`Ode`]) and the signals to be measured, written once for scalars and lanes.

mod balance;
pub mod bimorph;
mod convert;
pub mod direct_drive;
pub mod four_bar;
mod signal;

pub use balance::{Balance, on_stroke, on_stroke_rates};
pub use signal::{Derived, Measure, Signal, SignalCycle};

use crate::drive::Samples;
use crate::modes::Mode;
use crate::num::Lanes;
use crate::ode::{Ode, Start};
use crate::parameter::{Invalid, Parameter, Preset};

/// A periodically driven model with N states, of which S signals are measured over a drive period.
pub trait Model<const N: usize, const S: usize>: Ode<N> + PartialEq + Sized {
    /// Name in grid files, such as `direct-drive`.
    const NAME: &'static str;
    /// One line: what it models, and the paper.
    const DOC: &'static str;
    /// The parameter table.
    const PARAMETERS: &'static [Parameter];
    /// The published parameter sets.
    const PRESETS: &'static [Preset];
    /// Names of the states with their units, as trajectory columns.
    const STATES: [&'static str; N];
    /// What is measured.
    const SIGNALS: [Signal; S];
    /// The measures whose error stands for a row's: stroke, pitch, lift, power. Each is a position in
    /// [`Model::SIGNALS`], and what is measured of it.
    const PRINCIPAL: &'static [(usize, Measure)];
    /// Columns computed from the measured cycle.
    const DERIVED: &'static [Derived];

    /// The model for a point: what its equations do differently for all lanes alike, such as the shape of the
    /// drive. Points of equal variants share lanes.
    fn variant(&self, values: &[f64]) -> Self;

    /// The run of a point, given one value per parameter: constants, initial state, drive period, scales.
    ///
    /// # Errors
    /// [`Invalid`] if the parameters are impossible together.
    fn start(&self, values: &[f64]) -> Result<Start<Self::Constants<f64>, N>, Invalid>;

    /// The model and constants for one cycle of a chirp, which begins at `frequency` (Hz) and phase zero and
    /// changes by `rate` (Hz/s).
    fn chirped(&self, c: &Self::Constants<f64>, frequency: f64, rate: f64) -> (Self, Self::Constants<f64>);

    /// Phase of the drive (rad) at time `t` within a period.
    fn drive_phase<R: Lanes>(&self, c: &Self::Constants<R>, t: R) -> R;

    /// The signals at a state `y` with derivative `dy`, on one `side` of the switching surface, in SI units.
    fn signals<R: Lanes>(
        &self,
        c: &Self::Constants<R>,
        u: &Self::Input<R>,
        side: R,
        y: &[R; N],
        dy: &[R; N],
    ) -> [R; S];

    /// Into how many parts each step is divided to find the largest and smallest values of the signals: more than one where
    /// signals follow the drive faster than the motion does, whose steps these are.
    #[inline(always)]
    fn parts(&self) -> u32 {
        1
    }

    /// State and signals of a wing whose stroke and pitch are given: value (rad), rate, second derivative. Signals of
    /// the actuator are not numbers.
    fn imposed(&self, c: &Self::Constants<f64>, stroke: [f64; 3], pitch: [f64; 3]) -> ([f64; N], [f64; S]);

    /// The model with samples for a waveform.
    fn sampled(&self, samples: Samples) -> Self;

    /// Replaces the means that are small differences of large flows by what they equal on a periodic orbit: the mean
    /// electrical power by the sum of what is dissipated.
    ///
    /// Capacitance, springs and inertia take energy and give it back. In a motion of small losses, or far from
    /// resonance, the quadrature's error in what they exchange may exceed the mean.
    fn on_orbit(&self, cycle: &mut [SignalCycle; S]);

    /// How far the mean electrical power by current times voltage is from the one that [`Model::on_orbit`] has put in its
    /// place, relative to that.
    fn audit(&self, cycle: &[SignalCycle; S]) -> f64;

    /// The values of the [`Model::DERIVED`] columns for a periodic orbit, after [`Model::on_orbit`].
    fn derived(&self, c: &Self::Constants<f64>, cycle: &[SignalCycle; S]) -> Vec<f64>;

    /// Small undamped motions; first the one that an impulse on the stroke is to excite.
    fn modes(&self, c: &Self::Constants<f64>) -> [Mode; 2];

    /// The model and constants with the drive held still at the voltage in whose rest position all angles are zero, and
    /// the state in that position right after a torque impulse on the stroke that gives it `stroke_rate` (rad/s).
    fn released(&self, c: &Self::Constants<f64>, stroke_rate: f64) -> (Self, Self::Constants<f64>, [f64; N]);
}
