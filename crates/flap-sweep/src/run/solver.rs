//! Solver settings in the form that files record.

use flap_core::simulate::SolverSettings;
use serde::{Deserialize, Serialize};

/// The names under which files record [`SolverSettings`]: for `#[serde(with = "SolverFields")]`.
#[derive(Serialize, Deserialize)]
#[serde(remote = "SolverSettings")]
#[expect(clippy::struct_excessive_bools, reason = "each is a setting of its own")]
pub(crate) struct SolverFields {
    rtol: f64,
    atol: f64,
    settle_tol: f64,
    max_cycles: u32,
    max_steps: u32,
    accuracy: f64,
    newton: bool,
    progressive: bool,
    symmetry: bool,
    /// Vehicles set it for themselves.
    #[serde(skip)]
    loads: bool,
}

/// Solver settings as a table of their own.
#[derive(Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct SolverTable(#[serde(with = "SolverFields")] pub(crate) SolverSettings);
