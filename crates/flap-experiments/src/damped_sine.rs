//! Least-squares fit of a damped sine A e^{−λt} sin(2πft + p) to a sampled motion.

use core::f64::consts::{PI, TAU};

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DVector, Dyn, OMatrix, U4, Vector4};

/// A damped sine A e^{−λt} sin(2πft + p), and the quality of its fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DampedSine {
    /// Amplitude A at the first sample, positive, in the unit of the samples.
    pub amplitude: f64,
    /// Decay λ (1/s).
    pub decay: f64,
    /// Frequency f (Hz).
    pub frequency: f64,
    /// Phase p at the first sample (rad), from −π to π.
    pub phase: f64,
    /// Root mean square of the fit's residual, relative to the root mean square of the samples.
    pub relative_rms: f64,
}

/// Returns the best fit of a damped sine to samples `interval` seconds apart.
///
/// Returns `None` if the samples cross zero fewer than three times, or if the fit does not converge.
pub fn fit(interval: f64, samples: &[f64]) -> Option<DampedSine> {
    let size = samples.iter().fold(0.0_f64, |size, sample| size.max(sample.abs()));
    let crossings = Crossings::of(samples)?;
    // With times in half periods and samples in units of the largest one, all parameters are about one.
    let half_period = crossings.half_period;
    let problem = Problem {
        times: (0..samples.len()).map(|i| i as f64 / half_period).collect(),
        samples: samples.iter().map(|sample| sample / size).collect(),
        parameters: Vector4::new(0.0, 0.0, PI, crossings.decay_per_half_period),
    };
    let (fitted, report) = LevenbergMarquardt::new().minimize(problem.with_best_factors());
    let found = report.termination.was_successful() || report.termination.was_usage_issue();
    let [sine, cosine, rate, decay] = fitted.parameters.into();
    if !found || !fitted.parameters.iter().all(|parameter| parameter.is_finite()) || rate == 0.0 {
        return None;
    }
    // A negative rate is equivalent to a positive one with the sign of the sine changed.
    let sine = sine.copysign(sine * rate);
    let seconds = half_period * interval;
    let square = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
    Some(DampedSine {
        amplitude: size * libm::hypot(sine, cosine),
        decay: decay / seconds,
        frequency: rate.abs() / (TAU * seconds),
        phase: libm::atan2(cosine, sine),
        relative_rms: (square(&fitted.left_over()) / square(&fitted.samples)).sqrt(),
    })
}

/// Zero crossings of samples, for the initial values of a fit.
struct Crossings {
    /// Mean number of samples between successive crossings.
    half_period: f64,
    /// Mean logarithm of the ratio of successive extrema.
    decay_per_half_period: f64,
}

impl Crossings {
    fn of(samples: &[f64]) -> Option<Crossings> {
        let mut crossings: Vec<f64> = Vec::new();
        // The largest magnitude after each crossing.
        let mut extremes: Vec<f64> = Vec::new();
        for (i, pair) in samples.windows(2).enumerate() {
            let [before, after] = [pair[0], pair[1]];
            if (before < 0.0) != (after < 0.0) {
                crossings.push(i as f64 + before / (before - after));
                extremes.push(0.0);
            }
            if let Some(extreme) = extremes.last_mut() {
                *extreme = after.abs().max(*extreme);
            }
        }
        let [first, .., last] = crossings[..] else { return None };
        // The extremum after the last crossing is unknown, because the end may cut it off.
        let whole = crossings.len() - 1;
        if whole < 2 {
            return None;
        }
        let decay = libm::log(extremes[0] / extremes[whole - 1]) / (whole - 1) as f64;
        Some(Crossings { half_period: (last - first) / whole as f64, decay_per_half_period: decay })
    }
}

/// Least-squares problem of e^{−λt} (a sin ωt + b cos ωt), with the parameters [a, b, ω, λ].
struct Problem {
    times: Vec<f64>,
    samples: Vec<f64>,
    parameters: Vector4<f64>,
}

impl Problem {
    /// Returns the problem in which a and b have their best values for the current ω and λ.
    fn with_best_factors(mut self) -> Problem {
        // Normal equations of the two linear parameters.
        let (mut ss, mut sc, mut cc, mut sx, mut cx) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (&time, &sample) in self.times.iter().zip(&self.samples) {
            let [sine, cosine] = self.waves(time);
            ss += sine * sine;
            sc += sine * cosine;
            cc += cosine * cosine;
            sx += sine * sample;
            cx += cosine * sample;
        }
        let determinant = ss * cc - sc * sc;
        self.parameters[0] = (cc * sx - sc * cx) / determinant;
        self.parameters[1] = (ss * cx - sc * sx) / determinant;
        self
    }

    /// Returns e^{−λt} sin ωt and e^{−λt} cos ωt.
    fn waves(&self, time: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(self.parameters[2] * time);
        let envelope = libm::exp(-self.parameters[3] * time);
        [envelope * sin, envelope * cos]
    }

    /// Returns the residual of the fit at each sample.
    fn left_over(&self) -> Vec<f64> {
        let [a, b] = [self.parameters[0], self.parameters[1]];
        let left = |(&time, &sample): (&f64, &f64)| {
            let [sine, cosine] = self.waves(time);
            a * sine + b * cosine - sample
        };
        self.times.iter().zip(&self.samples).map(left).collect()
    }
}

impl LeastSquaresProblem<f64, Dyn, U4> for Problem {
    type ParameterStorage = Owned<f64, U4>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, U4>;

    fn set_params(&mut self, parameters: &Vector4<f64>) {
        self.parameters = *parameters;
    }

    fn params(&self) -> Vector4<f64> {
        self.parameters
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        Some(DVector::from_vec(self.left_over()))
    }

    fn jacobian(&self) -> Option<OMatrix<f64, Dyn, U4>> {
        let [a, b] = [self.parameters[0], self.parameters[1]];
        let mut jacobian = OMatrix::<f64, Dyn, U4>::zeros(self.times.len());
        for (i, &time) in self.times.iter().enumerate() {
            let [sine, cosine] = self.waves(time);
            jacobian[(i, 0)] = sine;
            jacobian[(i, 1)] = cosine;
            jacobian[(i, 2)] = time * (a * cosine - b * sine);
            jacobian[(i, 3)] = -time * (a * sine + b * cosine);
        }
        Some(jacobian)
    }
}
