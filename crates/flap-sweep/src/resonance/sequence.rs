//! Sequences of points. The rows of earlier points determine the next point.
//!
//! Many sequences are open at once, so the lanes stay full while each sequence waits for its own rows.

use flap_core::num::Backend;
use flap_core::simulate::{Jobs, Point, PointRun, Row, Rows, SolverSettings};

/// Points that are run step by step.
pub trait PointSequence {
    /// Returns the points to run next, with any indices; the list is empty if the sequence has ended.
    ///
    /// The function is called again after [`PointSequence::take`] has received the rows of these points.
    fn probes(&mut self) -> Vec<Point>;

    /// Receives the rows of the latest points, in the order of the points.
    fn take(&mut self, rows: Vec<Row>);
}

/// Source of sequences, and receiver of finished sequences.
pub trait SequenceSource {
    /// Type of a sequence.
    type Sequence: PointSequence;

    /// Returns the next sequence, or `None` if no sequence is available at present.
    ///
    /// If `idle` is true, nothing is running: the call may wait, and `None` means that there are no more sequences.
    fn next(&mut self, idle: bool) -> Option<Self::Sequence>;

    /// Receives a finished sequence.
    fn done(&mut self, sequence: Self::Sequence);

    /// Returns true to end at once, see [`Jobs::interrupted`]. Open sequences are discarded.
    fn interrupted(&self) -> bool;
}

/// Largest number of open sequences without a point to run.
const MOST_OPEN: usize = 256;

/// Runs the sequences of `source` on the lanes of `backend` until no sequences are left.
pub fn run_all(rows: &dyn Rows, backend: Backend, solver: &SolverSettings, source: &mut impl SequenceSource) {
    rows.run(backend, solver, &mut Interleaved { source, open: Vec::new() });
}

/// Runs one sequence on scalars, with the same bits as [`run_all`]. The points have the settings of `run`, but their own
/// values.
pub fn run_one(rows: &dyn Rows, run: &PointRun<'_>, sequence: &mut impl PointSequence) {
    loop {
        let probes = sequence.probes();
        if probes.is_empty() {
            return;
        }
        let row = |probe: &Point| {
            rows.run_point(&PointRun { values: &probe.values, ..*run }, probe.begin.as_deref())
        };
        let found = probes.iter().map(row).collect();
        sequence.take(found);
    }
}

/// The points of open sequences as one stream.
struct Interleaved<'a, D: SequenceSource> {
    source: &'a mut D,
    open: Vec<Option<Open<D::Sequence>>>,
}

/// A sequence whose points wait or are running.
struct Open<S> {
    sequence: S,
    /// Points that have not begun, with the next point last, each with its index among the probes.
    waiting: Vec<(usize, Point)>,
    /// Rows of the points that were received so far.
    rows: Vec<Option<Row>>,
    missing: usize,
}

impl<S: PointSequence> Open<S> {
    /// Returns the sequence with its next points; returns the sequence as an error if the sequence has ended.
    fn begin(mut sequence: S) -> Result<Open<S>, S> {
        let probes = sequence.probes();
        if probes.is_empty() {
            return Err(sequence);
        }
        let missing = probes.len();
        let rows = probes.iter().map(|_| None).collect();
        Ok(Open { sequence, waiting: probes.into_iter().enumerate().rev().collect(), rows, missing })
    }
}

/// Distance between the indices of sequences: each sequence begins at a multiple of this number.
const STRIDE: u64 = 1 << 32;

impl<D: SequenceSource> Interleaved<'_, D> {
    /// Returns a point that can begin now.
    fn waiting(&mut self) -> Option<Point> {
        for (slot, open) in (0_u64..).zip(&mut self.open) {
            if let Some((place, probe)) = open.as_mut().and_then(|open| open.waiting.pop()) {
                let index = slot * STRIDE + place as u64;
                return Some(Point { index, ..probe });
            }
        }
        None
    }

    /// Opens another sequence. Returns false if no sequence is available at present.
    fn open_another(&mut self, idle: bool) -> bool {
        loop {
            let Some(sequence) = self.source.next(idle) else { return false };
            match Open::begin(sequence) {
                Err(ended) => self.source.done(ended),
                Ok(open) => {
                    match self.open.iter_mut().find(|slot| slot.is_none()) {
                        Some(slot) => *slot = Some(open),
                        None => self.open.push(Some(open)),
                    }
                    return true;
                }
            }
        }
    }
}

impl<D: SequenceSource> Jobs for Interleaved<'_, D> {
    fn next(&mut self, idle: bool) -> Option<Point> {
        let waiting = self.waiting();
        if waiting.is_some() {
            return waiting;
        }
        let open = self.open.iter().flatten().count();
        if open < MOST_OPEN && self.open_another(idle) { self.waiting() } else { None }
    }

    fn done(&mut self, index: u64, row: Row) {
        let slot = usize::try_from(index / STRIDE).ok().and_then(|slot| self.open.get_mut(slot));
        let Some(slot) = slot else { return };
        let Some(mut open) = slot.take() else { return };
        let place = usize::try_from(index % STRIDE).ok().and_then(|place| open.rows.get_mut(place));
        if let Some(place @ None) = place {
            *place = Some(row);
            open.missing -= 1;
        }
        if open.missing > 0 {
            *slot = Some(open);
            return;
        }
        let Open { mut sequence, rows, .. } = open;
        sequence.take(rows.into_iter().flatten().collect());
        match Open::begin(sequence) {
            Ok(open) => *slot = Some(open),
            Err(ended) => self.source.done(ended),
        }
    }

    fn interrupted(&self) -> bool {
        self.source.interrupted()
    }
}
