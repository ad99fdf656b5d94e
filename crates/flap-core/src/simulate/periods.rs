//! Drive periods that a search requests, and their exchange with the driver that integrates them.

use core::cell::Cell;
use core::future::poll_fn;
use core::task::Poll;

use crate::measure::multipliers::Matrix;
use crate::ode::Outcome;
use crate::ode::ensemble::Restart;

/// Quantities that are integrated over a period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// States alone.
    States,
    /// States and their responses to changes of the initial state.
    Responses,
    /// States, and means and first harmonics of the signals.
    Means,
    /// States, and all sums and extrema of the signals.
    Signals,
}

impl Kind {
    /// All kinds.
    pub(super) const ALL: [Kind; 4] = [Kind::States, Kind::Responses, Kind::Means, Kind::Signals];
}

/// A requested period.
#[derive(Clone, Copy, Debug)]
pub(super) struct Request<const N: usize> {
    pub(super) kind: Kind,
    /// Start of the period; `None` for the next period of the same run.
    pub(super) begin: Option<Restart<N>>,
}

/// End of a period, with totals `T` over the signals.
#[derive(Clone, Debug)]
pub(super) struct PeriodEnd<T, const N: usize> {
    /// State.
    pub(super) y: [f64; N],
    /// Largest magnitude of each state since the start of the run; for [`Kind::States`].
    pub(super) largest: [f64; N],
    /// Monodromy matrix in units of the states' typical sizes; for [`Kind::Responses`].
    pub(super) monodromy: Matrix<N>,
    /// Sums over the signals; for [`Kind::Means`] and [`Kind::Signals`].
    pub(super) sums: Option<Box<T>>,
    /// Ending, and cost since the start of the run.
    pub(super) outcome: Outcome,
}

impl<T, const N: usize> PeriodEnd<T, N> {
    /// Returns a period without other quantities.
    pub(super) fn new(y: [f64; N], outcome: Outcome) -> Self {
        PeriodEnd { y, largest: [f64::NAN; N], monodromy: [[f64::NAN; N]; N], sums: None, outcome }
    }
}

/// Exchange between a search, which stores its request, and the driver, which stores the end of the period.
pub(super) struct Exchange<T, const N: usize> {
    request: Cell<Option<Request<N>>>,
    end: Cell<Option<PeriodEnd<T, N>>>,
    /// A box of totals that can be used again.
    spare: Cell<Option<Box<T>>>,
}

impl<T, const N: usize> Exchange<T, N> {
    pub(super) fn new() -> Self {
        Exchange { request: Cell::new(None), end: Cell::new(None), spare: Cell::new(None) }
    }

    /// For the search: requests a period and waits for its end.
    pub(super) async fn period(&self, request: Request<N>) -> PeriodEnd<T, N> {
        self.request.set(Some(request));
        poll_fn(|_| self.end.take().map_or(Poll::Pending, Poll::Ready)).await
    }

    /// For the search: returns totals for reuse, so that a repeated measurement does not allocate.
    pub(super) fn reuse(&self, totals: Option<Box<T>>) {
        self.spare.set(totals);
    }

    /// For the driver: returns totals in a box.
    pub(super) fn boxed(&self, totals: T) -> Box<T> {
        match self.spare.take() {
            Some(mut spare) => {
                *spare = totals;
                spare
            }
            None => Box::new(totals),
        }
    }

    /// For the driver: returns the request of a waiting search.
    pub(super) fn request(&self) -> Option<Request<N>> {
        self.request.get()
    }

    /// For the driver: stores the end of the requested period.
    pub(super) fn finish(&self, end: PeriodEnd<T, N>) {
        self.end.set(Some(end));
    }
}
