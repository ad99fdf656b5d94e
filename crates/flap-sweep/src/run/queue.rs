//! The queue between workers and collector: units to run, outcomes to write, and the end of the run.
//!
//! Nobody waits for ever. A worker waits only while it has no unit in hand and the window is full. Then the outcome
//! that is written next is either here, and the collector takes it and makes room, or its unit is in the hands of
//! another worker, which therefore does not wait. A worker that ends, by a panic too, says so; one that ends
//! with units in hand fails the run. The collector waits only while there are workers, and whatever ends the
//! collector aborts the run for the workers.
//!
//! Asked to stop, workers have a moment to finish the units in their hands. Units that still run then are dropped.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::error::RunError;
use super::options::RunOptions;
use super::window::Window;

/// Shortest and longest time between two looks of the collector for outcomes, and between two reports of progress.
const TURN: [Duration; 2] = [Duration::from_millis(10), Duration::from_millis(100)];

/// The collector is woken early when this many outcomes are ready.
const BATCH: usize = 64;

/// The collector takes at most this many outcomes at once, so that room is made in time.
const MOST_AT_ONCE: usize = 1024;

/// Units to run and their outcomes.
pub(super) struct Queue<'a, T> {
    stop: &'a AtomicBool,
    /// Time for units in hand after a stop.
    grace: Duration,
    /// Units in hand are to be dropped.
    cancelled: AtomicBool,
    state: Mutex<State<T>>,
    /// Workers wait on this for room in the window, or the end.
    room: Condvar,
    /// The collector waits on this for outcomes, or the end of the workers.
    outcomes: Condvar,
}

struct State<T> {
    window: Window<T>,
    workers: usize,
    /// Nothing more is wanted: no units are handed out, outcomes are dropped.
    aborted: bool,
    /// The time at which the stop was first seen.
    stopped: Option<Instant>,
    failure: Option<RunError>,
}

impl<'a, T> Queue<'a, T> {
    /// The queue of `units`, run with these options.
    pub(super) fn new(
        units: Range<u64>,
        options: &RunOptions,
        workers: usize,
        stop: &'a AtomicBool,
    ) -> Queue<'a, T> {
        let (window, grace) = (Window::new(units, options.window), options.grace);
        let state = State { window, workers, aborted: false, stopped: None, failure: None };
        let cancelled = AtomicBool::new(false);
        Queue {
            stop,
            grace,
            cancelled,
            state: Mutex::new(state),
            room: Condvar::new(),
            outcomes: Condvar::new(),
        }
    }

    /// Nothing panics while holding the lock and leaves the state halfway, so a poisoned lock is as good.
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next unit to run. Waits for room if `may_wait`; otherwise a full window is `None` too.
    pub(super) fn next(&self, may_wait: bool) -> Option<u64> {
        let mut state = self.lock();
        loop {
            if state.ends(self.stop) {
                return None;
            }
            if let Some(index) = state.window.hand_out() {
                return Some(index);
            }
            self.wake_collector(&state);
            if !may_wait {
                return None;
            }
            // Woken at every turn of the collector as well, so that a raised stop flag is seen.
            state = self.room.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Takes the outcome of a unit.
    pub(super) fn done(&self, index: u64, outcome: T) {
        let mut state = self.lock();
        if state.aborted {
            return;
        }
        if !state.window.insert(index, outcome) {
            state.fail(RunError::Model(format!("it returned a row for point {index}, which is not running")));
        }
        self.wake_collector(&state);
    }

    fn wake_collector(&self, state: &State<T>) {
        if state.window.is_worth_taking(BATCH) {
            self.outcomes.notify_one();
        }
    }

    /// Notes that a worker has ended.
    pub(super) fn leave(&self, outcome: Result<(), RunError>) {
        let mut state = self.lock();
        state.workers -= 1;
        if let Err(error) = outcome {
            state.fail(error);
        }
        drop(state);
        self.room.notify_all();
        self.outcomes.notify_one();
    }

    /// True if units in hand are to be dropped without their outcomes.
    pub(super) fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// Makes the workers end: no more units, and their outcomes are dropped.
    pub(super) fn abort(&self) {
        self.lock().aborted = true;
        self.cancelled.store(true, Ordering::Relaxed);
        self.room.notify_all();
    }

    /// Notes that the outcomes of the last turn are written, and waits for more, not longer than one turn.
    /// `batch` must be empty. Returns the number of units that have run; `None` if all workers have ended and every outcome
    /// that could be written was taken.
    pub(super) fn turn(&self, batch: &mut Vec<T>) -> Option<u64> {
        let mut state = self.lock();
        state.window.mark_written();
        if self.stop.load(Ordering::Relaxed)
            && state.stopped.get_or_insert_with(Instant::now).elapsed() >= self.grace
        {
            self.cancelled.store(true, Ordering::Relaxed);
        }
        self.room.notify_all();
        if state.workers > 0 && !state.window.is_worth_taking(BATCH) {
            let waited = self.outcomes.wait_timeout(state, self.grace.clamp(TURN[0], TURN[1]));
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        state.window.take(batch, MOST_AT_ONCE);
        if batch.is_empty() && state.workers == 0 {
            return None;
        }
        Some(state.window.finished())
    }

    /// The first failure of a worker.
    pub(super) fn into_failure(self) -> Option<RunError> {
        self.state.into_inner().unwrap_or_else(PoisonError::into_inner).failure
    }
}

impl<T> State<T> {
    /// True if no more units are handed out.
    fn ends(&self, stop: &AtomicBool) -> bool {
        self.aborted || self.failure.is_some() || self.window.is_exhausted() || stop.load(Ordering::Relaxed)
    }

    /// Keeps the first failure.
    fn fail(&mut self, error: RunError) {
        self.failure.get_or_insert(error);
    }
}
