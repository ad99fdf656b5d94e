//! What the workers and the collector share: points to run, rows to write, and when to give up.
//!
//! Nobody waits for ever. A worker waits only while it has no point in hand and the window is full. Then the row
//! that is written next is either here, and the collector takes it and makes room, or its point is in the hands of
//! another worker, which therefore does not wait. A worker that ends, by a panic too, says so; one that ends
//! with points in hand fails the run. The collector waits only while there are workers, and whatever ends the
//! collector aborts the run for the workers.
//!
//! Asked to stop, workers have a moment to finish the points in their hands. What still runs then is dropped.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::RunError;
use super::finished::Finished;
use super::window::Window;

/// The collector looks for rows at least this often, which is also how often progress is reported.
const TURN: Duration = Duration::from_millis(100);

/// How long points in hand may go on after a stop: long enough for ordinary ones, and less than a second with the turns
/// around it.
const GRACE: Duration = Duration::from_millis(400);

/// The collector is woken early when this many rows are ready.
const BATCH: usize = 64;

/// The collector takes at most this many rows at once, so that room is made in time.
const MOST_AT_ONCE: usize = 1024;

pub(super) struct Queue<'a> {
    stop: &'a AtomicBool,
    /// Points in hand are to be dropped.
    cancelled: AtomicBool,
    state: Mutex<State>,
    /// Workers wait on this for room in the window, or the end.
    room: Condvar,
    /// The collector waits on this for rows, or the end of the workers.
    rows: Condvar,
}

struct State {
    window: Window,
    workers: usize,
    /// Nothing more is wanted: no points are handed out, rows are dropped.
    aborted: bool,
    /// When the stop was first seen.
    stopped: Option<Instant>,
    failure: Option<RunError>,
}

/// What the collector finds when it looks for rows.
pub(super) enum Turn {
    /// Rows to write, or none for now. The number is how many points have run.
    Rows(u64),
    /// All workers have ended and every row that could be written was taken.
    End,
}

impl<'a> Queue<'a> {
    pub(super) fn new(points: Range<u64>, window: usize, workers: usize, stop: &'a AtomicBool) -> Queue<'a> {
        let window = Window::new(points, window);
        let state = State { window, workers, aborted: false, stopped: None, failure: None };
        let cancelled = AtomicBool::new(false);
        Queue { stop, cancelled, state: Mutex::new(state), room: Condvar::new(), rows: Condvar::new() }
    }

    /// Nothing panics while holding the lock and leaves the state halfway, so a poisoned lock is as good.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next point to run. Waits for room if `may_wait`; otherwise a full window is `None` too.
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

    /// Takes what became of a point.
    pub(super) fn done(&self, index: u64, finished: Finished) {
        let mut state = self.lock();
        if state.aborted {
            return;
        }
        if !state.window.insert(index, finished) {
            state.fail(RunError::Model(format!("it returned a row for point {index}, which is not running")));
        }
        self.wake_collector(&state);
    }

    fn wake_collector(&self, state: &State) {
        if state.window.is_worth_taking(BATCH) {
            self.rows.notify_one();
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
        self.rows.notify_one();
    }

    /// Whether points in hand are to be dropped without their rows.
    pub(super) fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// Makes the workers end: no more points, and their rows are dropped.
    pub(super) fn abort(&self) {
        self.lock().aborted = true;
        self.cancelled.store(true, Ordering::Relaxed);
        self.room.notify_all();
    }

    /// Tells that the rows of the last turn are written, and waits for more, not longer than one turn.
    /// `batch` must be empty.
    pub(super) fn turn(&self, batch: &mut Vec<Finished>) -> Turn {
        let mut state = self.lock();
        state.window.mark_written();
        if self.stop.load(Ordering::Relaxed)
            && state.stopped.get_or_insert_with(Instant::now).elapsed() >= GRACE
        {
            self.cancelled.store(true, Ordering::Relaxed);
        }
        self.room.notify_all();
        if state.workers > 0 && !state.window.is_worth_taking(BATCH) {
            let waited = self.rows.wait_timeout(state, TURN);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        state.window.take(batch, MOST_AT_ONCE);
        if batch.is_empty() && state.workers == 0 {
            return Turn::End;
        }
        Turn::Rows(state.window.finished())
    }

    /// What went wrong in the workers.
    pub(super) fn into_failure(self) -> Option<RunError> {
        self.state.into_inner().unwrap_or_else(PoisonError::into_inner).failure
    }
}

impl State {
    /// Whether no more points are handed out.
    fn ends(&self, stop: &AtomicBool) -> bool {
        self.aborted || self.failure.is_some() || self.window.is_exhausted() || stop.load(Ordering::Relaxed)
    }

    /// Keeps the first failure.
    fn fail(&mut self, error: RunError) {
        self.failure.get_or_insert(error);
    }
}
