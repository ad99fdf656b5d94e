//! Marching allocates nothing: ten times as many cycles make the same number of allocations.

mod counting;
mod runs;

use std::hint::black_box;

use flap_core::num::{Backend, OneLane};
use flap_core::ode::ensemble::{Unobserved, integrate};
use flap_core::ode::solve::solve;

use counting::allocations;
use runs::{MODEL, OneStep, TOLERANCES, count_down, one_step, start, sweep};

#[test]
fn the_count_sees_allocations() {
    assert_eq!(allocations(|| drop(black_box(vec![1_u8]))), 1);
}

#[test]
fn a_step_allocates_nothing() {
    let start = start();
    assert_eq!(allocations(|| one_step::<f64>(OneLane::new(), &start)), 0);
    for backend in Backend::available() {
        assert_eq!(allocations(|| backend.dispatch(OneStep(&start))), 0, "{backend}");
    }
}

#[test]
fn a_scalar_run_allocates_nothing() {
    let start = start();
    let march = |cycles| {
        let mut left = cycles;
        allocations(|| {
            let at_span_end = |_: &[f64; 4]| count_down(&mut left);
            black_box(solve::<_, f64, 4>(&MODEL, &TOLERANCES, &start, |_, _| {}, at_span_end));
        })
    };
    assert_eq!(march(1), 0);
    assert_eq!(march(10), 0);
}

#[test]
fn an_ensemble_allocates_the_same_for_more_cycles() {
    for backend in Backend::available() {
        let starts = vec![start(); 40];
        let march = |cycles| {
            allocations(|| {
                black_box(integrate(backend, &MODEL, &Unobserved, &TOLERANCES, &starts, cycles));
            })
        };
        assert_eq!(march(10), march(1), "{backend}");
    }
}

#[test]
fn a_sweep_allocates_the_same_for_more_cycles() {
    for preset in ["ozaki2018-large", "jafferis2016", "arabagi2013-75hz"] {
        for backend in Backend::available() {
            // The first sweep of a thread finds the quadrature rules, and keeps them.
            sweep(preset, backend, 1e-1, false);
            for (progressive, loose) in [(false, 1e-1), (true, 1e-6)] {
                let (few, few_cycles) = sweep(preset, backend, loose, progressive);
                let (many, many_cycles) = sweep(preset, backend, 1e-12, progressive);
                assert!(
                    many_cycles > few_cycles,
                    "{preset}, {backend}: {many_cycles} cycles against {few_cycles}"
                );
                assert_eq!(many, few, "{preset}, {backend}, progressive tolerances: {progressive}");
            }
        }
    }
}
