//! Frequencies of the free motion after an impulse on the stroke.

use core::f64::consts::TAU;

use flap_core::model::Signal;
use flap_core::modes::Mode;
use flap_core::parameter::Invalid;
use flap_core::simulate::{Experiments, ImpulseRequest, PointRun, Trajectory, Unfinished};

use crate::damped_sine::{self, DampedSine};
use crate::spectrum::{Spectrum, SpectrumPeak};

/// Largest number of samples of one motion. All samples are stored in memory.
pub const INTERVALS_MAX: u32 = 5_000_000;

/// Smallest number of periods of the first mode in the motion of a spectrum. With fewer periods, the peaks are
/// wider than the distance between them.
const FEWEST_PERIODS: f64 = 3.0;

/// Largest number of peaks of a spectrum.
const PEAKS: usize = 2;

/// Settings for the analysis of a free motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeRequest {
    /// Size of the impulse: the stroke amplitude (rad) that the impulse causes in the first mode alone, without
    /// damping.
    pub amplitude: f64,
    /// Number of periods of the first mode in the fit of the damped sine.
    pub fit_cycles: u32,
    /// Duration of the motion for the spectrum (s).
    pub spectrum_window: f64,
    /// Number of samples per period of the first mode.
    pub samples_per_cycle: u32,
}

/// Frequencies of a free motion.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeMotion {
    /// Stroke rate directly after the impulse (rad/s).
    pub stroke_rate: f64,
    /// Best fit of a damped sine to the signal that the impulse excites, if a damped sine fits.
    pub fit: Option<DampedSine>,
    /// Names of the model's [free signals](Experiments::free_signals), each with the highest peaks of its
    /// spectrum.
    pub spectra: Vec<(&'static str, Vec<SpectrumPeak>)>,
}

/// Returns the stroke rate (rad/s) directly after an impulse that causes the given stroke `amplitude` (rad)
/// in the undamped first mode.
///
/// # Errors
/// [`Invalid`] if the first mode has no frequency, because a spring is missing.
pub fn stroke_rate(modes: &[Mode], amplitude: f64) -> Result<f64, Invalid> {
    let Mode { name, frequency } = first(modes)?;
    if frequency.is_finite() && frequency > 0.0 {
        return Ok(TAU * frequency * amplitude);
    }
    Err(Invalid::new(format!(
        "{name} has a frequency of {frequency} Hz, so the size of the impulse is undefined"
    )))
}

/// Returns the first mode.
///
/// # Errors
/// [`Invalid`] if the design has no natural mode.
pub fn first(modes: &[Mode]) -> Result<Mode, Invalid> {
    modes.first().copied().ok_or_else(|| Invalid::new("the model has no natural frequencies"))
}

/// Applies an impulse to the stroke of a point and computes the frequencies of the motion after the impulse.
///
/// # Errors
/// [`Unfinished`] if the run is interrupted, if the values or the request are impossible, or if the motion
/// cannot be computed.
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

    let periods = request.spectrum_window * frequency;
    if periods < FEWEST_PERIODS {
        return Err(Invalid::new(format!(
            "the spectrum window of {} s contains {periods:.3} periods of the first mode, but at least {FEWEST_PERIODS} are needed: \
             choose a window of at least {:.3e} s",
            request.spectrum_window,
            FEWEST_PERIODS / frequency
        ))
        .into());
    }
    let signals = model.free_signals();
    let (interval, motion) = sampled(f64::from(request.fit_cycles) / frequency)?;
    let fit = match signals.first() {
        Some(excited) => damped_sine::fit(interval, &column(&motion, &excited.column())?),
        None => None,
    };
    let (interval, motion) = sampled(request.spectrum_window)?;
    let spectrum = |signal: &Signal| {
        let mut samples = column(&motion, &signal.column())?;
        // The window consists of whole intervals, so the last sample belongs to the next interval.
        samples.pop();
        Ok::<_, Invalid>((signal.name, Spectrum::of(interval, &samples).peaks(PEAKS)))
    };
    Ok(FreeMotion { stroke_rate, fit, spectra: signals.iter().map(spectrum).collect::<Result<_, _>>()? })
}

/// Returns the number of intervals of a motion of `duration` (s), for at least `rate` samples per second.
///
/// # Errors
/// [`Invalid`] if the number of intervals is zero or too large.
pub fn intervals(duration: f64, rate: f64) -> Result<u32, Invalid> {
    // A product that is a whole number except for rounding counts as this number.
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

/// Returns a column of a motion.
fn column(motion: &Trajectory, name: &str) -> Result<Vec<f64>, Invalid> {
    let index = motion.columns.iter().position(|column| column == name);
    let index = index.ok_or_else(|| Invalid::new(format!("the model has no signal {name}")))?;
    Ok(motion.rows.iter().map(|row| row[index]).collect())
}
