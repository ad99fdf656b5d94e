//! Sweeps, with their rows in memory, and result files: written as CSV and read back.
//!
//! A sweep's rate is points per second on one thread. That of a file is rows per second.

#[path = "../report/grid.rs"]
mod grid;
mod rows;

use core::time::Duration;
use std::fs::File;
use std::num::NonZeroUsize;

use criterion::measurement::WallTime;
use criterion::{
    BatchSize, BenchmarkGroup, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use flap_sweep::files::csv_sink::CsvSink;
use flap_sweep::plan::Plan;
use flap_sweep::run::{self, RowWriter, RunOptions, Sink, Summary};
use flap_sweep::table::layout::Layout;
use temp_dir::TempDir;

use grid::grid;
use rows::{Rows, read};

/// Points per side of the grid of each preset.
const SIDE: usize = 8;

fn presets(criterion: &mut Criterion) {
    let mut group = group(criterion, "sweep");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    for preset in grid::presets() {
        let plan = grid(preset, SIDE);
        group.throughput(Throughput::Elements(plan.len()));
        group.bench_function(preset, |bench| bench.iter(|| sweep(&plan)));
    }
    group.finish();
}

/// A whole sweep on one thread, its rows into memory.
fn sweep(plan: &Plan) -> usize {
    let options = RunOptions { threads: NonZeroUsize::MIN, ..RunOptions::default() };
    let mut sink = CsvSink::new(Layout::of(plan).names(), Vec::new());
    let mut output = RowWriter::begin(plan, Summary::default(), &mut sink).expect("a header");
    for row in run::rows(plan, &options, 0) {
        output.write(&row.expect("a sweep")).expect("room for a row");
    }
    output.finish(Ok(())).expect("room for rows");
    sink.target().len()
}

fn files(criterion: &mut Criterion) {
    let plan = grid("ozaki2018-large", SIDE);
    let rows = Rows::of(&plan);
    let mut group = group(criterion, "csv");
    group.throughput(Throughput::Elements(rows.len()));
    group.bench_function("write", |bench| {
        let empty = || CsvSink::new(Layout::of(&plan).names(), Vec::with_capacity(1 << 20));
        bench.iter_batched_ref(empty, |sink| rows.write(sink), BatchSize::LargeInput);
    });
    let folder = TempDir::new().expect("a folder");
    let file = File::options()
        .read(true)
        .write(true)
        .create_new(true)
        .open(folder.child("rows.csv"))
        .expect("a file");
    let mut sink = CsvSink::new(Layout::of(&plan).names(), file);
    sink.begin().expect("a header");
    rows.write(&mut sink);
    group.bench_function("read", |bench| bench.iter(|| read(sink.target())));
    group.finish();
}

fn group<'a>(criterion: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(2));
    group
}

criterion_group!(benches, presets, files);
criterion_main!(benches);
