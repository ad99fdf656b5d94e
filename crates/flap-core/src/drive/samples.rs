//! Waveforms and motions that are given as samples. A cubic spline interpolates between the samples.

use core::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::Complex;

use crate::num::Real;
use crate::parameter::Invalid;

/// Smallest number of samples that a record may have.
const FEWEST: usize = 4;

/// Limit for the magnitude of a first harmonic, as a fraction of the record's range. If the magnitude of the
/// first harmonic is below the limit, the record counts as a record without a first harmonic.
const NO_HARMONIC: f64 = 1e-9;

/// Continuation of a record after its last sample: the record repeats or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeat {
    /// The record repeats: its last sample is also the first sample of the next period.
    Periodic,
    /// The record ends at its last sample.
    Once,
}

/// A record of samples, as a smooth function of the phase. The phase is 0 at the first sample and 1 at the
/// last sample.
///
/// The function is a cubic spline: value, rate and second derivative are continuous, and the second
/// derivative is linear between samples. Clones of a record share the memory of the samples. The operator
/// `==` returns true only for a record and its clones, even if two separate records contain equal samples.
#[derive(Clone, Debug)]
pub struct Samples(Arc<Record>);

#[derive(Debug)]
struct Record {
    /// Time from the first to the last sample (s).
    duration: f64,
    phases: Vec<f64>,
    values: Vec<f64>,
    /// Mean value of the spline, from the first to the last sample.
    mean: f64,
    /// Phase (rad) of the first harmonic of the spline, relative to a cosine. The phase is NaN if the spline
    /// has no first harmonic.
    first_phase: f64,
    /// Smallest and largest value of the spline, including values between the samples.
    range: [f64; 2],
    /// Second derivative of the spline with respect to phase, at each sample.
    bends: Vec<f64>,
}

impl PartialEq for Samples {
    fn eq(&self, other: &Samples) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Samples {
    /// Returns the record of the samples `values` at the `times` (s).
    ///
    /// The last value of a periodic record may differ from the first value by at most a thousandth of the
    /// record's range. flap replaces the last value of a periodic record by the first value.
    ///
    /// # Errors
    /// An error in these cases:
    ///
    /// - There are fewer than four samples.
    /// - A time or value is not finite.
    /// - Times do not increase.
    /// - The first and the last value of a periodic record differ by more than a thousandth of the record's
    ///   range.
    pub fn new(times: &[f64], values: &[f64], repeat: Repeat) -> Result<Samples, Invalid> {
        let count = times.len().min(values.len());
        if count < FEWEST {
            return Err(Invalid::new(format!("{count} samples are too few: a record has at least {FEWEST}")));
        }
        if let Some(i) = (0..count).find(|&i| !(times[i].is_finite() && values[i].is_finite())) {
            return Err(Invalid::new(format!("sample {} is not a number", i + 1)));
        }
        if let Some(i) = (1..count).find(|&i| times[i] <= times[i - 1]) {
            let (sample, time, before) = (i + 1, times[i], times[i - 1]);
            return Err(Invalid::new(format!(
                "times do not increase: sample {sample} is at {time} s, the sample before at {before} s"
            )));
        }
        let duration = times[count - 1] - times[0];
        let phases: Vec<f64> = times[..count].iter().map(|time| (time - times[0]) / duration).collect();
        let mut values = values[..count].to_vec();
        let bends = match repeat {
            Repeat::Once => bends(&phases, &values),
            Repeat::Periodic => {
                check_closed(&values)?;
                values[count - 1] = values[0];
                periodic_bends(&phases, &values)
            }
        };
        let mean = mean(&phases, &values, &bends);
        let range = spline_range(&phases, &values, &bends);
        let first_phase = first_phase(&phases, &bends, range);
        Ok(Samples(Arc::new(Record { duration, phases, values, mean, first_phase, range, bends })))
    }

    /// Returns the time from the first to the last sample (s).
    pub fn duration(&self) -> f64 {
        self.0.duration
    }

    /// Returns the mean value of the spline, from the first to the last sample.
    #[inline(always)]
    pub(super) fn mean(&self) -> f64 {
        self.0.mean
    }

    /// Returns the phase (rad) of the first harmonic of a periodic record, relative to a cosine. The phase is NaN if the
    /// record has no first harmonic.
    pub(super) fn first_phase(&self) -> f64 {
        self.0.first_phase
    }

    /// Returns the value of the spline at a phase, and the first and second derivatives with respect to
    /// phase.
    #[inline(always)]
    pub(super) fn at<R: Real>(&self, phase: R) -> [R; 3] {
        self.0.at(phase)
    }

    /// Returns the value of the spline at `time` (s) after the first sample, and the first and second
    /// derivatives with respect to time (1/s, 1/s²).
    pub fn motion(&self, time: f64) -> [f64; 3] {
        let duration = self.0.duration;
        let [value, rate, bend] = self.0.at(time / duration);
        [value, rate / duration, bend / (duration * duration)]
    }

    /// Returns the smallest and the largest value of the spline, including values between the samples.
    pub fn range(&self) -> [f64; 2] {
        self.0.range
    }

    /// Returns the smallest and the largest value of the samples.
    pub fn sample_range(&self) -> [f64; 2] {
        range(&self.0.values)
    }
}

impl Record {
    /// Returns the value of the spline at a phase, and the first and second derivatives with respect to
    /// phase.
    ///
    /// The formula contains no fused multiply-add, so the results on all processors are identical.
    #[inline(always)]
    fn at<R: Real>(&self, phase: R) -> [R; 3] {
        let piece = phase.look_up(|phase| self.piece(phase));
        let [begin, end, from, to, bend_from, bend_to] = piece;
        let width = end - begin;
        let (a, b) = ((end - phase) / width, (phase - begin) / width);
        let six = width.lit(6.0);
        [
            a * from
                + b * to
                + ((a * a * a - a) * bend_from + (b * b * b - b) * bend_to) * (width * width / six),
            (to - from) / width
                + ((b * 3.0 * b - 1.0) * bend_to - (a * 3.0 * a - 1.0) * bend_from) * (width / six),
            a * bend_from + b * bend_to,
        ]
    }

