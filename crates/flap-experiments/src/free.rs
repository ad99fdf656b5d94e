//! The frequencies of the free motion after an impulse on the stroke.

use core::f64::consts::TAU;

use flap_core::model::Signal;
use flap_core::modes::Mode;
use flap_core::parameter::Invalid;
use flap_core::simulate::{Experiments, ImpulseRequest, PointRun, Trajectory, Unfinished};

use crate::damped_sine::{self, DampedSine};
use crate::spectrum::{Spectrum, SpectrumPeak};

/// The most samples of one motion: they are held in memory.
pub const INTERVALS_MAX: u32 = 5_000_000;

/// Peaks looked for in a spectrum.
const PEAKS: usize = 2;

/// Settings of an examination of the free motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeRequest {
    /// The impulse, as the amplitude (rad) to be reached by a stroke of the first mode alone, undamped.
    pub amplitude: f64,
    /// Periods of the first mode that the damped sine is fitted to.
    pub fit_cycles: u32,
    /// Length of the motion whose spectrum is taken (s).
    pub spectrum_window: f64,
    /// Samples per period of the first mode.
    pub samples_per_cycle: u32,
}

/// The frequencies of a free motion.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeMotion {
    /// Rate of the stroke right after the impulse (rad/s).
    pub stroke_rate: f64,
    /// The damped sine that fits the signal that the impulse excites best, if there is one.
    pub fit: Option<DampedSine>,
    /// The highest peaks of the spectra of the model's [free signals](Experiments::free_signals), with the signals' names.
    pub spectra: Vec<(&'static str, Vec<SpectrumPeak>)>,
}

/// The rate (rad/s) that an impulse gives the stroke, from the amplitude (rad) of the first mode alone, undamped.
///
/// # Errors
/// [`Invalid`] if the first mode does not swing: without a spring there is no frequency.
pub fn stroke_rate(modes: &[Mode], amplitude: f64) -> Result<f64, Invalid> {
    let Mode { name, frequency } = first(modes)?;
    if frequency.is_finite() && frequency > 0.0 {
        return Ok(TAU * frequency * amplitude);
    }
    Err(Invalid::new(format!(
        "{name} has a frequency of {frequency} Hz, which an impulse cannot be sized by"
    )))
}

/// The first mode.
///
/// # Errors
/// [`Invalid`] if there is none.
pub fn first(modes: &[Mode]) -> Result<Mode, Invalid> {
    modes.first().copied().ok_or_else(|| Invalid::new("the model has no natural frequencies"))
}

/// Gives a point's stroke an impulse and looks for the frequencies of the motion that follows.
///
/// # Errors
/// [`Unfinished`] if it is interrupted, the values are impossible together, the request is, or the motion fails on the
/// way.
pub fn examine(
    model: &dyn Experiments,
    run: &PointRun<'_>,
    request: &FreeRequest,
) -> Result<FreeMotion, Unfinished> {
    let modes = model.modes(run.values)?;
    let stroke_rate = stroke_rate(&modes, request.amplitude)?;
    let frequency = first(&modes)?.frequency;
    let sampled = |duration: f64| {
        let intervals = intervals(duration, frequency * f64::from(request.samples_per_cycle))?;
        let impulse = ImpulseRequest { stroke_rate, duration, intervals };
        let motion = model.free_response(run, &impulse)?;
        Ok::<_, Unfinished>((duration / f64::from(intervals), motion))
    };

    let signals = model.free_signals();
    let (interval, motion) = sampled(f64::from(request.fit_cycles) / frequency)?;
    let fit = match signals.first() {
        Some(excited) => damped_sine::fit(interval, &column(&motion, &excited.column())?),
        None => None,
    };
    let (interval, motion) = sampled(request.spectrum_window)?;
    let spectrum = |signal: &Signal| {
        let mut samples = column(&motion, &signal.column())?;
        // The window holds whole intervals: its last sample is the first of the next.
        samples.pop();
        Ok::<_, Invalid>((signal.name, Spectrum::of(interval, &samples).peaks(PEAKS)))
    };
    Ok(FreeMotion { stroke_rate, fit, spectra: signals.iter().map(spectrum).collect::<Result<_, _>>()? })
}

/// The number of intervals into which a motion of `duration` (s) is cut, for at least `rate` samples per second.
///
/// # Errors
/// [`Invalid`] if there is nothing to cut, or it gives too many.
pub fn intervals(duration: f64, rate: f64) -> Result<u32, Invalid> {
    // A product that is a whole number but for rounding is that number.
    let intervals = (duration * rate * (1.0 - 1e-12)).ceil();
    if intervals >= 1.0 && intervals <= f64::from(INTERVALS_MAX) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "just checked")]
        return Ok(intervals as u32);
    }
    Err(Invalid::new(format!(
        "a motion of {duration} s with {rate} samples per second cannot be sampled: it takes 1 to {INTERVALS_MAX} \
         samples"
    )))
}

/// A column of a motion.
fn column(motion: &Trajectory, name: &str) -> Result<Vec<f64>, Invalid> {
    let index = motion.columns.iter().position(|column| column == name);
    let index = index.ok_or_else(|| Invalid::new(format!("the model has no signal {name}")))?;
    Ok(motion.rows.iter().map(|row| row[index]).collect())
}
