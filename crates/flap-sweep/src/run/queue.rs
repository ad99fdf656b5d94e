//! The queue assigns units of work to worker threads. One thread collects the outcomes of the units from the
//! queue, in the order of the units.
//!
//! The queue cannot deadlock, for the following reasons. A worker thread waits only if the thread has no
//! unfinished unit of work and the buffer for outcomes (the [`Window`]) is full. If the next outcome is in
//! the buffer, the collecting thread removes the outcome, and the buffer has room again. If the next outcome
//! is missing, a worker is still computing this outcome, and a worker that computes does not wait. Each
//! worker calls `leave` at its end, even after a panic. If a worker ends before its units of work are
//! finished, the run fails. The collecting thread waits only while at least one worker runs. When a run is
//! dropped, its workers are aborted.
//!
//! After a stop, workers have a short time to finish their units of work. Units of work that are not finished
//! after this time are discarded.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::{RunError, RunOptions};

/// Lower and upper limit of the time for which [`Queue::next_batch`] waits for outcomes.
const TURN: [Duration; 2] = [Duration::from_millis(10), Duration::from_millis(100)];

/// If this number of outcomes are finished, and the next outcome is one of them, [`Queue::next_batch`] does
/// not wait for more outcomes.
const BATCH: usize = 64;

/// Largest number of outcomes that one call of [`Queue::next_batch`] returns. The number is limited so that
/// workers can soon begin new units of work.
const MOST_AT_ONCE: usize = 1024;

/// The units of work of a run, and the outcomes of finished units.
pub(super) struct Queue<T> {
    /// True after a request to stop: workers receive no further units of work.
    stop: AtomicBool,
    /// Time within which workers may finish their units of work after a stop.
    grace: Duration,
    /// True if workers must abandon their unfinished units of work.
    cancelled: AtomicBool,
    state: Mutex<State<T>>,
    /// Notifies waiting workers that the buffer for outcomes has room or that the run has ended.
    room: Condvar,
    /// Notifies the collecting thread that outcomes are available or that a worker has ended.
    outcomes: Condvar,
}

struct State<T> {
    window: Window<T>,
    workers: usize,
    /// True if the run was aborted: workers receive no further units of work, and the outcomes of running
    /// units are discarded.
    aborted: bool,
    /// Time at which the collecting thread detected the request to stop.
    stopped: Option<Instant>,
    failure: Option<RunError>,
}

impl<T> Queue<T> {
    /// Returns a queue that assigns the units of work with the numbers `units`.
    pub(super) fn new(units: Range<u64>, options: &RunOptions, workers: usize) -> Queue<T> {
        let (window, grace) = (Window::new(units, options.window), options.grace);
        let state = State { window, workers, aborted: false, stopped: None, failure: None };
        Queue {
            stop: AtomicBool::new(false),
            grace,
            cancelled: AtomicBool::new(false),
            state: Mutex::new(state),
            room: Condvar::new(),
            outcomes: Condvar::new(),
        }
    }

