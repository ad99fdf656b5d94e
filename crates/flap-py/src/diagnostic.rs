//! Mistakes in a grid, as Python objects.

#![expect(clippy::too_many_arguments, reason = "the constructor has one per attribute")]

use flap_sweep::grid::diagnostic;
use pyo3::prelude::*;

/// One mistake in a grid.
///
/// Attributes
/// ----------
/// file : str
///     The grid file, or ``"<grid>"``.
/// line, column : int
///     The place of the mistake: line and column, counted from 1. Columns are in characters.
/// start, end : int
///     The place of the mistake as byte offsets in the UTF-8 text. `start` is the first byte of the mistake, and `end`
///     is the first byte after the mistake.
/// message : str
///     The message about the mistake.
/// notes, help : list of str
///     The allowed values, and ways to correct the mistake.
#[pyclass(frozen, get_all, new = "from_fields", module = "flapwing")]
pub(crate) struct Diagnostic {
    file: String,
    line: usize,
    column: usize,
    start: usize,
    end: usize,
    message: String,
    notes: Vec<String>,
    help: Vec<String>,
}

#[pymethods]
impl Diagnostic {
    /// Returns the arguments from which `pickle` restores the object. Workers of a cluster send errors to
    /// other processes as pickles.
    fn __getnewargs__(&self) -> (&str, usize, usize, usize, usize, &str, Vec<String>, Vec<String>) {
        let Diagnostic { file, line, column, start, end, message, notes, help } = self;
        (file, *line, *column, *start, *end, message, notes.clone(), help.clone())
    }

    fn __repr__(&self) -> String {
        format!("{}:{}:{}: {}", self.file, self.line, self.column, self.message)
    }
}

impl From<&diagnostic::Diagnostic> for Diagnostic {
    fn from(diagnostic: &diagnostic::Diagnostic) -> Diagnostic {
        Diagnostic {
            file: diagnostic.source.name.clone(),
            line: diagnostic.line(),
            column: diagnostic.column(),
            start: diagnostic.span.start,
            end: diagnostic.span.end,
            message: diagnostic.message.clone(),
            notes: diagnostic.notes.clone(),
            help: diagnostic.help.clone(),
        }
    }
}
