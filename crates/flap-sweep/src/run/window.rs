//! Puts rows back into point order, within a bounded number of points.

use std::collections::VecDeque;
use std::ops::Range;

use super::finished::Finished;

/// The points between the last row written and the last point handed out, at most `capacity` of them.
///
/// ```text
/// 0 ── written ──── taken ──────── handed_out ──── total
///      │ being      │ `rows`: here or    │ not yet
///      │ written    │ still running      │ begun
/// ```
///
/// Points are numbered as they are handed out: by their position among those selected, not by their index in the plan.
pub(super) struct Window {
    capacity: u64,
    total: u64,
    written: u64,
    taken: u64,
    handed_out: u64,
    rows: VecDeque<Option<Finished>>,
    /// How many of `rows` are here.
    waiting: usize,
}

impl Window {
    /// A window over `points`; those before have been written.
    pub(super) fn new(points: Range<u64>, capacity: usize) -> Window {
        Window {
            capacity: capacity.max(1) as u64,
            total: points.end,
            written: points.start,
            taken: points.start,
            handed_out: points.start,
            rows: VecDeque::new(),
            waiting: 0,
        }
    }

    /// Whether every point has been handed out.
    pub(super) fn is_exhausted(&self) -> bool {
        self.handed_out == self.total
    }

    /// The next point to run, unless there is none or the window is full.
    pub(super) fn hand_out(&mut self) -> Option<u64> {
        if self.is_exhausted() || self.is_full() {
            return None;
        }
        self.rows.push_back(None);
        self.handed_out += 1;
        Some(self.handed_out - 1)
    }

    /// Keeps the row of a point that was handed out. False if the point was not, or has a row already.
    pub(super) fn insert(&mut self, index: u64, finished: Finished) -> bool {
        let place = index.checked_sub(self.taken).and_then(|place| usize::try_from(place).ok());
        match place.and_then(|place| self.rows.get_mut(place)) {
            Some(slot @ None) => {
                *slot = Some(finished);
                self.waiting += 1;
                true
            }
            _ => false,
        }
    }

    /// Whether a row can be taken, and either `enough` are here or the window is full.
    pub(super) fn is_worth_taking(&self, enough: usize) -> bool {
        let next_is_here = matches!(self.rows.front(), Some(Some(_)));
        next_is_here && (self.waiting >= enough || self.is_full())
    }

    fn is_full(&self) -> bool {
        self.handed_out - self.written >= self.capacity
    }

    /// Moves rows that follow on the last one taken to `batch`, at most `limit` of them.
    pub(super) fn take(&mut self, batch: &mut Vec<Finished>, limit: usize) {
        while batch.len() < limit
            && let Some(Some(_)) = self.rows.front()
        {
            batch.extend(self.rows.pop_front().flatten());
            self.waiting -= 1;
            self.taken += 1;
        }
    }

    /// Notes that all rows taken are written, which makes room for as many points.
    pub(super) fn mark_written(&mut self) {
        self.written = self.taken;
    }

    /// Points that have run, whether their rows are taken or not.
    pub(super) fn finished(&self) -> u64 {
        self.taken + self.waiting as u64
    }
}

#[cfg(test)]
mod tests {
    use flap_core::parameter::Invalid;
    use flap_core::simulate::Row;

    use super::*;

    fn row(cycles: u32) -> Finished {
        Finished::Row(Row { cycles, ..Row::invalid(Invalid::new("a test")) })
    }

    fn take(window: &mut Window, limit: usize) -> Vec<u32> {
        let mut batch = Vec::new();
        window.take(&mut batch, limit);
        let cycles = |finished: &Finished| match finished {
            Finished::Row(row) => row.cycles,
            Finished::Excluded(_) => u32::MAX,
        };
        batch.iter().map(cycles).collect()
    }

    #[test]
    fn rows_leave_in_point_order() {
        let mut window = Window::new(0..4, 10);
        while window.hand_out().is_some() {}
        assert!(window.insert(2, row(2)));
        assert!(window.insert(1, row(1)));
        assert!(!window.is_worth_taking(1));
        assert!(take(&mut window, 10).is_empty());
        assert!(window.insert(0, row(0)));
        assert!(window.is_worth_taking(3));
        assert!(!window.is_worth_taking(4));
        assert_eq!(take(&mut window, 2), [0, 1]);
        assert!(window.insert(3, row(3)));
        assert_eq!(take(&mut window, 10), [2, 3]);
        assert_eq!(window.finished(), 4);
    }

    #[test]
    fn room_comes_from_writing_alone() {
        let mut window = Window::new(0..100, 2);
        assert_eq!(window.hand_out(), Some(0));
        assert_eq!(window.hand_out(), Some(1));
        assert_eq!(window.hand_out(), None);
        assert!(window.insert(0, row(0)));
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
        assert!(!window.insert(2, row(2)), "never handed out");
        assert!(window.insert(0, row(0)));
        assert!(!window.insert(0, row(0)), "twice");
        take(&mut window, 10);
        assert!(!window.insert(0, row(0)), "taken already");
        assert!(window.insert(1, row(1)));
    }

    #[test]
    fn a_window_may_begin_anywhere() {
        let mut window = Window::new(7..9, 10);
        assert_eq!(window.finished(), 7);
        assert_eq!([window.hand_out(), window.hand_out(), window.hand_out()], [Some(7), Some(8), None]);
        assert!(window.insert(8, row(8)));
        assert!(!window.insert(6, row(6)), "before the window");
        assert!(window.insert(7, row(7)));
        assert_eq!(take(&mut window, 10), [7, 8]);
        assert_eq!(window.finished(), 9);
    }
}
