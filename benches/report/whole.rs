//! A whole sweep: threads, lanes, and the time to write and read its rows.

use std::fs::File;
use std::io::{self, Seek};
use std::num::NonZeroUsize;
use std::time::Instant;

use flap_sweep::files::csv_sink::CsvSink;
use flap_sweep::files::results::{Format, Reader};
use flap_sweep::plan::Plan;
use flap_sweep::run::{self, RowWriter, RunOptions, Sink, Summary};
use flap_sweep::table::layout::Layout;
use temp_dir::TempDir;

use crate::Effort;
use crate::grid::grid;
use crate::presets::{Listed, lanes_full, run as run_here};
use crate::spread::Spread;

const PRESET: &str = "ozaki2018-large";

pub(crate) fn print(effort: Effort) {
    let side = effort.points.isqrt();
    let plan = grid(PRESET, side);
    let [mut one, mut two, mut written, mut read] = [const { Vec::new() }; 4];
    let mut listed = None;
    for _ in 0..effort.rounds {
        one.push(sweep(&plan, 1));
        two.push(sweep(&plan, 2));
        let rows = listed.insert(run_here(&plan, plan.solver()));
        let (write, parse) = file(&plan, rows).expect("a temporary file");
        written.push(100.0 * write / one[one.len() - 1]);
        read.push(100.0 * parse / one[one.len() - 1]);
    }
    let lane_use = listed.map_or_else(String::new, |listed| lanes_full(&listed.lane_use));
    println!(
        "## A whole sweep\n\nThe sweep of the next table computes {} points of `{PRESET}` and writes a CSV file:\n\n| | |\n|---|---|\n\
         | points per second, one thread | {} |\n| points per second, two threads | {} |\n| speed with two threads divided by speed with one thread | {} |\n\
         | time to write the CSV file, in % of the time of the sweep on one thread | {} |\n\
         | time to read the CSV file, in % of the time of the sweep on one thread | {} |\n\
         | share of lane steps that a point needed: during marching, responses and measuring; in all steps | {lane_use} |\n",
        plan.len(),
        Spread::of(one.iter().map(|seconds| plan.len() as f64 / seconds)),
        Spread::of(two.iter().map(|seconds| plan.len() as f64 / seconds)),
        Spread::of_ratios(&one, &two),
        Spread::of(written),
        Spread::of(read),
    );
}

/// Seconds that a sweep takes.
fn sweep(plan: &Plan, threads: usize) -> f64 {
    let threads = NonZeroUsize::new(threads).expect("at least one");
    let options = RunOptions { threads, ..RunOptions::default() };
    let folder = TempDir::new().expect("a folder");
    let file = File::create(folder.child("rows.csv")).expect("a file");
    let mut sink = CsvSink::new(Layout::of(plan).names(), file);
    let begin = Instant::now();
    let mut output = RowWriter::begin(plan, Summary::default(), &mut sink).expect("a header");
    for row in run::rows(plan, &options, 0) {
        output.write(&row.expect("a sweep")).expect("room for a row");
    }
    output.finish(Ok(())).expect("room for rows");
    begin.elapsed().as_secs_f64()
}

/// Seconds that writing all rows takes, and reading them.
fn file(plan: &Plan, listed: &Listed<'_>) -> io::Result<(f64, f64)> {
    let folder = TempDir::new()?;
    let mut file = File::options().read(true).write(true).create_new(true).open(folder.child("rows.csv"))?;
    let begin = Instant::now();
    let layout = Layout::of(plan);
    let mut sink = CsvSink::new(layout.names(), file.try_clone()?);
    sink.begin()?;
    // The order of the rows does not change the time.
    for (index, row) in (0..).zip(&listed.rows) {
        sink.write(&layout.cells(&plan.point(index), row))?;
    }
    sink.flush()?;
    let written = begin.elapsed().as_secs_f64();

    file.rewind()?;
    let begin = Instant::now();
    let mut reader = Reader::new(file, Format::Csv)?;
    let mut row = csv::StringRecord::new();
    let mut numbers = 0;
    while reader.next(&mut row)? {
        numbers += row.iter().filter(|cell| cell.parse::<f64>().is_ok()).count();
    }
    std::hint::black_box(numbers);
    Ok((written, begin.elapsed().as_secs_f64()))
}
