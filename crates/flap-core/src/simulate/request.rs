//! Requests for single motions, their results, and the reasons why a motion is not followed to its end.

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

/// Reason why a motion was not followed as far as requested.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unfinished {
    /// The parameters are impossible together.
    #[error(transparent)]
    Invalid(#[from] Invalid),
    /// The request is impossible.
    #[error(transparent)]
    Request(#[from] RequestError),
    /// The motion was to begin on its orbit, and does not settle on one of one drive period.
    #[error(
        "the motion does not settle on an orbit of one drive period (status {}, {cycles} cycles); sample it from rest \
         instead",
        status.name()
    )]
    NotPeriodic {
        /// Status of the point's row.
        status: Status,
        /// Drive periods integrated.
        cycles: u32,
    },
    /// The model computes rows alone.
    #[error("the model {model} has no single motions")]
    NoMotions {
        /// Name of the model.
        model: &'static str,
    },
    /// The model knows no chirps, impulses, given motions and natural frequencies.
    #[error("the model {model} has no chirps, impulses, given motions or natural frequencies")]
    NoExperiments {
        /// Name of the model.
        model: &'static str,
    },
    /// The state became infinite or not a number.
    #[error("the motion diverges")]
    Diverged,
    /// A drive period takes more than `max_steps` steps, or steps too small to advance time.
    #[error("the motion needs more than max_steps steps in a drive period")]
    StepLimit,
    /// The caller has interrupted it.
    #[error("interrupted")]
    Interrupted,
}

impl Unfinished {
    /// `Ok` if a run has come as far as it was to come.
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

/// A request for a motion that is impossible.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RequestError {
    /// A chirp whose frequencies are not more than zero, or whose rate has not the sign of the change.
    #[error(
        "a chirp from {from} Hz cannot reach {to} Hz at {rate} Hz/s: frequencies are more than zero, and the rate has \
         the sign of the change"
    )]
    Chirp {
        /// Frequency at the beginning (Hz).
        from: f64,
        /// Frequency at the end (Hz).
        to: f64,
        /// Rate of change of the frequency (Hz/s).
        rate: f64,
    },
    /// An impulse that gives the stroke a rate of zero, or one that is not finite.
    #[error("the stroke rate of an impulse must be finite and not zero, not {0} rad/s")]
    StrokeRate(f64),
    /// No time, or no intervals, to sample.
    #[error(
        "the duration and the number of intervals must be more than zero, not {duration} s and {intervals} intervals"
    )]
    Sampling {
        /// Length of the motion (s).
        duration: f64,
        /// Intervals between samples.
        intervals: u32,
    },
    /// Stroke and pitch of a given motion that do not last equally long.
    #[error("stroke and pitch do not last equally long: {stroke} s and {pitch} s")]
    Durations {
        /// Length of the stroke's record (s).
        stroke: f64,
        /// Length of the pitch's record (s).
        pitch: f64,
    },
    /// A state to begin with that is not one finite number for each of the model's states.
    #[error("the motion cannot begin at {begin:?}: the state needs {states} finite numbers")]
    Begin {
        /// The numbers given.
        begin: Vec<f64>,
        /// Number of the model's states.
        states: usize,
    },
}
