//! The commands of flap: one module for each command, and modules that several commands use.

pub(crate) mod check;
pub(crate) mod describe;
mod deviations;
pub(crate) mod device;
pub(crate) mod generate;
mod gradient;
mod grid;
#[cfg(feature = "live")]
pub(crate) mod live;
mod look;
pub(crate) mod models;
mod motion;
pub(crate) mod optimise;
pub(crate) mod outputs;
mod point;
pub(crate) mod respond;
pub(crate) mod results;
pub(crate) mod run;
mod samples;
mod shown;
pub(crate) mod sweep;
pub(crate) mod test;
pub(crate) mod top;
pub(crate) mod vehicle;
