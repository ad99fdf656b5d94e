//! Extrema in the quarters of a drive period.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::ControlFlow;

use flap_core::measure::cycle;
use flap_core::measure::quarters::{InQuarters, Quarters};
use flap_core::model::Model;
use flap_core::num::PerLane;
use flap_core::ode::ensemble::Observer;
use flap_core::ode::solve::solve;
use flap_core::ode::{Ending, Start, Tolerances};

use crate::own_model::{OMEGA, Oscillator, Params, Signals};

/// At these tolerances the steps are a seventh of the period, so some steps overlap two quarters. The stroke sin(ωt +
/// φ) has one largest and one smallest value in a period.
#[test]
fn an_extremum_is_in_the_quarter_of_its_own_time() {
    let tolerances = Tolerances { rtol: 1e-2, atol: 1e-3, max_steps: 100 };
    for phase in (0..40).map(|i| TAU * f64::from(i) / 40.0) {
        let free = Params { drive_strength: 0.0, load: 0.0, decay: 1e-6 };
        let start = Oscillator.start(&free.to_values()).unwrap();
        let start = Start { y: [phase.sin(), OMEGA * phase.cos()], ..start };
        let observer = Quarters(cycle::SignalObserver::all(&Oscillator));
        let mut totals =
            InQuarters::<Signals, f64>::fill(0.0, &Observer::<Oscillator, 2>::nothing(&observer));
        let outcome = solve::<_, f64, 2>(
            &Oscillator,
            &tolerances,
            &start,
            |c, accepted| observer.add(c, accepted, true, &mut totals),
            |_| ControlFlow::Break(()),
        );
        assert_eq!(outcome.ending, Ending::Stopped);
        assert!(outcome.rhs_evals < 12 * 6, "{} right-hand sides", outcome.rhs_evals);
        let ranges = totals.1.0.stroke;
        // The first quarter begins at −0.37.
        let quarter = |at: f64| {
            let place = (at - phase + 0.37).rem_euclid(TAU);
            [FRAC_PI_2, PI, 3.0 * FRAC_PI_2].into_iter().filter(|begin| *begin <= place).count()
        };
        let (largest, smallest) = (quarter(FRAC_PI_2), quarter(3.0 * FRAC_PI_2));
        assert!((ranges[largest][1] - 1.0).abs() < 0.02, "largest at phase {phase}: {ranges:?}");
        assert!((ranges[smallest][0] + 1.0).abs() < 0.02, "smallest at phase {phase}: {ranges:?}");
    }
}
