//! The drive of a wing: a voltage that follows a waveform, or a prescribed stroke.
//!
//! All lanes have one common [`Drive`], and each point has its own [`DriveConstants`]. The parameter table of
//! a model contains [`WaveformParameters`], and [`StrokeParameters`] if the stroke can be prescribed.

mod constants;
mod parameters;
mod samples;
mod variant;

pub use constants::{DriveConstants, Wave};
pub use parameters::{Shape, StrokeMode, StrokeParameters, WaveformParameters};
pub use samples::{Repeat, Samples};
pub use variant::{Drive, Waveform};
