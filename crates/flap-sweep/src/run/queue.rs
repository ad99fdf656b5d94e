//! The queue between workers and the thread that pulls outcomes: units to run, outcomes in order, and the end of the run.
//!
//! No thread waits for ever. A worker waits only while it has no unit in hand and the window is full. Then the outcome
//! that is pulled next is either here, and pulling it makes room, or its unit is in the hands of
//! another worker, which therefore does not wait. A worker leaves the queue when it ends, after a panic too; one that ends
//! with units in hand fails the run. Pulling waits only while there are workers, and a dropped run aborts its workers.
//!
//! After a stop, workers have a moment to finish the units in their hands. Units that still run then are dropped.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::{RunError, RunOptions};

/// Shortest and longest time that pulling a batch waits for outcomes.
const TURN: [Duration; 2] = [Duration::from_millis(10), Duration::from_millis(100)];

/// Pulling ends early when this many outcomes are ready.
const BATCH: usize = 64;

/// A batch has at most this many outcomes, so that room is made in time.
const MOST_AT_ONCE: usize = 1024;

/// Units to run and their outcomes.
pub(super) struct Queue<T> {
    /// No more units are handed out.
    stop: AtomicBool,
    /// Time for units in hand after a stop.
    grace: Duration,
    /// Units in hand are to be dropped.
    cancelled: AtomicBool,
    state: Mutex<State<T>>,
    /// Workers wait on this for room in the window, or the end.
    room: Condvar,
    /// Pulling waits on this for outcomes, or the end of the workers.
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

impl<T> Queue<T> {
    /// The queue of `units`, run with these options.
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

    /// Nothing panics while holding the lock and leaves the state halfway, so a poisoned lock is as good.
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next unit to run. Waits for room if `may_wait`; otherwise a full window is `None` too.
    pub(super) fn next(&self, may_wait: bool) -> Option<u64> {
        let mut state = self.lock();
        loop {
            if state.ends(&self.stop) {
                return None;
            }
            if let Some(index) = state.window.hand_out() {
                return Some(index);
            }
            self.wake_puller(&state);
            if !may_wait {
                return None;
            }
            // Woken with every batch too, so that a stop is noticed.
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
        self.wake_puller(&state);
    }

    fn wake_puller(&self, state: &State<T>) {
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

    /// Hands out no more units.
    pub(super) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Makes the workers end: no more units, and their outcomes are dropped.
    pub(super) fn abort(&self) {
        self.lock().aborted = true;
        self.cancelled.store(true, Ordering::Relaxed);
        self.room.notify_all();
    }

    /// Notes that the outcomes of the last batch are done with, and waits for more, not longer than [`TURN`].
    /// Returns the outcomes with the number of units that have run; `None` if all workers have ended and every outcome
    /// in order was taken.
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

    /// Takes out the first failure of a worker.
    pub(super) fn take_failure(&self) -> Option<RunError> {
        self.lock().failure.take()
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

/// The units between the last one written and the last one handed out, at most `capacity` of them.
///
/// ```text
/// 0 ── written ──── taken ──────── handed_out ──── total
///      │ being      │ `units`: here or    │ not yet
///      │ written    │ still running      │ begun
/// ```
///
/// Units are numbered as they are handed out: points by their position among those selected, not by their index in the
/// plan.
pub(super) struct Window<T> {
    capacity: u64,
    total: u64,
    written: u64,
    taken: u64,
    handed_out: u64,
    units: VecDeque<Option<T>>,
    /// Number of `units` that are here.
    waiting: usize,
}

impl<T> Window<T> {
    /// A window over `units`; those before have been written.
    pub(super) fn new(units: Range<u64>, capacity: usize) -> Window<T> {
        Window {
            capacity: capacity.max(1) as u64,
            total: units.end,
            written: units.start,
            taken: units.start,
            handed_out: units.start,
            units: VecDeque::new(),
            waiting: 0,
        }
    }

    /// True if every unit has been handed out.
    pub(super) fn is_exhausted(&self) -> bool {
        self.handed_out == self.total
    }

    /// The next unit to run, unless there is none or the window is full.
    pub(super) fn hand_out(&mut self) -> Option<u64> {
        if self.is_exhausted() || self.is_full() {
            return None;
        }
        self.units.push_back(None);
        self.handed_out += 1;
        Some(self.handed_out - 1)
    }

    /// Keeps the outcome of a unit that was handed out. False if the unit was not, or has an outcome already.
    pub(super) fn insert(&mut self, index: u64, outcome: T) -> bool {
        let place = index.checked_sub(self.taken).and_then(|place| usize::try_from(place).ok());
        match place.and_then(|place| self.units.get_mut(place)) {
            Some(slot @ None) => {
                *slot = Some(outcome);
                self.waiting += 1;
                true
            }
            _ => false,
        }
    }

    /// True if an outcome can be taken, and either `enough` are here or the window is full.
    pub(super) fn is_worth_taking(&self, enough: usize) -> bool {
        let next_is_here = matches!(self.units.front(), Some(Some(_)));
        next_is_here && (self.waiting >= enough || self.is_full())
    }

    fn is_full(&self) -> bool {
        self.handed_out - self.written >= self.capacity
    }

    /// Moves outcomes that follow on the last one taken to `batch`, at most `limit` of them.
    pub(super) fn take(&mut self, batch: &mut Vec<T>, limit: usize) {
        while batch.len() < limit
            && let Some(Some(_)) = self.units.front()
        {
            batch.extend(self.units.pop_front().flatten());
            self.waiting -= 1;
            self.taken += 1;
        }
    }

    /// Notes that all outcomes taken are written, which makes room for as many units.
    pub(super) fn mark_written(&mut self) {
        self.written = self.taken;
    }

    /// Units that have run, whether their outcomes are taken or not.
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