    /// Returns phases, values and second derivatives of the two samples around a phase.
    fn piece(&self, phase: f64) -> [f64; 6] {
        let after = self.phases.partition_point(|&knot| knot <= phase).clamp(1, self.phases.len() - 1);
        let (i, j) = (after - 1, after);
        let Record { phases, values, bends, .. } = self;
        [phases[i], phases[j], values[i], values[j], bends[i], bends[j]]
    }
}

/// Returns the mean of a cubic spline over phases from 0 to 1.
fn mean(phases: &[f64], values: &[f64], bends: &[f64]) -> f64 {
    let pieces = (1..phases.len()).map(|i| {
        let width = phases[i] - phases[i - 1];
        0.5 * width * (values[i] + values[i - 1]) - width * width * width / 24.0 * (bends[i] + bends[i - 1])
    });
    pieces.sum()
}

/// Returns the phase (rad) of the first harmonic of a periodic cubic spline s(p), relative to a cosine.
///
/// After integration by parts, the integral contains only the third derivative of the spline, which is
/// constant between two samples:
///
/// ```text
/// ∫ s e^(−2πip) dp = −(2π)⁻⁴ Σ s‴ (e^(−2πi p_end) − e^(−2πi p_begin))
/// ```
fn first_phase(phases: &[f64], bends: &[f64], [low, high]: [f64; 2]) -> f64 {
    let pieces = (1..phases.len()).map(|i| {
        let slope = (bends[i] - bends[i - 1]) / (phases[i] - phases[i - 1]);
        let [end, begin] = [i, i - 1].map(|i| Complex::cis(-TAU * phases[i]));
        (begin - end) * slope
    });
    let first = pieces.sum::<Complex<f64>>() / TAU.powi(4);
    if first.norm() > NO_HARMONIC * (high - low) { first.arg() } else { f64::NAN }
}

/// Returns the smallest and the largest value of a cubic spline.
fn spline_range(phases: &[f64], values: &[f64], bends: &[f64]) -> [f64; 2] {
    let extremes = (1..phases.len()).flat_map(|i| {
        let width = phases[i] - phases[i - 1];
        let (from, to) = (values[i - 1], values[i]);
        let [bend_from, bend_to] = [bends[i - 1], bends[i]].map(|bend| bend * width * width / 6.0);
        // With b from 0 to 1 in the piece, the slope is square b² + linear b + constant.
        let square = 3.0 * (bend_to - bend_from);
        let linear = 6.0 * bend_from;
        let constant = to - from - bend_to - 2.0 * bend_from;
        // Both roots without cancellation; a root that does not exist is not finite, or not within the piece.
        let sum = -0.5 * (linear + (linear * linear - 4.0 * square * constant).sqrt().copysign(linear));
        [sum / square, constant / sum].into_iter().filter(|b| (0.0..1.0).contains(b)).map(move |b| {
            let a = 1.0 - b;
            a * from + b * to + (a * a * a - a) * bend_from + (b * b * b - b) * bend_to
        })
    });
    let [low, high] = range(values);
    extremes.fold([low, high], |[low, high], value| [low.min(value), high.max(value)])
}

/// Returns the smallest and the largest of `values`.
fn range(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| [low.min(v), high.max(v)])
}

