//! Amplitude spectrum of a sampled motion, and its peaks.

use core::f64::consts::PI;

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

/// Length of the motion with added zeros, divided by the length of the motion. The distance between bins is smaller
/// than the resolution of the spectrum by this factor.
const PADDING: usize = 8;

/// Height of the smallest peak that is returned, relative to the largest peak.
const LOWEST: f64 = 1e-3;

/// A peak of an amplitude spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumPeak {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Amplitude, in the unit of the samples, of a steady sine of this frequency over the whole window.
    pub amplitude: f64,
}

/// Amplitude spectrum of a motion that is padded with zeros to eight times its length. The window is
/// rectangular.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Distance between bins (Hz). The first bin is at 0 Hz.
    pub bin: f64,
    /// Distance between the samples (s).
    pub interval: f64,
    /// Number of samples.
    pub samples: usize,
    /// Amplitude per bin, in the unit of the samples.
    pub amplitudes: Vec<f64>,
}

impl Spectrum {
    /// Returns the spectrum of samples `interval` seconds apart.
    pub fn of(interval: f64, samples: &[f64]) -> Spectrum {
        let count = samples.len();
        let mut padded = samples.to_vec();
        padded.resize(PADDING * count, 0.0);
        let mut bins = Vec::new();
        if count > 0 {
            let transform = RealFftPlanner::new().plan_fft_forward(padded.len());
            bins = transform.make_output_vec();
            // The lengths are equal by construction, so this error does not occur.
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

    /// Returns at most `count` peaks, in falling order of height. The vertex of a parabola through three bins
    /// is the frequency and the amplitude of a peak.
    ///
    /// A finite window adds side lobes and ripples around each peak. A local maximum is a peak only if it is
    /// higher than the side lobes and ripples. The height of a local maximum is measured from the lowest
    /// amplitude between this maximum and a higher peak.
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
            // A ripple lowers the spectrum by as much as it raises it, hence the factor 2.
            if peaks.iter().all(|(higher, _)| self.height_towards(top, *higher) > 2.0 * leaked) {
                peaks.push((top, refined));
            }
        }
        peaks.into_iter().map(|(_, peak)| peak).collect()
    }

    /// Returns the height of a local maximum above the lowest amplitude between the local maximum and a higher peak.
    ///
    /// The search for the minimum ends at the next amplitude that exceeds the local maximum.
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

    /// Returns the vertex of the parabola through a local maximum and its neighbours.
    fn refined(&self, top: usize) -> SpectrumPeak {
        let [before, at, after] = [top - 1, top, top + 1].map(|i| self.amplitudes[i]);
        let slope = 0.5 * (after - before);
        let bend = before + after - 2.0 * at;
        let shift = -slope / bend;
        SpectrumPeak { frequency: self.bin * (top as f64 + shift), amplitude: at + 0.5 * slope * shift }
    }

    /// Returns the largest amplitude of the side lobes of a peak at the distance d from the frequency of the
    /// peak: A/(N sin πdΔ).
    ///
    /// A is the amplitude of the peak, N is the number of samples, and Δ is the time between samples. The
    /// peak's mirror image at negative frequencies is included.
    fn leaked(&self, peak: &SpectrumPeak, frequency: f64) -> f64 {
        let of = |distance: f64| {
            peak.amplitude / (self.samples as f64 * libm::sin(PI * distance * self.interval).abs())
        };
        of(frequency - peak.frequency) + of(frequency + peak.frequency)
    }
}
