//! Requests for the motions of single points, the results of these requests, and the reasons for incomplete
//! motions.

use crate::drive::Samples;
use crate::ode::{Ending, Interrupt};
use crate::parameter::Invalid;

/// The part of a motion to sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectoryRequest {
    /// Number of drive periods to sample.
    pub cycles: u32,
    /// Number of samples per drive period. One further sample is at the end of the last period.
    pub samples_per_cycle: u32,
    /// True to start on the settled orbit instead of at rest.
    pub settled: bool,
}

/// A sampled motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// Column names with units; the first is `time_s`.
    pub columns: Vec<String>,
    /// One row for each sample, with one value for each column.
    pub rows: Vec<Vec<f64>>,
}

/// A chirp that begins at rest. The drive frequency of a chirp changes at a constant rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChirpRequest {
    /// Frequency at the beginning (Hz).
    pub from: f64,
    /// Frequency (Hz) that the chirp must reach. The chirp ends with the cycle in which it reaches this
    /// frequency.
    pub to: f64,
    /// Rate of change of the frequency (Hz/s); negative for a falling chirp.
    pub rate: f64,
    /// Number of samples of the motion per cycle. If the number is 0, the motion is not sampled.
    pub samples_per_cycle: u32,
}

/// The response to a chirp.
#[derive(Clone, Debug, PartialEq)]
pub struct ChirpResponse {
    /// One row for each cycle of the chirp, with the columns `begin_s`, `end_s`, `frequency_hz`, and the
    /// measures of the signals. `frequency_hz` is the inverse of the duration of the cycle.
    pub envelope: Trajectory,
    /// The sampled motion.
    pub motion: Trajectory,
}

/// An impulse on the stroke, and the duration of the sampled motion after the impulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpulseRequest {
    /// Stroke rate directly after the impulse (rad/s).
    pub stroke_rate: f64,
    /// Duration of the sampled motion (s).
    pub duration: f64,
    /// Number of equal intervals between samples. The first sample is at the beginning of the motion, and the
    /// last sample is at the end.
    pub intervals: u32,
}

/// An imposed motion of the wing, for example from a video of a flapping wing.
#[derive(Clone, Debug, PartialEq)]
pub struct ImposedMotion {
    /// Stroke (rad).
    pub stroke: Samples,
    /// Pitch (rad), with the same duration as the stroke.
    pub pitch: Samples,
    /// Number of equal intervals between the times at which forces are computed. Forces are also computed at
    /// the beginning and at the end of the motion.
    pub samples: u32,
}

/// Results of the integration of one drive period.
#[derive(Clone, Debug, PartialEq)]
pub struct Period {
    /// State at the end of the period.
    pub end: Vec<f64>,
    /// Derivatives of the final state with respect to the initial state. Each vector contains the derivatives
    /// with respect to one component of the initial state.
    pub responses: Vec<Vec<f64>>,
    /// Typical size of each component of the state.
    pub scale: Vec<f64>,
    /// Largest modulus of the Floquet multipliers. The modulus is meaningful only if the final state equals
    /// the initial state.
    pub floquet_max: f64,
    /// One value for each column of the model. The values are meaningful only if the final state equals the
    /// initial state.
    pub measures: Vec<f64>,
    /// Number of evaluations of the right-hand side.
    pub rhs_evals: u64,
}

/// Reason why a motion is incomplete.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unfinished {
    /// The parameter values or the request are impossible, or the integration of the motion fails.
    #[error(transparent)]
    Invalid(#[from] Invalid),
    /// The caller interrupted the run.
    #[error("interrupted")]
    Interrupted,
}

impl Unfinished {
    /// Returns the error value for a model that computes rows but no single motions.
    pub(crate) fn no_motions(model: &str) -> Unfinished {
        Invalid::new(format!("the model {model} computes rows, but no single motions")).into()
    }

    /// Returns the error value for a model that does not support experiments.
    pub(crate) fn no_experiments(model: &str) -> Unfinished {
        let what = "chirps, impulses, imposed motions or natural frequencies";
        Invalid::new(format!("the model {model} supports no {what}")).into()
    }

    /// Returns `Ok` if the integration of a motion has ended as intended, otherwise the reason why the motion
    /// is incomplete.
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

/// Returns the error value for an initial state that does not consist of one finite number for each state of
/// the model.
pub(crate) fn cannot_begin(state: &[f64], states: usize) -> Invalid {
    Invalid::new(format!("the motion cannot begin at {state:?}: a state consists of {states} finite numbers"))
}