fn check_closed(values: &[f64]) -> Result<(), Invalid> {
    let [low, high] = range(values);
    let (first, last) = (values[0], values[values.len() - 1]);
    if (last - first).abs() <= 1e-3 * (high - low) {
        return Ok(());
    }
    Err(Invalid::new(format!(
        "the first and last value of a periodic record must be equal, not {first} and {last}"
    )))
}

/// Returns the tridiagonal equations for the second derivatives of a spline at the inner samples.
///
/// The four arrays are the lower, the middle and the upper diagonal of the matrix, and the right-hand side of the
/// equations.
fn equations(x: &[f64], y: &[f64]) -> [Vec<f64>; 4] {
    let mut rows: [Vec<f64>; 4] = Default::default();
    for i in 1..x.len() - 1 {
        let (before, after) = (x[i] - x[i - 1], x[i + 1] - x[i]);
        rows[0].push(before / 6.0);
        rows[1].push((before + after) / 3.0);
        rows[2].push(after / 6.0);
        rows[3].push((y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before);
    }
    rows
}

/// Returns the second derivatives of a "not-a-knot" spline at the samples.
///
/// The third derivative of a "not-a-knot" spline is continuous at the second sample and at the second-to-last
/// sample.
fn bends(x: &[f64], y: &[f64]) -> Vec<f64> {
    let [lower, mut middle, upper, right] = equations(x, y);
    let n = middle.len();
    // The second derivatives at the ends are extrapolated from the two nearest samples and substituted into the
    // equations.
    let (first, second) = (x[1] - x[0], x[2] - x[1]);
    let (last, before) = (x[n + 1] - x[n], x[n] - x[n - 1]);
    let (start, end) = (first / second, last / before);
    let (mut lower_in, mut upper_in) = (lower.clone(), upper.clone());
    middle[0] += lower[0] * (1.0 + start);
    upper_in[0] -= lower[0] * start;
    middle[n - 1] += upper[n - 1] * (1.0 + end);
    lower_in[n - 1] -= upper[n - 1] * end;
    let inner = tridiagonal(&lower_in, &middle, &upper_in, &right);
    let mut bends = vec![inner[0] + start * (inner[0] - inner[1])];
    bends.extend(&inner);
    bends.push(inner[n - 1] + end * (inner[n - 1] - inner[n - 2]));
    bends
}

/// Returns the second derivatives of a periodic spline at the samples. The first and the last sample are the
/// same point of the period.
fn periodic_bends(x: &[f64], y: &[f64]) -> Vec<f64> {
    let [lower, middle, upper, right] = equations(x, y);
    let n = middle.len();
    let (first, last) = (x[1] - x[0], x[n + 1] - x[n]);
    let slope = (y[1] - y[0]) / first - (y[n + 1] - y[n]) / last;
    // The unknown s at the seam of the period enters the equations of its two neighbours: bends = plain + s · unit.
    let mut coupling = vec![0.0; n];
    coupling[0] -= lower[0];
    coupling[n - 1] -= upper[n - 1];
    let plain = tridiagonal(&lower, &middle, &upper, &right);
    let unit = tridiagonal(&lower, &middle, &upper, &coupling);
    let seam = (slope - first / 6.0 * plain[0] - last / 6.0 * plain[n - 1])
        / ((first + last) / 3.0 + first / 6.0 * unit[0] + last / 6.0 * unit[n - 1]);
    let mut bends = vec![seam];
    bends.extend(plain.iter().zip(&unit).map(|(plain, unit)| plain + seam * unit));
    bends.push(seam);
    bends
}

/// Returns the solution of a tridiagonal system (Thomas algorithm). `lower[0]` and the last entry of `upper` are not
/// used.
fn tridiagonal(lower: &[f64], middle: &[f64], upper: &[f64], right: &[f64]) -> Vec<f64> {
    let n = middle.len();
    let mut factor = vec![0.0; n];
    let mut solution = vec![0.0; n];
    let mut pivot = middle[0];
    solution[0] = right[0] / pivot;
    for i in 1..n {
        factor[i] = upper[i - 1] / pivot;
        pivot = middle[i] - lower[i] * factor[i];
        solution[i] = (right[i] - lower[i] * solution[i - 1]) / pivot;
    }
    for i in (0..n - 1).rev() {
        solution[i] -= factor[i + 1] * solution[i + 1];
    }
    solution
}
