//! Requests for single motions, and their results.

use crate::drive::Samples;

/// The part of a motion to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectoryRequest {
    /// Drive periods to sample.
    pub cycles: u32,
    /// Samples per drive period; the end of the last period is sampled too.
    pub samples_per_cycle: u32,
    /// Start on the settled orbit rather than at rest.
    pub settled: bool,
}

/// A sampled motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// Column names with units; the first is `time_s`.
    pub columns: Vec<String>,
    /// One row per sample, one value per column.
    pub rows: Vec<Vec<f64>>,
}

/// A drive whose frequency changes steadily, from rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChirpRequest {
    /// Frequency at the beginning (Hz).
    pub from: f64,
    /// Frequency at which the chirp ends, after a whole number of cycles (Hz).
    pub to: f64,
    /// Rate of change of the frequency (Hz/s); negative for a falling chirp.
    pub rate: f64,
    /// Samples of the motion per cycle; none if 0.
    pub samples_per_cycle: u32,
}

/// The response to a chirp.
#[derive(Clone, Debug, PartialEq)]
pub struct ChirpResponse {
    /// One row per cycle: `begin_s`, `end_s`, `frequency_hz` (cycles per second), and the signals' measures.
    pub envelope: Trajectory,
    /// The sampled motion.
    pub motion: Trajectory,
}

/// An impulse on the stroke, and the length of the motion to sample after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpulseRequest {
    /// Rate of the stroke right after the impulse (rad/s).
    pub stroke_rate: f64,
    /// Length of the sampled motion (s).
    pub duration: f64,
    /// Intervals between samples, all of the same length; both ends are sampled.
    pub intervals: u32,
}

/// A motion of the wing that is given, such as one that was filmed.
#[derive(Clone, Debug, PartialEq)]
pub struct ImposedMotion {
    /// Stroke angle (rad).
    pub stroke: Samples,
    /// Pitch angle (rad), over the same time.
    pub pitch: Samples,
    /// Intervals between the times at which forces are evaluated; both ends are evaluated.
    pub samples: u32,
}

/// A drive period.
#[derive(Clone, Debug, PartialEq)]
pub struct Period {
    /// The state at its end.
    pub end: Vec<f64>,
    /// Derivatives of the end, one vector for each component of the state at the beginning.
    pub responses: Vec<Vec<f64>>,
    /// Typical sizes of the state's components.
    pub scale: Vec<f64>,
    /// Largest modulus of the Floquet multipliers, meaningful if the period repeats.
    pub floquet_max: f64,
    /// One value per column of the model, meaningful if the period repeats.
    pub measures: Vec<f64>,
    /// Right-hand sides evaluated.
    pub rhs_evals: u64,
}
