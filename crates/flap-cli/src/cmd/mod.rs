//! Commands, one module each, and the code that they share.

pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod describe;
pub(crate) mod explain;
pub(crate) mod far;
mod gradient;
mod grid;
mod impulse;
pub(crate) mod lift;
mod listed;
#[cfg(feature = "live")]
pub(crate) mod live;
mod look;
pub(crate) mod man;
pub(crate) mod merge;
pub(crate) mod models;
mod motion;
pub(crate) mod new;
pub(crate) mod outputs;
pub(crate) mod params;
mod point;
pub(crate) mod rerun;
pub(crate) mod resonance;
pub(crate) mod respond;
pub(crate) mod resume;
pub(crate) mod run;
mod samples;
pub(crate) mod schema;
mod shown;
pub(crate) mod sweep;
pub(crate) mod top;
pub(crate) mod track;
pub(crate) mod vehicle;
pub(crate) mod verify;
pub(crate) mod wing;
