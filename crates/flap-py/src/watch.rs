//! Long work without the interpreter: looks up now and then for Ctrl-C, and tells how far it is.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use flap_core::simulate::Interrupt;
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
        if self.error.is_none() && self.last.is_none_or(|last| last.elapsed() >= INTERVAL) {
            self.look_now(done, all);
        }
    }

    fn look_now(&mut self, done: u64, all: u64) {
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

    /// Tells that all is done, so that a bar ends where it should, unless an exception ended the work.
    pub(crate) fn done(&mut self, all: u64) {
        if self.error.is_none() {
            self.look_now(all, all);
        }
    }

    /// The exception that ended the work, if one did.
    pub(crate) fn ended(self) -> PyResult<()> {
        self.error.map_or(Ok(()), Err)
    }
}

/// Does `work` without the interpreter. The interrupt that it is given comes with Ctrl-C.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(Interrupt<'_>) -> T + Send,
) -> PyResult<T> {
    let (done, watch) = py.detach(|| {
        let watch = RefCell::new(Watch::new(None));
        let done = work(&|| {
            let mut watch = watch.borrow_mut();
            watch.look(0, 0);
            watch.error.is_some()
        });
        (done, watch.into_inner())
    });
    watch.ended()?;
    Ok(done)
}
