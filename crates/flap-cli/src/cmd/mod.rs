//! One module per command.

pub(crate) mod check;
pub(crate) mod lift;
pub(crate) mod models;
mod motion_file;
pub(crate) mod params;
pub(crate) mod run;
pub(crate) mod sweep;
pub(crate) mod track;
