//! The compiled module of the Python package `flapwing`.
//!
//! [`parameters`], [`design`] and [`solver`] convert Python values to the types of flap-core and flap-sweep. [`columns`]
//! converts rows to NumPy columns. `python/flapwing/_flapwing.pyi` repeats the signatures, and the docstrings
//! of public names, for editors and type checkers. Tests compare `_flapwing.pyi` with the compiled module.
//! The public functions with full docstrings are in the folder `python/flapwing`.

mod begin;
mod cluster;
mod columns;
mod command;
mod convert;
mod design;
mod diagnostic;
mod error;
mod evaluate;
mod experiments;
mod film;
mod flight;
mod grid;
mod grid_text;
mod keywords;
mod labels;
mod linear;
mod listing;
mod live;
mod motion;
mod optimise;
mod origins;
mod parameters;
mod picture;
mod point;
mod quantity;
mod read;
mod records;
mod resonance;
mod respond;
mod run;
mod solver;
mod sweep;
mod watch;
mod wrench_map;

/// The compiled module of flapwing.
#[pyo3::pymodule]
mod _flapwing {
    #[pymodule_export]
    use crate::{
        begin::states,
        cluster::{identity, part},
        command::command,
        diagnostic::Diagnostic,
        error::GridError,
        evaluate::{batch, check},
        experiments::{chirp, forces_along, impulse},
        film::track_wing,
        flight::fly,
        grid::{Exclusions, Grid},
        keywords::with_keywords,
        labels::{better, printed, scale, split_unit, unit_of, words},
        linear::linear,
        listing::{measures, params, uncertainty},
        live::LiveServer,
        optimise::optimise,
        origins::origins,
        parameters::presets,
        picture::{bars, colours, correlations, is_log, is_signed, line_shades, usual_measure, ways},
        quantity::{parameter, quantity, value},
        read::read,
        resonance::resonance,
        respond::{edges, respond},
        run::{run, trajectory},
        solver::settings,
        sweep::sweep,
        wrench_map::wrench_map,
    };

    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "Python's name for it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
