//! Computations in which the rows of earlier points determine the next points.
//!
//! Many computations run at the same time, so that no lane is empty while a computation waits for its rows.

use std::cell::Cell;
use std::convert::Infallible;
use std::future::poll_fn;
use std::ops::ControlFlow::{self, Break, Continue};
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

use flap_core::num::Backend;
use flap_core::simulate::{Jobs, Point, PointRun, Row, Rows, SolverSettings};

/// Connection between a computation and the code that simulates the points of the computation. The
/// computation stores points in the exchange, and the simulating code stores the rows of these points in the
/// exchange.
#[derive(Default)]
pub struct Exchange {
    points: Cell<Vec<Point>>,
    rows: Cell<Option<Vec<Row>>>,
}

impl Exchange {
    /// A computation calls this function to run points. The function waits for the rows of the points, and
    /// returns the rows in the order of the points. The indices of the points have no effect on the order of
    /// the rows.
    pub async fn rows(&self, points: Vec<Point>) -> Vec<Row> {
        if points.is_empty() {
            return Vec::new();
        }
        self.points.set(points);
        poll_fn(|_| self.rows.take().map_or(Poll::Pending, Poll::Ready)).await
    }
}

/// A computation that waits for the rows of its points, and finally returns a result of the type `T`.
pub struct Sequence<'a, T> {
    exchange: Rc<Exchange>,
    work: Pin<Box<dyn Future<Output = T> + 'a>>,
}

impl<'a, T> Sequence<'a, T> {
    /// Returns the computation that `work` creates. `work` receives an [`Exchange`], through which the
    /// computation gets the rows of its points.
    pub fn new<F: Future<Output = T> + 'a>(work: impl FnOnce(Rc<Exchange>) -> F) -> Sequence<'a, T> {
        let exchange = Rc::new(Exchange::default());
        let work = Box::pin(work(Rc::clone(&exchange)));
        Sequence { exchange, work }
    }

    /// Continues the computation until it ends or requires the rows of its next points. Returns the result of
    /// the computation, or the points whose rows it requires.
    fn next(&mut self) -> ControlFlow<T, Vec<Point>> {
        match self.work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            Poll::Ready(result) => Break(result),
            Poll::Pending => Continue(self.exchange.points.take()),
        }
    }

    /// Runs the whole computation. The function `run` must return the rows of the points that it receives.
    ///
    /// # Errors
    /// Returns the first error of `run`.
    pub fn run<E>(mut self, mut run: impl FnMut(Vec<Point>) -> Result<Vec<Row>, E>) -> Result<T, E> {
        loop {
            match self.next() {
                Break(result) => return Ok(result),
                Continue(points) => self.exchange.rows.set(Some(run(points)?)),
            }
        }
    }

    /// Runs the computation on scalars. The result is the same as the result of [`run_all`], bit for bit.
    /// Each point is computed with its own parameter values, and with the settings of `run`.
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
    /// If `idle` is true, no point is being computed, so the call may wait for a computation. If `idle` is
    /// true, `None` means that all computations have been returned.
    fn next(&mut self, idle: bool) -> Option<Sequence<'a, Self::Output>>;

    /// Receives the result of a computation.
    fn done(&mut self, result: Self::Output);

    /// Returns true if the run must end at once, as [`Jobs::interrupted`] does. Unfinished computations are
    /// then discarded.
    fn interrupted(&self) -> bool;
}

/// Largest number of computations that are unfinished at the same time.
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

/// Passes the points of all unfinished computations to the simulator, as one stream of points.
struct Interleaved<'s, 'a, S: SequenceSource<'a>> {
    source: &'s mut S,
    open: Vec<Option<Open<'a, S::Output>>>,
}

/// An unfinished computation, whose latest points wait for a lane or are being simulated.
struct Open<'a, T> {
    sequence: Sequence<'a, T>,
    /// Points whose simulation has not begun, in reverse order. The number in front of each point is the
    /// index of the point in the latest list of points of the computation.
    waiting: Vec<(usize, Point)>,
    /// Row of each point, or `None` if the row has not been received.
    rows: Vec<Option<Row>>,
    missing: usize,
}

impl<'a, T> Open<'a, T> {
    /// Continues a computation. Returns the result of the computation if the computation has ended, and
    /// otherwise the computation with its next points.
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

/// The point indices of each computation begin at a multiple of this number, so that the index of a point
/// identifies the computation.
const STRIDE: u64 = 1 << 32;

impl<'a, S: SequenceSource<'a>> Interleaved<'_, 'a, S> {
    /// Returns a waiting point of one of the unfinished computations.
    fn waiting(&mut self) -> Option<Point> {
        for (slot, open) in (0_u64..).zip(&mut self.open) {
            if let Some((place, point)) = open.as_mut().and_then(|open| open.waiting.pop()) {
                let index = slot * STRIDE + place as u64;
                return Some(Point { index, ..point });
            }
        }
        None
    }

    /// Begins another computation. Returns false if no computation is available at present.
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
