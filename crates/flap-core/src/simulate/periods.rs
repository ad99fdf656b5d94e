//! The drive periods that a search requests, and the exchange of requests and results between the search and
//! the driver. The driver integrates the requested periods.

use core::cell::Cell;
use core::future::poll_fn;
use core::task::Poll;

use crate::measure::cycle::SumsOf;
use crate::measure::multipliers::Matrix;
use crate::model::Model;
use crate::ode::ensemble::Restart;
use crate::ode::{Outcome, Start};

/// Quantities that are integrated over a period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// States alone.
    States,
    /// States, and the derivatives of the states with respect to the initial state.
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
    /// Start of the period. `None` requests the next period of the run, from the state at the end of the last
    /// period.
    pub(super) begin: Option<Restart<N>>,
}

/// Results at the end of a period. `T` is the type of the sums over the signals.
#[derive(Clone, Debug)]
pub(super) struct PeriodEnd<T, const N: usize> {
    /// State.
    pub(super) y: [f64; N],
    /// Largest magnitude of each state since the start of the run, for [`Kind::States`], otherwise NaN.
    pub(super) largest: [f64; N],
    /// Monodromy matrix in units of the states' typical sizes, for [`Kind::Responses`], otherwise NaN.
    pub(super) monodromy: Matrix<N>,
    /// Sums over the signals, for [`Kind::Means`] and [`Kind::Signals`], otherwise `None`.
    pub(super) sums: Option<Box<T>>,
    /// Reason for the end of the integration, and the costs since the start of the run.
    pub(super) outcome: Outcome,
}

impl<T, const N: usize> PeriodEnd<T, N> {
    /// Returns the results of a period, of which only the state and the outcome are known.
    pub(super) fn new(y: [f64; N], outcome: Outcome) -> Self {
        PeriodEnd { y, largest: [f64::NAN; N], monodromy: [[f64::NAN; N]; N], sums: None, outcome }
    }
}

/// Exchange between a search and the driver. The search stores a request for a period, and the driver stores
/// the results of the period.
pub(super) struct Exchange<M: Model<N>, const N: usize> {
    /// Constants and initial state of the point, which the search and the driver read.
    pub(super) start: Start<M::Constants<f64>, N>,
    request: Cell<Option<Request<N>>>,
    end: Cell<Option<PeriodEnd<SumsOf<M, N>, N>>>,
    /// Allocated memory for sums over the signals, which the next measured period uses again.
    spare: Cell<Option<Box<SumsOf<M, N>>>>,
}

impl<M: Model<N>, const N: usize> Exchange<M, N> {
    pub(super) fn new(start: Start<M::Constants<f64>, N>) -> Self {
        Exchange { start, request: Cell::new(None), end: Cell::new(None), spare: Cell::new(None) }
    }

    /// Requests the integration of a period from the driver, and waits until the driver has stored the result.
    /// The search calls this function.
    pub(super) async fn period(&self, request: Request<N>) -> PeriodEnd<SumsOf<M, N>, N> {
        self.request.set(Some(request));
        poll_fn(|_| self.end.take().map_or(Poll::Pending, Poll::Ready)).await
    }

    /// Stores the box of `totals`, so that the next measured period needs no new memory. The search calls
    /// this function.
    pub(super) fn reuse(&self, totals: Option<Box<SumsOf<M, N>>>) {
        self.spare.set(totals);
    }

    /// Returns `totals` in a box, which is the stored box if there is one. The driver calls this function.
    pub(super) fn boxed(&self, totals: SumsOf<M, N>) -> Box<SumsOf<M, N>> {
        match self.spare.take() {
            Some(mut spare) => {
                *spare = totals;
                spare
            }
            None => Box::new(totals),
        }
    }

    /// Returns the request that the search has stored for the next period. The driver calls this function.
    pub(super) fn request(&self) -> Option<Request<N>> {
        self.request.get()
    }

    /// Stores the results of the requested period. The driver calls this function.
    pub(super) fn finish(&self, end: PeriodEnd<SumsOf<M, N>, N>) {
        self.end.set(Some(end));
    }
}
