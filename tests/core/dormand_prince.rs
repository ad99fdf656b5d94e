//! The method: order conditions, order, cost, published runs.

use std::ops::ControlFlow;

use flap_core::num::Real;
use flap_core::ode::solve::solve;
use flap_core::ode::step::Step;
use flap_core::ode::tableau::{A, B, C, D, E, STAGES};
use flap_core::ode::{Ending, Ode, Start, Tolerances};

use crate::span::{self, Span};

fn dot(x: [f64; STAGES], y: [f64; STAGES]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// Componentwise product.
fn by(x: [f64; STAGES], y: [f64; STAGES]) -> [f64; STAGES] {
    std::array::from_fn(|i| x[i] * y[i])
}

fn a_times(x: [f64; STAGES]) -> [f64; STAGES] {
    std::array::from_fn(|i| A[i].iter().zip(x).map(|(a, x)| a * x).sum())
}

/// The 17 conditions of order 5, Hairer, Nørsett and Wanner I, Table II.2.1: left-hand side, right-hand side.
fn order_conditions(b: [f64; STAGES]) -> Vec<(usize, f64, f64)> {
    let one = [1.0; STAGES];
    let c = C;
    let c2 = by(c, c);
    let ac = a_times(c);
    vec![
        (1, dot(b, one), 1.0),
        (2, dot(b, c), 1.0 / 2.0),
        (3, dot(b, c2), 1.0 / 3.0),
        (3, dot(b, ac), 1.0 / 6.0),
        (4, dot(b, by(c2, c)), 1.0 / 4.0),
        (4, dot(b, by(c, ac)), 1.0 / 8.0),
        (4, dot(b, a_times(c2)), 1.0 / 12.0),
        (4, dot(b, a_times(ac)), 1.0 / 24.0),
        (5, dot(b, by(c2, c2)), 1.0 / 5.0),
        (5, dot(b, by(c2, ac)), 1.0 / 10.0),
        (5, dot(b, by(ac, ac)), 1.0 / 20.0),
        (5, dot(b, by(c, a_times(c2))), 1.0 / 15.0),
        (5, dot(b, by(c, a_times(ac))), 1.0 / 30.0),
        (5, dot(b, a_times(by(c2, c))), 1.0 / 20.0),
        (5, dot(b, a_times(by(c, ac))), 1.0 / 40.0),
        (5, dot(b, a_times(a_times(c2))), 1.0 / 60.0),
        (5, dot(b, a_times(a_times(ac))), 1.0 / 120.0),
    ]
}

#[test]
fn solution_satisfies_all_conditions_of_order_5() {
    for (order, left, right) in order_conditions(B) {
        assert!((left - right).abs() < 2e-15, "order {order}: {left} is not {right}");
    }
}

#[test]
fn embedded_solution_satisfies_the_conditions_of_order_4_and_no_more() {
    let embedded: [f64; STAGES] = std::array::from_fn(|i| B[i] - E[i]);
    let conditions = order_conditions(embedded);
    for (order, left, right) in conditions.iter().filter(|(order, ..)| *order <= 4) {
        assert!((left - right).abs() < 2e-15, "order {order}: {left} is not {right}");
    }
    assert!(conditions.iter().any(|(_, left, right)| (left - right).abs() > 1e-5));
}

/// y(θ) of the continuous extension has order 4 for every θ: Σ bᵢ(θ) cᵢ^q = θ^{q+1}/(q + 1).
#[test]
fn continuous_extension_has_order_4() {
    for theta in [0.1_f64, 0.3, 0.5, 0.9] {
        // The weights bᵢ(θ), from the formula in `dense`.
        let weights: [f64; STAGES] = std::array::from_fn(|i| {
            let (first, last) = (f64::from(i == 0), f64::from(i == 6));
            let bend = first - B[i];
            let inner = bend + theta * (B[i] - last - bend + (1.0 - theta) * D[i]);
            theta * (B[i] + (1.0 - theta) * inner)
        });
        for (q, power) in [(1, [1.0; STAGES]), (2, C), (3, by(C, C)), (4, by(C, by(C, C)))] {
            let expected = theta.powi(q) / f64::from(q);
            assert!((dot(weights, power) - expected).abs() < 1e-13, "θ = {theta}, order {q}");
        }
    }
}

/// The equation ẏ = y cos t, which depends on time; its solution is y = e^{sin t}.
struct Growth;

impl Ode<1> for Growth {
    type Constants<R: Real> = ();
    type Input<R: Real> = R;

    fn input<R: Real>(&self, (): &(), t: R) -> R {
        t.sin_cos().1
    }

    fn rhs<R: Real>(&self, (): &(), cos: &R, _side: R, y: &[R; 1]) -> [R; 1] {
        [y[0] * *cos]
    }
}

/// State at t = 2 after `n` equal steps, the sum of error estimates, and the largest error of the values between the
/// steps.
fn fixed_steps(n: u32) -> (f64, f64) {
    let h = 2.0 / f64::from(n);
    let mut y = [1.0];
    let mut between = 0.0_f64;
    for i in 0..n {
        let t = f64::from(i) * h;
        let k1 = Growth.rhs(&(), &Growth.input(&(), t), 1.0, &y);
        let mut step = Step::new(y, k1);
        step.attempt(&Growth, &(), t, h, 1.0);
        let middle = step.interpolate(h, 0.4)[0];
        between = between.max((middle - (t + 0.4 * h).sin().exp()).abs());
        y = step.y[6];
    }
    ((y[0] - 2.0_f64.sin().exp()).abs(), between)
}

fn slope(error: impl Fn(u32) -> f64) -> f64 {
    (error(40) / error(80)).log2()
}

#[test]
fn order_is_5_and_4_between_steps() {
    let order = slope(|n| fixed_steps(n).0);
    assert!((order - 5.0).abs() < 0.1, "order {order}");
    // The interpolant's own error, of order 5 locally, stands beside the solution's.
    let between = slope(|n| fixed_steps(n).1);
    assert!(between > 3.9, "order {between} between steps");
}

#[test]
fn interpolation_meets_both_ends() {
    let y = [1.3];
    let k1 = Growth.rhs(&(), &Growth.input(&(), 0.2), 1.0, &y);
    let mut step = Step::new(y, k1);
    step.attempt(&Growth, &(), 0.2, 0.1, 1.0);
    assert_eq!(step.interpolate(0.1, 0.0), y);
    assert!((step.interpolate(0.1, 1.0)[0] - step.y[6][0]).abs() < 1e-15);
}

#[test]
fn error_estimate_bounds_the_error_of_a_step() {
    let k1 = Growth.rhs(&(), &1.0, 1.0, &[1.0]);
    for h in [0.02, 0.05, 0.1, 0.2] {
        let mut step = Step::new([1.0], k1);
        step.attempt(&Growth, &(), 0.0, h, 1.0);
        let error = (step.y[6][0] - f64::sin(h).exp()).abs();
        assert!(error < step.error[0].abs(), "h = {h}: error {error:e}, estimate {:e}", step.error[0]);
    }
}

/// The restricted three-body problem on Arenstorf's orbit, Hairer I, Eq. (II.0.1).
struct Arenstorf;

impl Ode<4> for Arenstorf {
    type Constants<R: Real> = ();
    type Input<R: Real> = ();

    fn input<R: Real>(&self, (): &(), _t: R) {}

    fn rhs<R: Real>(&self, (): &(), (): &(), _side: R, y: &[R; 4]) -> [R; 4] {
        let [x, y, u, v] = *y;
        let moon = 0.012_277_471;
        let earth = 1.0 - moon;
        let cube = |d: R| d * d.sqrt();
        let to_earth = cube((x + moon) * (x + moon) + y * y);
        let to_moon = cube((x - earth) * (x - earth) + y * y);
        [
            u,
            v,
            x + v * 2.0 - (x + moon) * earth / to_earth - (x - earth) * moon / to_moon,
            y - u * 2.0 - y * earth / to_earth - y * moon / to_moon,
        ]
    }
}

fn arenstorf(rtol: f64) -> Span<4> {
    let y = [0.994, 0.0, 0.0, -2.001_585_106_379_082_5];
    let start = Start::new((), y, 17.065_216_560_157_964, [1.0; 4]);
    span::run(&Arenstorf, &Tolerances { rtol, atol: rtol, max_steps: 10_000 }, &start)
}

/// The code DOPRI5 takes 238 steps at this tolerance: 217 accepted steps, and 1 + 6 · 238 evaluations. russell_ode
/// takes exactly the same steps. flap chooses the first and the last step differently.
#[test]
fn arenstorf_orbit_takes_as_many_steps_as_published() {
    let Span { end, outcome, accepted } = arenstorf(1e-7);
    assert_eq!(outcome.ending, Ending::Stopped);
    assert_eq!(outcome.rhs_evals, 2 + 6 * outcome.attempts);
    println!("Arenstorf: {} steps, {accepted} accepted, end {end:?}", outcome.attempts);
    assert!(outcome.attempts.abs_diff(238) <= 5, "{} steps", outcome.attempts);
    assert!(accepted.abs_diff(217) <= 5, "{accepted} accepted");
    assert!((end[0] - 0.994).abs() < 2e-3 && end[1].abs() < 2e-3, "{end:?}");
}

#[test]
fn arenstorf_orbit_closes_as_the_tolerance_falls() {
    let end = arenstorf(1e-11).end;
    assert!((end[0] - 0.994).abs() < 1e-6 && end[1].abs() < 1e-6, "{end:?}");
}

/// An ODE that counts its evaluations.
struct Counted<'a>(&'a std::sync::atomic::AtomicU64);

