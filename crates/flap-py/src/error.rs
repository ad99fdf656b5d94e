//! Converts errors to Python exceptions.

use std::ffi::CString;
use std::fmt::Display;
use std::io;

use flap_sweep::files::integrity::OpenError;
use flap_sweep::files::job::JobError;
use flap_sweep::files::output::CreateError;
use flap_sweep::files::session::ResumeError;
use flap_sweep::files::sidecar;
use flap_sweep::grid::ReadError;
use flap_sweep::grid::diagnostic;
use flap_sweep::input::InputError;
use flap_sweep::notation::UserError;
use flap_sweep::notation::units::UnitError;
use flap_sweep::run::RunError;
use pyo3::create_exception;
use pyo3::exceptions::{
    PyFileExistsError, PyFileNotFoundError, PyIsADirectoryError, PyOSError, PyRuntimeError, PyUserWarning,
    PyValueError,
};
use pyo3::prelude::*;

use crate::diagnostic::Diagnostic;

create_exception!(
    flapwing,
    GridError,
    PyValueError,
    "A grid with mistakes.\n\nThe text of the error shows every mistake with its lines, and `diagnostics` lists the mistakes."
);

/// Shows a `UserWarning` for the line of the user's code that called flapwing.
pub(crate) fn warn(py: Python<'_>, text: String) -> PyResult<()> {
    let level = py.import("flapwing._mistakes")?.call_method0("callers_level")?.extract()?;
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &CString::new(text)?, level)
}

/// Returns a `GridError` for mistakes in a grid, with the list of diagnostics.
pub(crate) fn grid(py: Python<'_>, mistakes: &diagnostic::Mistakes) -> PyErr {
    let diagnostics = mistakes.iter().map(Diagnostic::from).collect();
    with_diagnostics(py, diagnostic::render(mistakes, false), diagnostics)
}

/// Returns a `GridError` for a dictionary that cannot be written as a grid file. The error has no
/// diagnostics, because diagnostics refer to lines of a file.
pub(crate) fn no_grid(py: Python<'_>, message: &str) -> PyErr {
    with_diagnostics(py, message.to_owned(), Vec::new())
}

fn with_diagnostics(py: Python<'_>, message: String, diagnostics: Vec<Diagnostic>) -> PyErr {
    let error = GridError::new_err(message);
    match error.value(py).setattr("diagnostics", diagnostics) {
        Ok(()) => error,
        Err(error) => error,
    }
}

/// Returns the exception for a grid file that cannot be converted to a plan.
pub(crate) fn grid_file(py: Python<'_>, error: &ReadError) -> PyErr {
    match error {
        ReadError::Grid(mistakes) => grid(py, mistakes),
        ReadError::Results { .. } => PyValueError::new_err(error.to_string()),
        ReadError::Input { error: reason, .. } => match reason {
            InputError::Missing => PyFileNotFoundError::new_err(error.to_string()),
            InputError::Folder => PyIsADirectoryError::new_err(error.to_string()),
            InputError::Unreadable(_) => PyOSError::new_err(error.to_string()),
            InputError::Endless | InputError::TooLarge(_) | InputError::NotUtf8 { .. } => {
                PyValueError::new_err(error.to_string())
            }
        },
    }
}

/// Returns a `ValueError` for a mistake of the user, such as an experiment without results.
pub(crate) fn experiment(error: &UserError) -> PyErr {
    with_help(error, error.help.as_ref())
}

/// Returns a `ValueError` for a mistake in an argument with the given name.
pub(crate) fn argument(name: &str, error: &UserError) -> PyErr {
    with_help(format!("{name}: {error}"), error.help.as_ref())
}

/// Returns a `ValueError` for text that is not a quantity. `name` is the name of the argument with the text.
pub(crate) fn quantity(name: &str, error: &UnitError) -> PyErr {
    with_help(error.message(&format!("`{name}`")), error.help())
}

/// Returns a `ValueError` with a message, and with advice on a separate line.
pub(crate) fn with_help(message: impl Display, help: Option<impl Display>) -> PyErr {
    let help = help.map_or_else(String::new, |help| format!("\n{help}"));
    PyValueError::new_err(format!("{message}{help}"))
}

/// Returns a `ValueError` with the message `reason`, for a motion that could not be computed.
pub(crate) fn unfinished(reason: &impl Display) -> PyErr {
    PyValueError::new_err(reason.to_string())
}

