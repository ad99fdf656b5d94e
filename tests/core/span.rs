//! States at the end of a span.

use std::ops::ControlFlow;

use flap_core::ode::solve::solve;
use flap_core::ode::{Ending, Ode, Outcome, Start, Tolerances};

use crate::data::assert_close;

/// Tolerances that allow 100,000 steps in a span.
pub(crate) fn tolerances(rtol: f64) -> Tolerances {
    Tolerances { rtol, atol: 1e-2 * rtol, max_steps: 100_000 }
}

/// The first span of a run.
pub(crate) struct Span<const N: usize> {
    /// The state at the end of the span; the state at its beginning if the run has failed.
    pub(crate) end: [f64; N],
    pub(crate) outcome: Outcome,
    /// Steps accepted.
    pub(crate) accepted: u64,
}

/// The first span of a run.
pub(crate) fn run<O: Ode<N>, const N: usize>(
    ode: &O,
    tolerances: &Tolerances,
    start: &Start<O::Constants<f64>, N>,
) -> Span<N> {
    let mut end = start.y;
    let mut accepted = 0;
    let outcome = solve::<O, f64, N>(
        ode,
        tolerances,
        start,
        |_, _| accepted += 1,
        |y| {
            end = *y;
            ControlFlow::Break(())
        },
    );
    Span { end, outcome, accepted }
}

/// The state at the end of the first span of a run, which must not fail.
pub(crate) fn end<O: Ode<N>, const N: usize>(
    ode: &O,
    tolerances: &Tolerances,
    start: &Start<O::Constants<f64>, N>,
) -> [f64; N] {
    let Span { end, outcome, .. } = run(ode, tolerances, start);
    assert_eq!(outcome.ending, Ending::Stopped);
    end
}

/// Fails unless `energy` has the same value at both ends of a span, within the relative tolerance `bound`. Also fails
/// if the state does not change.
pub(crate) fn assert_conserved<O: Ode<N>, const N: usize>(
    ode: &O,
    tolerances: &Tolerances,
    start: &Start<O::Constants<f64>, N>,
    bound: f64,
    energy: impl Fn(&[f64; N]) -> f64,
    what: &str,
) {
    let last = end(ode, tolerances, start);
    assert!(last != start.y, "{what}: nothing moved");
    assert_close(energy(&last), energy(&start.y), bound, what);
}
