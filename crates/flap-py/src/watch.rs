//! Long work without the interpreter: looks up now and then for Ctrl-C, and tells how far it is.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

/// How often the interpreter is asked for: often enough for a user, seldom enough for the work.
const INTERVAL: Duration = Duration::from_millis(50);

/// Keeps an eye on the interpreter while something runs without it.
pub(crate) struct Watch {
    /// Called with how much is done and how much there is in all.
    progress: Option<Py<PyAny>>,
    /// Raised when the work is to end.
    pub(crate) stop: Arc<AtomicBool>,
    last: Option<Instant>,
    error: Option<PyErr>,
}

impl Watch {
    pub(crate) fn new(progress: Option<Py<PyAny>>) -> Watch {
        Watch { progress, stop: Arc::default(), last: None, error: None }
    }

    /// Looks up, if it is time. The work is to end when a signal handler or the callback raises an exception.
    pub(crate) fn look(&mut self, done: u64, all: u64) {
        if self.error.is_some() || self.last.is_some_and(|last| last.elapsed() < INTERVAL) {
            return;
        }
        let seen = Python::attach(|py| {
            py.check_signals()?;
            self.progress.as_ref().map_or(Ok(()), |progress| progress.call1(py, (done, all)).map(drop))
        });
        self.last = Some(Instant::now());
        self.note(seen);
    }

    /// Ends the work if there was an exception.
    pub(crate) fn note(&mut self, seen: PyResult<()>) {
        if let Err(error) = seen {
            self.error.get_or_insert(error);
            self.stop.store(true, Ordering::Relaxed);
        }
    }

    /// The exception that ended the work, if one did.
    pub(crate) fn ended(self) -> PyResult<()> {
        self.error.map_or(Ok(()), Err)
    }
}