    /// Locks the state. The state stays valid even if a thread panics while it holds the lock. The function
    /// `lock` therefore ignores that a lock is poisoned.
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Assigns the next unit of work and returns its number. If the buffer for outcomes is full and
    /// `may_wait` is false, the function returns `None`. `None` also means that no units are left or that the
    /// run has ended.
    pub(super) fn next(&self, may_wait: bool) -> Option<u64> {
        let mut state = self.lock();
        loop {
            if state.ends(&self.stop) {
                return None;
            }
            if let Some(index) = state.window.hand_out() {
                return Some(index);
            }
            self.wake_collector(&state);
            if !may_wait {
                return None;
            }
            // Also signalled by every batch, so that a stop is noticed.
            state = self.room.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Stores the outcome of the unit of work with the number `index`.
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

    /// Records that a worker thread has ended.
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

    /// Returns true if workers must abandon their unfinished units of work. Abandoned units have no outcomes.
    pub(super) fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// Requests a stop: workers receive no further units of work.
    pub(super) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Ends all workers. The outcomes of unfinished units of work are discarded.
    pub(super) fn abort(&self) {
        self.lock().aborted = true;
        self.cancelled.store(true, Ordering::Relaxed);
        self.room.notify_all();
    }

    /// Records that the outcomes that the previous call returned are written, and waits a short time for more
    /// outcomes (see [`TURN`]).
    ///
    /// Returns the new outcomes and the number of all finished units of work. Returns `None` if all workers
    /// have ended and no outcomes are left.
    pub(super) fn next_batch(&self) -> Option<(Vec<T>, u64)> {
        let mut batch = Vec::new();
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
        state.window.take(&mut batch, MOST_AT_ONCE);
        if batch.is_empty() && state.workers == 0 {
            return None;
        }
        Some((batch, state.window.finished()))
    }

    /// Removes the first error of a worker from the queue and returns this error.
    pub(super) fn take_failure(&self) -> Option<RunError> {
        self.lock().failure.take()
    }
}

impl<T> State<T> {
    /// Returns true if workers receive no further units of work.
    fn ends(&self, stop: &AtomicBool) -> bool {
        self.aborted || self.failure.is_some() || self.window.is_exhausted() || stop.load(Ordering::Relaxed)
    }

    /// Stores `error`, unless an earlier error is already stored.
    fn fail(&mut self, error: RunError) {
        self.failure.get_or_insert(error);
    }
}

/// Buffer for the outcomes of all units of work that are assigned to a worker but whose outcomes are not yet
/// written. The buffer has room for the outcomes of `capacity` units.
///
/// ```text
/// 0 ── written ──── taken ──────── handed_out ──── total
///      │ being      │ `outcomes`: here   │ not yet
///      │ written    │ or still running   │ begun
/// ```
///
/// Units of work are numbered in the order in which they are assigned to workers. The number of a point is
/// its position in the list of selected points, not its index in the plan.
pub(super) struct Window<T> {
    capacity: u64,
    total: u64,
    written: u64,
    taken: u64,
    handed_out: u64,
    outcomes: VecDeque<Option<T>>,
    /// Number of finished outcomes that the collecting thread has not taken yet.
    waiting: usize,
}

impl<T> Window<T> {
    /// Returns an empty buffer for the outcomes of the units of work with the numbers `units`. The outcomes
    /// of all units of work with numbers below `units.start` have already been written.
    pub(super) fn new(units: Range<u64>, capacity: usize) -> Window<T> {
        Window {
            capacity: capacity.max(1) as u64,
            total: units.end,
            written: units.start,
            taken: units.start,
            handed_out: units.start,
            outcomes: VecDeque::new(),
            waiting: 0,
        }
    }

    /// Returns true if every unit of work has been assigned to a worker.
    pub(super) fn is_exhausted(&self) -> bool {
        self.handed_out == self.total
    }

    /// Assigns the next unit of work and returns its number. Returns `None` if no unit is left or the buffer
    /// for outcomes is full.
    pub(super) fn hand_out(&mut self) -> Option<u64> {
        if self.is_exhausted() || self.is_full() {
            return None;
        }
        self.outcomes.push_back(None);
        self.handed_out += 1;
        Some(self.handed_out - 1)
    }

    /// Stores the outcome of the unit of work with the number `index`. Returns false if this unit was not
    /// assigned, or if an outcome of this unit was already stored.
    pub(super) fn insert(&mut self, index: u64, outcome: T) -> bool {
        let place = index.checked_sub(self.taken).and_then(|place| usize::try_from(place).ok());
        match place.and_then(|place| self.outcomes.get_mut(place)) {
            Some(slot @ None) => {
                *slot = Some(outcome);
                self.waiting += 1;
                true
            }
            _ => false,
        }
    }

    /// Returns true if the next outcome is finished, and the buffer is full or contains at least `enough`
    /// finished outcomes.
    pub(super) fn is_worth_taking(&self, enough: usize) -> bool {
        let next_is_here = matches!(self.outcomes.front(), Some(Some(_)));
        next_is_here && (self.waiting >= enough || self.is_full())
    }

    fn is_full(&self) -> bool {
        self.handed_out - self.written >= self.capacity
    }

    /// Moves the next consecutive outcomes to `batch`, until `batch` contains `limit` outcomes or the next
    /// outcome is missing.
    pub(super) fn take(&mut self, batch: &mut Vec<T>, limit: usize) {
        while batch.len() < limit
            && let Some(Some(_)) = self.outcomes.front()
        {
            batch.extend(self.outcomes.pop_front().flatten());
            self.waiting -= 1;
            self.taken += 1;
        }
    }

    /// Records that all outcomes that were removed from the buffer are written. For each written outcome, the
    /// buffer then has room for the outcome of one new unit of work.
    pub(super) fn mark_written(&mut self) {
        self.written = self.taken;
    }

    /// Returns the number of all finished units of work, including units whose outcomes were already removed
    /// from the buffer.
    pub(super) fn finished(&self) -> u64 {
        self.taken + self.waiting as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn take(window: &mut Window<u32>, limit: usize) -> Vec<u32> {
        let mut batch = Vec::new();
        window.take(&mut batch, limit);
        batch
    }

    #[test]
    fn rows_leave_in_point_order() {
        let mut window = Window::new(0..4, 10);
        while window.hand_out().is_some() {}
        assert!(window.insert(2, 2));
        assert!(window.insert(1, 1));
        assert!(!window.is_worth_taking(1));
        assert!(take(&mut window, 10).is_empty());
        assert!(window.insert(0, 0));
        assert!(window.is_worth_taking(3));
        assert!(!window.is_worth_taking(4));
        assert_eq!(take(&mut window, 2), [0, 1]);
        assert!(window.insert(3, 3));
        assert_eq!(take(&mut window, 10), [2, 3]);
        assert_eq!(window.finished(), 4);
    }

    #[test]
    fn room_comes_from_writing_alone() {
        let mut window = Window::new(0..100, 2);
        assert_eq!(window.hand_out(), Some(0));
        assert_eq!(window.hand_out(), Some(1));
        assert_eq!(window.hand_out(), None);
        assert!(window.insert(0, 0));
        assert_eq!(window.hand_out(), None);
        take(&mut window, 10);
        assert_eq!(window.hand_out(), None);
        window.mark_written();
        assert_eq!(window.hand_out(), Some(2));
        assert_eq!(window.hand_out(), None);
        assert!(!window.is_exhausted());
    }

    #[test]
    fn rows_of_other_points_are_refused() {
        let mut window = Window::new(0..100, 10);
        window.hand_out();
        window.hand_out();
        assert!(!window.insert(2, 2), "never handed out");
        assert!(window.insert(0, 0));
        assert!(!window.insert(0, 0), "twice");
        take(&mut window, 10);
        assert!(!window.insert(0, 0), "taken already");
        assert!(window.insert(1, 1));
    }

    #[test]
    fn a_window_may_begin_anywhere() {
        let mut window = Window::new(7..9, 10);
        assert_eq!(window.finished(), 7);
        assert_eq!([window.hand_out(), window.hand_out(), window.hand_out()], [Some(7), Some(8), None]);
        assert!(window.insert(8, 8));
        assert!(!window.insert(6, 6), "before the window");
        assert!(window.insert(7, 7));
        assert_eq!(take(&mut window, 10), [7, 8]);
        assert_eq!(window.finished(), 9);
    }
}
