//! Computations that wait for rows. The rows of earlier points determine the next points.
//!
//! Many computations are open at once, so the lanes stay full while each computation waits for its own rows.

use std::cell::Cell;
use std::convert::Infallible;
use std::future::poll_fn;
use std::ops::ControlFlow::{self, Break, Continue};
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

use flap_core::num::Backend;
use flap_core::simulate::{Jobs, Point, PointRun, Row, Rows, SolverSettings};

/// Exchange between a computation, which stores points, and its driver, which stores the rows of the points.
#[derive(Default)]
pub struct Exchange {
    points: Cell<Vec<Point>>,
    rows: Cell<Option<Vec<Row>>>,
}

impl Exchange {
    /// For the computation: runs points with any indices, and returns their rows in the order of the points.
    pub async fn rows(&self, points: Vec<Point>) -> Vec<Row> {
        if points.is_empty() {
            return Vec::new();
        }
        self.points.set(points);
        poll_fn(|_| self.rows.take().map_or(Poll::Pending, Poll::Ready)).await
    }
}

/// A computation with the result `T` that waits for rows.
pub struct Sequence<'a, T> {
    exchange: Rc<Exchange>,
    work: Pin<Box<dyn Future<Output = T> + 'a>>,
}

impl<'a, T> Sequence<'a, T> {
    /// Returns a computation. `work` begins the computation, which runs its points with the given exchange.
    pub fn new<F: Future<Output = T> + 'a>(work: impl FnOnce(Rc<Exchange>) -> F) -> Sequence<'a, T> {
        let exchange = Rc::new(Exchange::default());
        let work = Box::pin(work(Rc::clone(&exchange)));
        Sequence { exchange, work }
    }

    /// Continues the computation to its next points, which must be run, or to its result.
    fn next(&mut self) -> ControlFlow<T, Vec<Point>> {
        match self.work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(result) => Break(result),
            Poll::Pending => Continue(self.exchange.points.take()),
        }
    }

    /// Runs the computation with the rows that `run` returns for points.
    ///
    /// # Errors
    /// The first error of `run`.
    pub fn run<E>(mut self, mut run: impl FnMut(Vec<Point>) -> Result<Vec<Row>, E>) -> Result<T, E> {
        loop {
            match self.next() {
                Break(result) => return Ok(result),
                Continue(points) => self.exchange.rows.set(Some(run(points)?)),
            }
        }
    }

    /// Runs the computation on scalars, with the same bits as [`run_all`]. The points have the settings of `run`, but
    /// their own values.
    pub fn run_alone(self, rows: &dyn Rows, run: &PointRun<'_>) -> T {
        let row = |point: &Point| {
            rows.run_point(&PointRun { values: &point.values, ..*run }, point.begin.as_deref())
        };
        let Ok(result) = self.run(|points| Ok::<_, Infallible>(points.iter().map(row).collect()));
        result
    }
}

/// Source of computations, and receiver of their results.
pub trait SequenceSource<'a> {
    /// Result of a computation.
    type Output;

    /// Returns the next computation, or `None` if no computation is available at present.
    ///
    /// If `idle` is true, nothing is running: the call may wait, and `None` means that there are no more computations.
    fn next(&mut self, idle: bool) -> Option<Sequence<'a, Self::Output>>;

    /// Receives the result of a computation.
    fn done(&mut self, result: Self::Output);

    /// Returns true to end at once, see [`Jobs::interrupted`]. Open computations are discarded.
    fn interrupted(&self) -> bool;
}

/// Largest number of open computations without a point to run.
const MOST_OPEN: usize = 256;

/// Runs the computations of `source` on the lanes of `backend` until no computations are left.
pub fn run_all<'a>(
    rows: &dyn Rows,
    backend: Backend,
    solver: &SolverSettings,
    source: &mut impl SequenceSource<'a>,
) {
    rows.run(backend, solver, &mut Interleaved { source, open: Vec::new() });
}

/// The points of open computations as one stream.
struct Interleaved<'s, 'a, S: SequenceSource<'a>> {
    source: &'s mut S,
    open: Vec<Option<Open<'a, S::Output>>>,
}

/// A computation whose points wait or are running.
struct Open<'a, T> {
    sequence: Sequence<'a, T>,
    /// Points that have not begun, with the next point last, each with its index among the points of the computation.
    waiting: Vec<(usize, Point)>,
    /// Rows of the points that were received so far.
    rows: Vec<Option<Row>>,
    missing: usize,
}

impl<'a, T> Open<'a, T> {
    /// Returns the computation with its next points, or its result.
    fn begin(mut sequence: Sequence<'a, T>) -> ControlFlow<T, Open<'a, T>> {
        let points = match sequence.next() {
            Continue(points) => points,
            Break(result) => return Break(result),
        };
        let missing = points.len();
        let rows = points.iter().map(|_| None).collect();
        Continue(Open { sequence, waiting: points.into_iter().enumerate().rev().collect(), rows, missing })
    }
}

/// Distance between the indices of computations: each computation begins at a multiple of this number.
const STRIDE: u64 = 1 << 32;

impl<'a, S: SequenceSource<'a>> Interleaved<'_, 'a, S> {
    /// Returns a point that can begin now.
    fn waiting(&mut self) -> Option<Point> {
        for (slot, open) in (0_u64..).zip(&mut self.open) {
            if let Some((place, point)) = open.as_mut().and_then(|open| open.waiting.pop()) {
                let index = slot * STRIDE + place as u64;
                return Some(Point { index, ..point });
            }
        }
        None
    }

    /// Opens another computation. Returns false if no computation is available at present.
    fn open_another(&mut self, idle: bool) -> bool {
        loop {
            let Some(sequence) = self.source.next(idle) else { return false };
            match Open::begin(sequence) {
                Break(result) => self.source.done(result),
                Continue(open) => {
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

impl<'a, S: SequenceSource<'a>> Jobs for Interleaved<'_, 'a, S> {
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
        let Open { sequence, rows, .. } = open;
        sequence.exchange.rows.set(Some(rows.into_iter().flatten().collect()));
        match Open::begin(sequence) {
            Continue(open) => *slot = Some(open),
            Break(result) => self.source.done(result),
        }
    }

    fn interrupted(&self) -> bool {
        self.source.interrupted()
    }
}
