//! The frequencies of the free motion after an impulse on the stroke.

use core::f64::consts::TAU;

use crate::measure::damped_sine::{self, DampedSine};
use crate::measure::spectrum::{Spectrum, SpectrumPeak};
use crate::modes::Mode;
use crate::parameter::Invalid;
use crate::simulate::{Experiments, ImpulseRequest, PointRun, Trajectory, Unfinished};

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
    /// The damped sine that fits the stroke (rad) best, if there is one.
    pub fit: Option<DampedSine>,
    /// The highest peaks of the stroke's spectrum (deg).
    pub stroke_peaks: Vec<SpectrumPeak>,
    /// The highest peaks of the pitch's spectrum (deg).
    pub pitch_peaks: Vec<SpectrumPeak>,
}

/// The rate (rad/s) that an impulse gives the stroke, from the amplitude (rad) of the first mode alone, undamped.
///
/// # Errors
/// [`Invalid`] if the first mode does not swing: without a spring there is no frequency.
pub fn stroke_rate(modes: &[Mode; 2], amplitude: f64) -> Result<f64, Invalid> {
    let Mode { name, frequency } = modes[0];
    if frequency.is_finite() && frequency > 0.0 {
        return Ok(TAU * frequency * amplitude);
    }
    Err(Invalid::new(format!(
        "{name} has a frequency of {frequency} Hz, which an impulse cannot be sized by"
    )))
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
    let frequency = modes[0].frequency;
    let sampled = |duration: f64| {
        let intervals = intervals(duration, frequency * f64::from(request.samples_per_cycle))?;
        let impulse = ImpulseRequest { stroke_rate, duration, intervals };
        let motion = model.free_response(run, &impulse)?;
        Ok::<_, Unfinished>((duration / f64::from(intervals), motion))
    };

    let (interval, motion) = sampled(f64::from(request.fit_cycles) / frequency)?;
    let fit = damped_sine::fit(interval, &column(&motion, "stroke_deg")?)
        .map(|fit| DampedSine { amplitude: fit.amplitude.to_radians(), ..fit });
    let (interval, motion) = sampled(request.spectrum_window)?;
    let peaks = |name: &str| {
        let mut samples = column(&motion, name)?;
        // The window holds whole intervals: its last sample is the first of the next.
        samples.pop();
        Ok::<_, Invalid>(Spectrum::of(interval, &samples).peaks(PEAKS))
    };
    Ok(FreeMotion { stroke_rate, fit, stroke_peaks: peaks("stroke_deg")?, pitch_peaks: peaks("pitch_deg")? })
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
