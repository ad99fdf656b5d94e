//! The amplitude spectrum of a sampled motion, and its peaks.

use core::f64::consts::PI;

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

/// Zeros appended, in lengths of the motion less one: bins are this many times closer than the motion can resolve.
const PADDING: usize = 8;

/// Peaks lower than this share of the largest are not looked for.
const LOWEST: f64 = 1e-3;

/// A peak of an amplitude spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumPeak {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Amplitude, in the unit of the samples: that of a steady sine of this frequency which fills the window.
    pub amplitude: f64,
}

/// The amplitude spectrum of a motion, through a rectangular window and padded with zeros to eight times its length.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Distance between bins (Hz); the first is at 0 Hz.
    pub bin: f64,
    /// Distance between the samples (s).
    pub interval: f64,
    /// Number of samples.
    pub samples: usize,
    /// Amplitude per bin, in the unit of the samples.
    pub amplitudes: Vec<f64>,
}

impl Spectrum {
    /// The spectrum of samples `interval` seconds apart.
    pub fn of(interval: f64, samples: &[f64]) -> Spectrum {
        let count = samples.len();
        let mut padded = samples.to_vec();
        padded.resize(PADDING * count, 0.0);
        let mut bins = Vec::new();
        if count > 0 {
            let transform = RealFftPlanner::new().plan_fft_forward(padded.len());
            bins = transform.make_output_vec();
            // The lengths fit each other by construction.
            if transform.process(&mut padded, &mut bins).is_err() {
                bins.clear();
            }
        }
        let factor = 2.0 / count as f64;
        let amplitude = |bin: &Complex<f64>| factor * libm::hypot(bin.re, bin.im);
        Spectrum {
            bin: 1.0 / (interval * padded.len() as f64),
            interval,
            samples: count,
            amplitudes: bins.iter().map(amplitude).collect(),
        }
    }

    /// The highest peaks, at most `count`, the highest first, each refined by the parabola through the bins around it.
    ///
    /// A window that cuts a motion short surrounds each peak with side lobes and ripples. A top is a peak only if it stands
    /// out from the ground towards each higher peak by more than these can.
    pub fn peaks(&self, count: usize) -> Vec<SpectrumPeak> {
        let largest = self.amplitudes.iter().fold(0.0_f64, |largest, amplitude| largest.max(*amplitude));
        let tops = self.amplitudes.windows(3).enumerate();
        let tops = tops.filter(|(_, a)| a[0] < a[1] && a[1] >= a[2] && a[1] > LOWEST * largest);
        let mut tops: Vec<usize> = tops.map(|(i, _)| i + 1).collect();
        tops.sort_by(|one, other| self.amplitudes[*other].total_cmp(&self.amplitudes[*one]));

        let mut peaks: Vec<(usize, SpectrumPeak)> = Vec::new();
        for top in tops {
            if peaks.len() == count {
                break;
            }
            let refined = self.refined(top);
            let leaked: f64 = peaks.iter().map(|(_, peak)| self.leaked(peak, refined.frequency)).sum();
            // A ripple goes down by as much as it goes up.
            if peaks.iter().all(|(higher, _)| self.height_towards(top, *higher) > 2.0 * leaked) {
                peaks.push((top, refined));
            }
        }
        peaks.into_iter().map(|(_, peak)| peak).collect()
    }

    /// The height of a top above the lowest ground between it and the next higher amplitude, in the direction of a higher
    /// peak.
    fn height_towards(&self, top: usize, higher: usize) -> f64 {
        let height = self.amplitudes[top];
        let lowest = |ground: &mut dyn Iterator<Item = &f64>| {
            ground.take_while(|amplitude| **amplitude <= height).fold(height, |low, a| low.min(*a))
        };
        let lowest = if higher > top {
            lowest(&mut self.amplitudes[top..higher].iter())
        } else {
            lowest(&mut self.amplitudes[higher..top].iter().rev())
        };
        height - lowest
    }

    /// The vertex of the parabola through a top and its neighbours.
    fn refined(&self, top: usize) -> SpectrumPeak {
        let [before, at, after] = [top - 1, top, top + 1].map(|i| self.amplitudes[i]);
        let slope = 0.5 * (after - before);
        let bend = before + after - 2.0 * at;
        let shift = -slope / bend;
        SpectrumPeak { frequency: self.bin * (top as f64 + shift), amplitude: at + 0.5 * slope * shift }
    }

    /// The largest amplitude that a peak of amplitude A can add at a distance d in frequency: A/(N sin πdΔ) for N samples
    /// at distances Δ, and the same for its mirror image at negative frequencies.
    fn leaked(&self, peak: &SpectrumPeak, frequency: f64) -> f64 {
        let of = |distance: f64| {
            peak.amplitude / (self.samples as f64 * libm::sin(PI * distance * self.interval).abs())
        };
        of(frequency - peak.frequency) + of(frequency + peak.frequency)
    }
}
