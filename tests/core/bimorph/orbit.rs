//! Orbits and transients from any initial state, which a grid file cannot set.

use std::ops::ControlFlow;

use flap_core::measure::cycle::{self, Sums, finish};
use flap_core::model::bimorph::{Bimorph, Params, Signals};
use flap_core::model::{Model, SignalCycle};
use flap_core::num::PerLane;
use flap_core::ode::ensemble::Observer;
use flap_core::ode::solve::solve;
use flap_core::ode::{Ending, Start};

use crate::rows::worse;
use crate::span::tolerances;

/// The run of a point from the state `y`.
fn start(p: &Params, y: [f64; 4]) -> Start<<Bimorph as flap_core::ode::Ode<4>>::Constants<f64>, 4> {
    Start { y, ..Bimorph::SINE.start(&p.to_values()).unwrap() }
}

/// The state after some drive periods from `y`.
pub(super) fn march(p: &Params, y: [f64; 4], cycles: u32, rtol: f64) -> [f64; 4] {
    let start = start(p, y);
    let (mut end, mut ended) = (y, 0);
    if cycles == 0 {
        return end;
    }
    let outcome = solve::<_, f64, 4>(
        &Bimorph::SINE.variant(&p.to_values()),
        &tolerances(rtol),
        &start,
        |_, _| {},
        |y| {
            end = *y;
            ended += 1;
            if ended == cycles { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    );
    assert_eq!(outcome.ending, Ending::Stopped);
    end
}

/// The signals over one drive period from `y`, and the number of evaluations of the right-hand side in this period.
pub(super) fn cycle(p: &Params, y: [f64; 4], rtol: f64) -> (Signals<SignalCycle>, u64) {
    let start = start(p, y);
    let model = Bimorph::SINE.variant(&p.to_values());
    let observer = cycle::SignalObserver::all(&model);
    let mut totals = Sums::<Signals, f64>::fill(0.0, &Observer::<Bimorph, 4>::nothing(&observer));
    let outcome = solve::<_, f64, 4>(
        &model,
        &tolerances(rtol),
        &start,
        |c, accepted| observer.add(c, accepted, true, &mut totals),
        |_| ControlFlow::Break(()),
    );
    assert_eq!(outcome.ending, Ending::Stopped);
    (finish::<Signals>(&totals, start.span), outcome.rhs_evals)
}

/// Largest difference of two states, in units of the sizes that the reference tables use.
pub(super) fn distance(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    let scale = [3e-4, 0.25, 1.0, 800.0];
    (0..4).map(|i| (a[i] - b[i]).abs() / scale[i]).fold(0.0, worse)
}
