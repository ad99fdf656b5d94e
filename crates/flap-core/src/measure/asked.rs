//! The signals of a model of which a quantity is asked for.

use crate::model::{Measure, Signal};

/// Positions of signals, in their order.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked<const S: usize> {
    positions: [usize; S],
    count: usize,
}

impl<const S: usize> Asked<S> {
    /// The signals of which one of these `measures` is taken.
    pub(super) const fn of(signals: &[Signal; S], measures: &[Measure]) -> Asked<S> {
        let mut asked = Asked { positions: [0; S], count: 0 };
        let mut i = 0;
        while i < S {
            if signals[i].takes_one_of(measures) {
                asked.positions[asked.count] = i;
                asked.count += 1;
            }
            i += 1;
        }
        asked
    }

    /// The positions.
    #[inline(always)]
    pub(super) const fn positions(&self) -> &[usize] {
        self.positions.split_at(self.count).0
    }
}
