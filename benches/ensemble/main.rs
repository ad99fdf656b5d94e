//! A sweep, by the lanes of every backend of this machine and by scalars, on one thread.
//!
//! Criterion reports points per second. The lines at the end compare lanes with scalars in interleaved runs,
//! so that what else the machine does slows both alike.
#![expect(clippy::print_stdout, reason = "a bench reports")]

#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[path = "../../tests/instructions/counter.rs"]
mod counter;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[path = "../../tests/instructions/workload.rs"]
mod workload;

mod compare;
mod sweep;

use core::time::Duration;

use criterion::{Criterion, SamplingMode, Throughput};
use flap_core::num::Backend;

use sweep::{POINTS, Sweep};

fn main() {
    #[cfg(all(target_os = "linux", target_arch = "x86_64"))]
    if let Some(name) = counter::work_of_child() {
        let work = workload::Work::by_name(&name).expect("the name of some work");
        counter::be_counted(|mark| work.run(mark)).expect("this process may be traced");
        return;
    }

    let mut criterion = Criterion::default().configure_from_args();
    points_per_second(&mut criterion);
    criterion.final_summary();
    // Not when the bench is only tried out, listed or filtered.
    if std::env::args().skip(1).eq(["--bench"]) {
        compare::lanes_with_scalars();
    }
}

fn points_per_second(criterion: &mut Criterion) {
    let sweep = Sweep::new();
    let mut group = criterion.benchmark_group("ensemble");
    group.throughput(Throughput::Elements(POINTS as u64));
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(4));
    for backend in Backend::available() {
        group.bench_function(format!("lanes/{backend}"), |bench| bench.iter(|| sweep.lanes(backend)));
    }
    for backend in sweep::scalar_backends() {
        let class = backend.arithmetic().name();
        group.bench_function(format!("scalars/{class}"), |bench| bench.iter(|| sweep.scalars(backend)));
    }
    group.finish();
}
