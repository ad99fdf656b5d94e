//! Drive periods that a search asks for, and their exchange with the driver that integrates them.

use core::cell::Cell;
use core::future::poll_fn;
use core::task::Poll;

use crate::measure::multipliers::Matrix;
use crate::ode::Outcome;
use crate::ode::ensemble::Restart;

/// The quantities that are integrated over a period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The states alone.
    States,
    /// The states, with their responses to changes of the initial state.
    Responses,
    /// The states, with means and first harmonics of the signals.
    Means,
    /// The states, with all sums and extrema of the signals.
    Signals,
}

impl Kind {
    /// All kinds.
    pub(super) const ALL: [Kind; 4] = [Kind::States, Kind::Responses, Kind::Means, Kind::Signals];
}

/// A period that a search asks for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Request<const N: usize> {
    pub(super) kind: Kind,
    /// Its beginning; `None` for the next period of the same run.
    pub(super) begin: Option<Restart<N>>,
}

/// The end of a period, with totals `T` over the signals.
#[derive(Clone, Debug)]
pub(super) struct PeriodEnd<T, const N: usize> {
    /// The state.
    pub(super) y: [f64; N],
    /// Largest magnitude of each state since the beginning of the run; known of [`Kind::States`].
    pub(super) largest: [f64; N],
    /// The monodromy matrix in units of the states' typical sizes; known of [`Kind::Responses`].
    pub(super) monodromy: Matrix<N>,
    /// Sums over the signals; known of [`Kind::Means`] and [`Kind::Signals`].
    pub(super) sums: Option<Box<T>>,
    /// The ending, and the cost since the beginning of the run.
    pub(super) outcome: Outcome,
}

impl<T, const N: usize> PeriodEnd<T, N> {
    /// A period of which nothing else is known.
    pub(super) fn new(y: [f64; N], outcome: Outcome) -> Self {
        PeriodEnd { y, largest: [f64::NAN; N], monodromy: [[f64::NAN; N]; N], sums: None, outcome }
    }
}

/// The place where a search leaves its request, and the driver the end of the period with totals `T` over the signals.
pub(super) struct Exchange<T, const N: usize> {
    request: Cell<Option<Request<N>>>,
    end: Cell<Option<PeriodEnd<T, N>>>,
    /// A box of totals that are not needed any more.
    spare: Cell<Option<Box<T>>>,
}

impl<T, const N: usize> Exchange<T, N> {
    pub(super) fn new() -> Self {
        Exchange { request: Cell::new(None), end: Cell::new(None), spare: Cell::new(None) }
    }

    /// For the search: waits for a period.
    pub(super) async fn period(&self, request: Request<N>) -> PeriodEnd<T, N> {
        self.request.set(Some(request));
        poll_fn(|_| self.end.take().map_or(Poll::Pending, Poll::Ready)).await
    }

    /// For the search: gives back totals, so that a period that is measured again allocates nothing.
    pub(super) fn reuse(&self, totals: Option<Box<T>>) {
        self.spare.set(totals);
    }

    /// For the driver: totals in a box.
    pub(super) fn boxed(&self, totals: T) -> Box<T> {
        match self.spare.take() {
            Some(mut spare) => {
                *spare = totals;
                spare
            }
            None => Box::new(totals),
        }
    }

    /// For the driver: the request of a search that waits.
    pub(super) fn request(&self) -> Option<Request<N>> {
        self.request.get()
    }

    /// For the driver: hands over the end of the period that was asked for.
    pub(super) fn finish(&self, end: PeriodEnd<T, N>) {
        self.end.set(Some(end));
    }
}
