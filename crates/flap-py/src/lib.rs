//! Native part of the `flapwing` Python package.
//!
//! Python values become plain ones at the edge, in [`parameters`] and [`solver`]; rows become dictionaries in
//! [`run`]. Nothing behind that sees Python. `python/flapwing/_flapwing.pyi` repeats signatures and docstrings
//! for editors and type checkers; tests hold both to be equal.

mod convert;
mod parameters;
mod run;
mod solver;

/// Native part of flapwing.
#[pyo3::pymodule]
mod _flapwing {
    #[pymodule_export]
    use crate::run::{presets, run};

    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "Python's name for it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