impl Ode<1> for Counted<'_> {
    type Constants<R: Real> = ();
    type Input<R: Real> = R;

    fn input<R: Real>(&self, (): &(), t: R) -> R {
        t.sin_cos().0
    }

    fn rhs<R: Real>(&self, (): &(), sin: &R, _side: R, y: &[R; 1]) -> [R; 1] {
        self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        [*sin * 50.0 - y[0] * 20.0]
    }
}

/// ẍ = −x − 0.1 sign ẋ: an oscillator with dry friction that counts its evaluations.
struct CountedSwitch<'a>(&'a std::sync::atomic::AtomicU64);

impl Ode<2> for CountedSwitch<'_> {
    type Constants<R: Real> = ();
    type Input<R: Real> = ();

    const SWITCHES: bool = true;

    fn input<R: Real>(&self, (): &(), _t: R) {}

    fn rhs<R: Real>(&self, (): &(), (): &(), side: R, y: &[R; 2]) -> [R; 2] {
        self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        [y[1], -y[0] - side * 0.1]
    }

    fn switch<R: Real>(&self, (): &(), y: &[R; 2], dy: &[R; 2]) -> [R; 2] {
        [y[1], dy[1]]
    }
}

/// An oscillator with dry friction: its amplitude falls by 0.2 in every half turn, exactly.
#[test]
fn crossings_are_located_and_counted() {
    let counter = std::sync::atomic::AtomicU64::new(0);
    let span = 3.5 * std::f64::consts::PI;
    let start = Start::new((), [2.0, 0.0], span, [1.0; 2]);
    let tolerances = Tolerances { rtol: 1e-9, atol: 1e-9, max_steps: 10_000 };
    let Span { end, outcome, .. } = span::run(&CountedSwitch(&counter), &tolerances, &start);
    assert_eq!(outcome.rhs_evals, counter.into_inner());
    // Three reversals; then a quarter turn on the fourth half turn, of amplitude 1.3 about −0.1.
    assert!((end[0] + 0.1).abs() < 1e-7 && (end[1] - 1.3).abs() < 1e-7, "{end:?}");
}

