//! One module per command.

pub(crate) mod check;
pub(crate) mod models;
pub(crate) mod params;
pub(crate) mod run;
pub(crate) mod sweep;
