//! Solver settings in the form that files record.

use flap_core::simulate::SolverSettings;
use serde::{Deserialize, Serialize};

/// The names under which files record [`SolverSettings`]: for `#[serde(with = "SolverFields")]`.
#[derive(Serialize, Deserialize)]
#[serde(remote = "SolverSettings")]
pub(crate) struct SolverFields {
    rtol: f64,
    atol: f64,
    settle_tol: f64,
    max_cycles: u32,
    max_steps: u32,
    #[serde(default = "default_accuracy")]
    accuracy: f64,
    newton: bool,
    /// False for results of versions that did not know it.
    #[serde(default)]
    progressive: bool,
    /// Vehicles set it for themselves.
    #[serde(skip)]
    loads: bool,
}

/// The accuracy of results whose files do not record it.
fn default_accuracy() -> f64 {
    SolverSettings::default().accuracy
}

/// Solver settings as a table of their own.
#[derive(Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct SolverTable(#[serde(with = "SolverFields")] pub(crate) SolverSettings);
