//! Requests for single motions, their results, and the reasons for a motion that is incomplete.

use super::row::Status;
use crate::drive::Samples;
use crate::ode::{Ending, Interrupt};
use crate::parameter::Invalid;

/// The part of a motion to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectoryRequest {
    /// Drive periods to sample.
    pub cycles: u32,
    /// Samples per drive period; the end of the last period is sampled too.
    pub samples_per_cycle: u32,
    /// True to start on the settled orbit instead of at rest.
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

/// A drive from rest, whose frequency changes at a constant rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChirpRequest {
    /// Frequency at the beginning (Hz).
    pub from: f64,
    /// Frequency at which the chirp ends, after a whole number of cycles (Hz).
    pub to: f64,
    /// Rate of change of the frequency (Hz/s); negative for a falling chirp.
    pub rate: f64,
    /// Samples of the motion per cycle; 0 for none.
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

/// An impulse on the stroke, and the duration of the motion to sample after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpulseRequest {
    /// Rate of the stroke right after the impulse (rad/s).
    pub stroke_rate: f64,
    /// Duration of the sampled motion (s).
    pub duration: f64,
    /// Number of equal intervals between samples. Both ends are sampled.
    pub intervals: u32,
}

/// An imposed motion of the wing, for example from a film.
#[derive(Clone, Debug, PartialEq)]
pub struct ImposedMotion {
    /// Stroke (rad).
    pub stroke: Samples,
    /// Pitch (rad), over the same time.
    pub pitch: Samples,
    /// Number of intervals between the times at which forces are evaluated. Both ends are evaluated.
    pub samples: u32,
}

/// Result of one drive period.
#[derive(Clone, Debug, PartialEq)]
pub struct Period {
    /// State at its end.
    pub end: Vec<f64>,
    /// Derivatives of the final state, one vector for each component of the initial state.
    pub responses: Vec<Vec<f64>>,
    /// Typical sizes of the state's components.
    pub scale: Vec<f64>,
    /// Largest modulus of the Floquet multipliers. Meaningful only if the period repeats.
    pub floquet_max: f64,
    /// One value per column of the model. Meaningful only if the period repeats.
    pub measures: Vec<f64>,
    /// Number of right-hand sides evaluated.
    pub rhs_evals: u64,
}

/// Reason for an incomplete motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unfinished {
    /// The combination of parameter values is impossible.
    #[error(transparent)]
    Invalid(#[from] Invalid),
    /// The request is impossible.
    #[error(transparent)]
    Request(#[from] RequestError),
    /// A settled motion was requested, but the motion does not settle on an orbit of one drive period.
    #[error(
        "the motion does not settle on an orbit of one drive period (status {}, {cycles} cycles); sample it from rest \
         instead",
        status.name()
    )]
    NotPeriodic {
        /// Status of the point's row.
        status: Status,
        /// Number of integrated drive periods.
        cycles: u32,
    },
    /// The model computes rows alone.
    #[error("the model {model} computes rows, but no single motions")]
    NoMotions {
        /// Name of the model.
        model: &'static str,
    },
    /// The model supports no chirps, impulses, imposed motions and natural frequencies.
    #[error("the model {model} supports no chirps, impulses, imposed motions or natural frequencies")]
    NoExperiments {
        /// Name of the model.
        model: &'static str,
    },
    /// The state became infinite or NaN.
    #[error("the motion diverges")]
    Diverged,
    /// A drive period takes more than `max_steps` steps, or steps too small to advance time.
    #[error("the motion needs more than max_steps steps in a drive period")]
    StepLimit,
    /// The caller interrupted the run.
    #[error("interrupted")]
    Interrupted,
}

impl Unfinished {
    /// Returns `Ok` if a run has ended as intended.
    pub(crate) fn check(ending: Ending, interrupted: Interrupt<'_>) -> Result<(), Unfinished> {
        if interrupted() {
            return Err(Unfinished::Interrupted);
        }
        match ending {
            Ending::Stopped => Ok(()),
            Ending::Diverged => Err(Unfinished::Diverged),
            Ending::StepLimit => Err(Unfinished::StepLimit),
        }
    }
}

/// An impossible request for a motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RequestError {
    /// A frequency that is not more than zero, or falls to zero within a cycle; or a rate with the wrong sign.
    #[error(
        "a chirp from {from} Hz cannot reach {to} Hz at {rate} Hz/s: frequencies must be more than zero, and the rate \
         must have the sign of the change and be more than {} Hz/s", -0.5 * to * to
    )]
    Chirp {
        /// Frequency at the beginning (Hz).
        from: f64,
        /// Frequency at the end (Hz).
        to: f64,
        /// Rate of change of the frequency (Hz/s).
        rate: f64,
    },
    /// A stroke rate of an impulse that is zero or not finite.
    #[error("the stroke rate of an impulse must be finite and not zero, not {0} rad/s")]
    StrokeRate(f64),
    /// A duration or number of intervals that is not more than zero.
    #[error(
        "the duration and the number of intervals must be more than zero, not {duration} s and {intervals} intervals"
    )]
    Sampling {
        /// Duration of the motion (s).
        duration: f64,
        /// Number of intervals between samples.
        intervals: u32,
    },
    /// Stroke and pitch of an imposed motion with different durations.
    #[error("stroke and pitch must have the same duration, not {stroke} s and {pitch} s")]
    Durations {
        /// Duration of the stroke's record (s).
        stroke: f64,
        /// Duration of the pitch's record (s).
        pitch: f64,
    },
    /// An initial state that does not contain one finite number for each of the model's states.
    #[error("the motion cannot begin at {begin:?}: a state consists of {states} finite numbers")]
    Begin {
        /// Numbers of the initial state.
        begin: Vec<f64>,
        /// Number of the model's states.
        states: usize,
    },
}
