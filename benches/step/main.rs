//! The parts of a run: elementary functions, right-hand side of each model, step; on scalars and in lanes.
//!
//! Rates are per lane: one element is one function value, right-hand side or step of one lane.

mod kernels;

use core::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use flap_core::num::Backend;

use kernels::{Equations, Numbers, Timed, VALUES, Work};

fn parts(criterion: &mut Criterion) {
    let rhs = Equations::ALL.map(Work::Rhs);
    for work in [Work::SinCos, Work::Exp, Work::Ln, Work::Step].into_iter().chain(rhs) {
        let mut group = criterion.benchmark_group(work.name());
        group.sample_size(20);
        group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(1));
        for set in Backend::available() {
            let elements = if work.is_function() { VALUES } else { set.lanes() };
            group.throughput(Throughput::Elements(elements as u64));
            group.bench_function(format!("lanes/{set}"), |bench| {
                let numbers = Numbers::Lanes;
                bench.iter_custom(|iterations| set.dispatch(Timed { work, numbers, iterations }));
            });
        }
        // Scalars of both classes; the fused ones in a function with the instruction enabled.
        for set in [Backend::by_name("avx2"), Backend::available().pop()].into_iter().flatten() {
            let elements = if work.is_function() { VALUES } else { 1 };
            let arithmetic = set.arithmetic();
            group.throughput(Throughput::Elements(elements as u64));
            group.bench_function(format!("scalars/{}", arithmetic.name()), |bench| {
                let numbers = Numbers::Scalars(arithmetic);
                bench.iter_custom(|iterations| set.dispatch(Timed { work, numbers, iterations }));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, parts);
criterion_main!(benches);
