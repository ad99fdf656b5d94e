//! States at the end of a span.

use std::ops::ControlFlow;

use flap_core::ode::solve::solve;
use flap_core::ode::{Ending, Ode, Start, Tolerances};

/// The state at the end of the first span of a run, which must not fail.
pub(crate) fn end<O: Ode<N>, const N: usize>(
    ode: &O,
    tolerances: &Tolerances,
    start: &Start<O::Constants<f64>, N>,
) -> [f64; N] {
    let mut end = start.y;
    let outcome = solve::<O, f64, N>(
        ode,
        tolerances,
        start,
        |_, _| {},
        |y| {
            end = *y;
            ControlFlow::Break(())
        },
    );
    assert_eq!(outcome.ending, Ending::Stopped);
    end
}
