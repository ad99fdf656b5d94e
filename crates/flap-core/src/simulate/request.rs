//! Requests for single motions, their results, and the reasons for a motion that is incomplete.

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
    /// The motion or the request is impossible, or the motion fails.
    #[error(transparent)]
    Invalid(#[from] Invalid),
    /// The caller interrupted the run.
    #[error("interrupted")]
    Interrupted,
}

impl Unfinished {
    /// Returns the error of a model that computes rows alone.
    pub(crate) fn no_motions(model: &str) -> Unfinished {
        Invalid::new(format!("the model {model} computes rows, but no single motions")).into()
    }

    /// Returns the error of a model without experiments.
    pub(crate) fn no_experiments(model: &str) -> Unfinished {
        let what = "chirps, impulses, imposed motions or natural frequencies";
        Invalid::new(format!("the model {model} supports no {what}")).into()
    }

    /// Returns `Ok` if a run has ended as intended.
    pub(crate) fn check(ending: Ending, interrupted: Interrupt<'_>) -> Result<(), Unfinished> {
        if interrupted() {
            return Err(Unfinished::Interrupted);
        }
        match ending {
            Ending::Stopped => Ok(()),
            Ending::Diverged => Err(Invalid::new("the motion diverges").into()),
            Ending::StepLimit => {
                Err(Invalid::new("the motion needs more than max_steps steps in a drive period").into())
            }
        }
    }
}

/// Returns the error of an initial state that is not one finite number for each state of the model.
pub(crate) fn cannot_begin(state: &[f64], states: usize) -> Invalid {
    Invalid::new(format!("the motion cannot begin at {state:?}: a state consists of {states} finite numbers"))
}
