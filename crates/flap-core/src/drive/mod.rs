//! The drive of a wing: a voltage that follows a waveform, or a prescribed stroke.
//!
//! A model has one [`Drive`] for all lanes of an ensemble, and [`DriveConstants`] for each point. The parameter table
//! of a model contains [`WaveformParameters`], and [`StrokeParameters`] if the stroke can be prescribed.

mod constants;
mod parameters;
mod samples;
mod variant;

pub use constants::{DriveConstants, Wave};
pub use parameters::{Shape, StrokeMode, StrokeParameters, WaveformParameters};
pub use samples::{Repeat, Samples};
pub use variant::{Drive, Waveform};
