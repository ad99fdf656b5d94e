//! The drive of a wing: a voltage that follows a waveform, or a prescribed stroke.
//!
//! A model has a [`Drive`], common to the lanes of an ensemble, and [`DriveConstants`] of each point. Its parameter table
//! contains [`WaveformParameters`], and [`StrokeParameters`] if its stroke can be prescribed.

mod constants;
mod parameters;
mod samples;
mod variant;

pub use constants::{DriveConstants, Wave};
pub use parameters::{Shape, StrokeMode, StrokeParameters, WaveformParameters};
pub use samples::{Repeat, Samples, SamplesError};
pub use variant::{Drive, Waveform};