#[test]
fn a_step_evaluates_the_right_hand_side_six_times() {
    let counter = std::sync::atomic::AtomicU64::new(0);
    let start = Start::new((), [3.0], 10.0, [1.0]);
    let tolerances = Tolerances { rtol: 1e-6, atol: 1e-8, max_steps: 10_000 };
    let Span { outcome, accepted, .. } = span::run(&Counted(&counter), &tolerances, &start);
    assert!(outcome.attempts > accepted && accepted > 20, "{outcome:?}, {accepted} accepted");
    assert_eq!(counter.into_inner(), 2 + 6 * outcome.attempts);
    assert_eq!(outcome.rhs_evals, 2 + 6 * outcome.attempts);
}

/// Each step begins where the step before ends, and the last step of a span ends exactly at the end of the span.
#[test]
fn spans_are_tiled_without_gaps() {
    let start = Start::new((), [1.0], 0.7, [1.0]);
    let expected = std::cell::Cell::new(0.0);
    let mut spans = 0;
    solve::<_, f64, 1>(
        &Growth,
        &Tolerances { rtol: 1e-9, atol: 1e-9, max_steps: 1000 },
        &start,
        |(), accepted| {
            assert_eq!(accepted.t, expected.get());
            expected.set(accepted.t + accepted.h);
        },
        |_| {
            assert!((expected.get() - 0.7_f64).abs() < 1e-15, "span ended at {}", expected.get());
            expected.set(0.0);
            spans += 1;
            if spans == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    );
    assert_eq!(spans, 5);
}

/// The equation ẏ = y², whose solution is infinite at t = 1.
struct BlowUp;

impl Ode<1> for BlowUp {
    type Constants<R: Real> = ();
    type Input<R: Real> = ();

    fn input<R: Real>(&self, (): &(), _t: R) {}

    fn rhs<R: Real>(&self, (): &(), (): &(), _side: R, y: &[R; 1]) -> [R; 1] {
        [y[0] * y[0]]
    }
}

#[test]
fn failures_become_endings() {
    let tolerances = Tolerances { rtol: 1e-6, atol: 1e-8, max_steps: 100_000 };
    let run = |y: f64, tolerances: &Tolerances| {
        let start = Start::new((), [y], 2.0, [1.0]);
        span::run(&BlowUp, tolerances, &start).outcome.ending
    };
    assert_eq!(run(0.1, &tolerances), Ending::Stopped);
    assert_eq!(run(1.0, &tolerances), Ending::StepLimit);
    assert_eq!(run(f64::NAN, &tolerances), Ending::Diverged);
    assert_eq!(run(1e200, &tolerances), Ending::Diverged);
    assert_eq!(run(0.4, &Tolerances { max_steps: 3, ..tolerances }), Ending::StepLimit);
}
