//! Runs long work without the interpreter lock, with regular checks for Ctrl-C and reports of progress.

use std::cell::RefCell;
use std::time::{Duration, Instant};

use flap_core::simulate::Interrupt;
use flap_sweep::run::Progress;
use pyo3::prelude::*;

/// The interval between checks. A check for Ctrl-C takes much less time than this interval, and a user does
/// not notice a delay of 50 ms.
const INTERVAL: Duration = Duration::from_millis(50);

/// Checks for signals of the operating system, such as Ctrl-C, and reports progress, while work runs without
/// the interpreter lock.
pub(crate) struct Watch {
    /// The user's progress function, whose arguments are the number of finished points and the number of all
    /// points.
    progress: Option<Py<PyAny>>,
    last: Option<Instant>,
    error: Option<PyErr>,
}

impl Watch {
    pub(crate) fn new(progress: Option<Py<PyAny>>) -> Watch {
        Watch { progress, last: None, error: None }
    }

    /// If [`INTERVAL`] has passed, checks for signals of the operating system and reports progress. Returns
    /// true if an exception of a signal handler or of the progress function has ended the work.
    pub(crate) fn stops(&mut self, Progress { finished, points }: Progress) -> bool {
        if self.error.is_none() && self.last.is_none_or(|last| last.elapsed() >= INTERVAL) {
            self.look_now(finished, points);
        }
        self.is_stopped()
    }

    /// Returns true if an exception has ended the work.
    pub(crate) fn is_stopped(&self) -> bool {
        self.error.is_some()
    }

    fn look_now(&mut self, done: u64, all: u64) {
        let seen = Python::attach(|py| {
            py.check_signals()?;
            self.progress.as_ref().map_or(Ok(()), |progress| progress.call1(py, (done, all)).map(drop))
        });
        self.last = Some(Instant::now());
        self.note(seen);
    }

    /// If `seen` is an error, stores its exception, so that the work ends. Only the first exception is
    /// stored.
    pub(crate) fn note(&mut self, seen: PyResult<()>) {
        if let Err(error) = seen {
            self.error.get_or_insert(error);
        }
    }

    /// Reports that all points are done, so that a progress bar is full at the end. Does nothing if an exception ended
    /// the work.
    pub(crate) fn done(&mut self, all: u64) {
        if self.error.is_none() {
            self.look_now(all, all);
        }
    }

    /// Returns `Err` with the exception if an exception ended the work, and `Ok` otherwise.
    pub(crate) fn ended(self) -> PyResult<()> {
        self.error.map_or(Ok(()), Err)
    }
}

/// Runs `work` without the interpreter lock. If the user presses Ctrl-C, the work ends, and the result is
/// `Err` with the exception of Python's signal handler.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(Interrupt<'_>) -> T + Send,
) -> PyResult<T> {
    let (done, watch) = py.detach(|| {
        let watch = RefCell::new(Watch::new(None));
        let done = work(&|| watch.borrow_mut().stops(Progress { finished: 0, points: 0 }));
        (done, watch.into_inner())
    });
    watch.ended()?;
    Ok(done)
}