/// Returns the exception for a computation of rows that ended early.
pub(crate) fn run(error: &RunError) -> PyErr {
    match error {
        RunError::Sink(_) => PyOSError::new_err(error.to_string()),
        RunError::Threads(_) | RunError::Chunk(_) | RunError::Fetch(_) => {
            PyRuntimeError::new_err(error.to_string())
        }
        RunError::Model(_) | RunError::Panic(_) => {
            PyRuntimeError::new_err(format!("{error}; this is an error in flap: please report it"))
        }
    }
}

/// Returns the exception for results that were not written or not completed.
pub(crate) fn job(error: &JobError) -> PyErr {
    let go_on = |error: PyErr, resumable: bool, py: Python<'_>| {
        if !resumable {
            return error;
        }
        error.add_note(py, "the same call continues the run").err().unwrap_or(error)
    };
    Python::attach(|py| match error {
        JobError::Format(error) => PyValueError::new_err(error.to_string()),
        JobError::Overlap(error) => PyValueError::new_err(error.to_string()),
        JobError::Create(error) => create(error),
        JobError::Exists { changed, .. } => {
            let changed = changed.as_ref().map_or_else(String::new, |changed| format!("; {changed}"));
            let remedy = "choose another file, or replace it with restart=True";
            PyFileExistsError::new_err(format!("{error}{changed}: {remedy}"))
        }
        JobError::Resume { error, changed, .. } => resume(error, changed.as_deref()),
        JobError::Open(OpenError::Read { path, source }) => unreadable(path.display(), source),
        JobError::Open(_) => {
            PyValueError::new_err(format!("{error}: start over with restart=True, or choose another file"))
        }
        JobError::Write { resumable, .. } => go_on(PyOSError::new_err(error.to_string()), *resumable, py),
        JobError::Run { error, resumable } => go_on(run(error), *resumable, py),
    })
}

fn create(error: &CreateError) -> PyErr {
    match error {
        CreateError::Exists { .. } => PyFileExistsError::new_err(format!(
            "{error}: replace it with restart=True, or choose another file"
        )),
        CreateError::Unfinished { .. } => PyFileExistsError::new_err(format!(
            "{error}: the same call continues the run; restart=True replaces the results"
        )),
        CreateError::InTheWay { .. } => PyFileExistsError::new_err(format!(
            "{error}: rename or remove that file, or choose another name for the results"
        )),
        CreateError::Busy { .. } => PyOSError::new_err(error.to_string()),
        CreateError::Io { path, source } => io_error(&format!("cannot write {}", path.display()), source),
    }
}

fn resume(error: &ResumeError, changed: Option<&str>) -> PyErr {
    let message = changed.map_or(error.to_string(), |changed| format!("{error}; {changed}"));
    match error {
        ResumeError::Create(error) => create(error),
        ResumeError::Format(_) => PyValueError::new_err(message),
        ResumeError::NoJournal { .. } | ResumeError::Changed { .. } | ResumeError::Altered { .. } => {
            PyValueError::new_err(format!("{message}: start over with restart=True, or choose another file"))
        }
    }
}

/// Returns the exception for results that cannot be read.
pub(crate) fn open(error: &OpenError) -> PyErr {
    match error {
        OpenError::Read { path, source } | OpenError::Sidecar(sidecar::SidecarError::Io { path, source }) => {
            unreadable(path.display(), source)
        }
        OpenError::Format(_) => PyValueError::new_err(error.to_string()),
        OpenError::Sidecar(_) | OpenError::Damaged { .. } => {
            PyValueError::new_err(format!("{error}: ignore_damage=True reads the rows that can be read"))
        }
    }
}

/// Returns the exception for a file that cannot be read.
pub(crate) fn unreadable(path: impl Display, error: &io::Error) -> PyErr {
    match error.kind() {
        io::ErrorKind::NotFound => {
            PyFileNotFoundError::new_err(format!("cannot read {path}: there is no such file"))
        }
        _ => io_error(&format!("cannot read {path}"), error),
    }
}

/// Returns the exception that Python raises for the given error of the operating system.
fn io_error(what: &str, error: &io::Error) -> PyErr {
    let message = format!("{what}: {error}");
    match error.kind() {
        io::ErrorKind::NotFound => PyFileNotFoundError::new_err(message),
        io::ErrorKind::InvalidData => PyValueError::new_err(message),
        _ => PyOSError::new_err(message),
    }
}
