//! Crossings of a switching surface: accuracy, motions that touch the surface, and two crossings within one step.

use std::ops::ControlFlow;

use flap_core::num::Real;
use flap_core::ode::solve::solve;
use flap_core::ode::{Ending, Ode, Outcome, Start, Tolerances};

/// x = cos t, with a clock that runs while x is below a threshold, so that the switching function is negative.
struct Clocked {
    threshold: f64,
    /// The factor k of the switching function 1 − e^(−k (x − threshold)); without k, the switching function is x −
    /// threshold.
    bend: Option<f64>,
}

impl Ode<3> for Clocked {
    type Constants<R: Real> = ();
    type Input<R: Real> = ();

    const SWITCHES: bool = true;

    fn input<R: Real>(&self, (): &(), _t: R) {}

    fn rhs<R: Real>(&self, (): &(), (): &(), side: R, y: &[R; 3]) -> [R; 3] {
        [y[1], -y[0], side * -0.5 + 0.5]
    }

    fn switch<R: Real>(&self, (): &(), y: &[R; 3], dy: &[R; 3]) -> [R; 2] {
        let distance = y[0] - self.threshold;
        match self.bend {
            None => [distance, dy[0]],
            Some(k) => {
                let power = (distance * -k).exp();
                [-power + 1.0, power * dy[0] * k]
            }
        }
    }
}

/// A crossing of the switching surface: its time (s), and the size of the largest step (s).
#[derive(Clone, Copy, Debug)]
struct Landing {
    t: f64,
    step: f64,
}

/// Time on the clock, crossings and outcome after `turns` turns from x = 1.
fn turns(ode: &Clocked, rtol: f64, turns: f64) -> (f64, Vec<Landing>, Outcome) {
    let tolerances = Tolerances { rtol, atol: rtol, max_steps: 10_000 };
    let start = Start::new((), [1.0, 0.0, 0.0], turns * std::f64::consts::TAU, [1.0; 3]);
    let (mut clock, mut landings) = (f64::NAN, Vec::new());
    let (mut last, mut end, mut largest) = (None, 0.0, 0.0_f64);
    let outcome = solve::<_, f64, 3>(
        ode,
        &tolerances,
        &start,
        |(), accepted| {
            if last.is_some_and(|side| side != accepted.side) {
                landings.push(Landing { t: end, step: 0.0 });
            }
            largest = largest.max(accepted.h);
            (last, end) = (Some(accepted.side), accepted.t + accepted.h);
        },
        |y| {
            clock = y[2];
            ControlFlow::Break(())
        },
    );
    assert_eq!(outcome.ending, Ending::Stopped);
    assert_eq!(outcome.switches as usize, landings.len());
    for landing in &mut landings {
        landing.step = largest;
    }
    (clock, landings, outcome)
}

/// The crossings of `cos t` and a threshold, in order.
fn crossings(threshold: f64, count: usize) -> Vec<f64> {
    let first = threshold.acos();
    let turn = |i: usize| (i / 2) as f64 * std::f64::consts::TAU;
    (0..count).map(|i| turn(i) + if i % 2 == 0 { first } else { std::f64::consts::TAU - first }).collect()
}

/// Crossings are located within a thousandth of a step, even if the cubic interpolation of the step is far from the
/// function.
#[test]
fn crossings_are_located_within_a_thousandth_of_a_step() {
    for (bend, rtol) in
        [(None, 1e-6), (None, 1e-9), (Some(5.0), 1e-6), (Some(20.0), 1e-6), (Some(-20.0), 1e-8)]
    {
        let ode = Clocked { threshold: -0.3, bend };
        let (clock, landings, _) = turns(&ode, rtol, 5.0);
        assert_eq!(landings.len(), 10, "{bend:?}");
        for (landing, exact) in landings.iter().zip(crossings(-0.3, 10)) {
            let error = (landing.t - exact).abs();
            assert!(
                error < 1e-3 * landing.step + 100.0 * rtol,
                "{bend:?} at {rtol:e}: {error:e} of {landing:?}"
            );
        }
        let exact = 10.0 * (std::f64::consts::PI - (-0.3_f64).acos());
        // With a negative factor the function has the other sign.
        let clock = if bend.is_some_and(|k| k < 0.0) { 5.0 * std::f64::consts::TAU - clock } else { clock };
        assert!(
            (clock - exact).abs() < 1e-3,
            "{bend:?} at {rtol:e}: the clock shows {clock} s, not {exact} s"
        );
    }
}

/// In each turn, x is below the threshold for 0.2 s, in steps of 0.27 s.
#[test]
fn two_crossings_within_a_step_are_found() {
    let threshold = -0.995;
    let (clock, landings, outcome) = turns(&Clocked { threshold, bend: None }, 1e-6, 5.0);
    let exact = 10.0 * (std::f64::consts::PI - threshold.acos());
    for (landing, exact) in landings.iter().zip(crossings(threshold, 10)) {
        assert!((landing.t - exact).abs() < 1e-3, "{landing:?}, not {exact} s");
    }
    println!("{clock} s, not {exact} s, in {} crossings and {} steps", landings.len(), outcome.attempts);
    assert!(landings[0].step > 0.25, "{landings:?}");
    assert_eq!(landings.len(), 10);
    // The amplitude errs by up to a hundredth of the depth of 5e-3.
    assert!((clock / exact - 1.0).abs() < 0.02, "{clock} s, not {exact} s");
}

/// A motion that comes near the switching surface or touches it needs almost no additional work.
#[test]
fn motions_that_touch_the_surface_go_on() {
    let attempts = |threshold: f64, rtol: f64| {
        let (clock, landings, outcome) = turns(&Clocked { threshold, bend: None }, rtol, 20.0);
        println!("{threshold}: {clock} s, {} crossings, {} steps", landings.len(), outcome.attempts);
        (clock, landings.len(), outcome.attempts)
    };
    let (_, _, far) = attempts(-1.5, 1e-6);
    assert_eq!(attempts(-1.001, 1e-6), (0.0, 0, far));
    let (clock, crossings, touching) = attempts(-1.0, 1e-6);
    // As deep as the amplitude errs.
    assert!(clock < 20.0 * 4.0 * (20.0 * 1e-6_f64).sqrt(), "{clock} s");
    assert!(
        crossings % 2 == 0 && touching < far + 20 * 8,
        "{crossings} crossings, {touching} steps for {far}"
    );
}
