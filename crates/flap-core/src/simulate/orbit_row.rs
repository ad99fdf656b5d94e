//! Rows from the ends of searches.

use super::estimate::{Compared, LEAST, estimate};
use super::row::Row;
use super::search::Search;
use super::settings::SolverSettings;
use super::status::Status;
use crate::measure::cycle::{Sums, finish};
use crate::model::{Model, Principal, SignalCycle};
use crate::ode::{Ending, Start, input, slope};

/// The largest change per period of a motion that counts as rest, as a share of its largest state.
const REST: f64 = 1e-11;

/// The smallest range of a signal that certainly swings, as a share of the signal's size.
const SWINGS: f64 = 1e-6;

/// Times at which a motion at rest has no rate, as shares of the drive period: no drive of few harmonics is zero at all.
const REST_TIMES: [f64; 4] = [0.0, 0.137, 0.412, 0.789];

/// The measures of a periodic cycle, one per column, and the mean load if `solver` asks for it.
pub(super) fn measures<M: Model<N, S>, const N: usize, const S: usize>(
    model: &M,
    solver: &SolverSettings,
    c: &M::Constants<f64>,
    totals: &Sums<f64, S>,
    period: f64,
) -> Vec<f64> {
    let mut measures = values(model, c, &on_orbit::<M, N, S>(totals, period));
    if solver.loads {
        measures.extend(totals.1.map(|sum| sum / period));
    }
    measures
}

/// The signals of a periodic cycle.
fn on_orbit<M: Model<N, S>, const N: usize, const S: usize>(
    totals: &Sums<f64, S>,
    period: f64,
) -> [SignalCycle; S] {
    let mut cycle = finish::<M, N, S>(totals, period);
    if let Some(energy) = M::ENERGY {
        energy.close(&mut cycle);
    }
    cycle
}

/// The values of the columns, from the signals of a periodic cycle.
fn values<M: Model<N, S>, const N: usize, const S: usize>(
    model: &M,
    c: &M::Constants<f64>,
    cycle: &[SignalCycle; S],
) -> Vec<f64> {
    let mut values = Vec::new();
    for (signal, cycle) in M::SIGNALS.iter().zip(cycle) {
        values.extend(signal.measures.iter().map(|&measure| cycle.measure(measure) * signal.unit.factor));
    }
    // A derived column without a finite value, such as a ratio to zero, is empty.
    let finite = |value: f64| if value.is_finite() { value } else { f64::NAN };
    values.extend(M::DERIVED.iter().map(|derived| finite((derived.value)(model, c, cycle))));
    values
}

/// The row of a point whose search has ended without an orbit of one drive period; or the `last` row that it has, if it
/// was an orbit to be found more exactly.
pub(super) fn unsettled<const N: usize>(search: &Search<N>, last: Option<Row>) -> Row {
    if let Some(last) = last {
        return charged(last, search);
    }
    let status = match (search.ending(), search.period()) {
        (Ending::Stopped, Some(_)) => Status::Subharmonic,
        (Ending::Stopped, None) => Status::Unsettled,
        (Ending::Diverged, _) => Status::Diverged,
        (Ending::StepLimit, _) => Status::StepLimit,
    };
    row(search, status)
}

/// The row of a point after a period of its orbit, and one with coarser tolerances, have been integrated, and its energy
/// audit.
pub(super) fn measured<M: Model<N, S>, const N: usize, const S: usize>(
    search: &Search<N>,
    model: &M,
    solver: &SolverSettings,
    start: &Start<M::Constants<f64>, N>,
    periods: &Compared<S>,
) -> (Row, f64) {
    let status = match periods.ending {
        Ending::Stopped => Status::Periodic,
        Ending::Diverged => Status::Diverged,
        Ending::StepLimit => Status::StepLimit,
    };
    let mut row = row(search, status);
    let mut audit = f64::NAN;
    let cycle = |totals: &Sums<f64, S>| on_orbit::<M, N, S>(totals, start.span);
    if let Some(totals) = &periods.fine {
        row.measures = measures(model, solver, &start.constants, totals, start.span);
        let fine = cycle(totals);
        let coarse = periods.coarse.as_ref().map(cycle);
        row.error_estimate =
            estimate::<M, N, S>(&fine, coarse.as_ref(), periods.slides).max(LEAST * search.rtol());
        audit = M::ENERGY.map_or(0.0, |energy| energy.audit(&fine));
        if !swings::<M, N, S>(&fine) && search.state().is_some_and(|y| is_at_rest(model, start, y)) {
            row.floquet_max = f64::NAN;
        }
    }
    // A signal with an infinite measure has diverged as far as numbers go.
    if row.measures.iter().any(|measure| measure.is_infinite()) {
        row.status = Status::Diverged;
        row.measures.clear();
    }
    if row.status != Status::Periodic {
        row.period = 0;
        row.floquet_max = f64::NAN;
        row.error_estimate = f64::NAN;
    }
    (row, audit)
}

/// True if a signal with a principal first harmonic varies: then the motion is not at rest, and its states need not be looked
/// at.
fn swings<M: Model<N, S>, const N: usize, const S: usize>(cycle: &[SignalCycle; S]) -> bool {
    let mut signals = M::SIGNALS.iter().zip(cycle);
    signals.any(|(signal, cycle)| {
        signal.principal == Some(Principal::First) && cycle.max - cycle.min > SWINGS * cycle.size()
    })
}

/// True if a motion from the state `y` does not move, but for rounding: at several times of the drive period, no state
/// changes in a period by more than a tiny share of the largest state, in units of their typical sizes.
fn is_at_rest<M: Model<N, S>, const N: usize, const S: usize>(
    model: &M,
    start: &Start<M::Constants<f64>, N>,
    y: &[f64; N],
) -> bool {
    let largest = |of: &[f64; N]| (0..N).fold(0.0, |size: f64, i| size.max(of[i].abs() / start.scale[i]));
    let limit = REST * largest(y);
    REST_TIMES.iter().all(|share| {
        let u = input(model, &start.constants, share * start.span);
        let rate = slope(model, &start.constants, &u, 1.0, y);
        largest(&rate) * start.span <= limit
    })
}

/// A row with all that its point has cost.
pub(super) fn charged<const N: usize>(row: Row, search: &Search<N>) -> Row {
    Row { cycles: search.cycles(), rhs_evals: search.rhs_evals(), ..row }
}

/// The row of a search without measures.
fn row<const N: usize>(search: &Search<N>, status: Status) -> Row {
    Row {
        cycles: search.cycles(),
        residual: search.residual(),
        period: search.period().unwrap_or(0),
        floquet_max: search.floquet_max(),
        state: search.state().map_or_else(Vec::new, |state| state.to_vec()),
        rhs_evals: search.rhs_evals(),
        ..Row::empty(status)
    }
}
