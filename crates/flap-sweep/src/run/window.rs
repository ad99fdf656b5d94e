//! The window: puts the outcomes of units back in order, within a bounded number of units.

use std::collections::VecDeque;
use std::ops::Range;

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
