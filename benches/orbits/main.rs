//! Newton's iteration against marching to the same residual, on the grids in `examples`, in interleaved runs on one
//! thread.
#![expect(clippy::print_stdout, reason = "a bench reports")]

use std::path::Path;
use std::time::Instant;

use flap_core::num::InstructionSet;
use flap_core::simulate::{Jobs, Point, Row, SolverSettings, Status};
use flap_sweep::plan::Plan;
use flap_sweep::spec;

/// A grid of each model.
const GRIDS: [&str; 3] = ["jafferis_fig4", "ozaki_large", "arabagi_fig9"];

/// Points taken from a grid, spread over all of it.
const POINTS: u64 = 1024;
const ROUNDS: usize = 5;

fn main() {
    // Tried out, listed or filtered: once, and few points.
    let tried = !std::env::args().skip(1).eq(["--bench"]);
    let (points, rounds) = if tried { (16, 1) } else { (POINTS, ROUNDS) };
    println!("Newton's iteration against marching, medians of {rounds} interleaved runs on one thread:");
    for name in GRIDS {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name);
        let plan = spec::read(&path.with_extension("toml")).expect("the examples are good grids");
        println!("{name}: {}", compare(&plan, points, rounds));
    }
}

/// One line on a grid.
fn compare(plan: &Plan, points: u64, rounds: usize) -> String {
    let indices: Vec<u64> =
        (0..points.min(plan.len())).map(|i| i * plan.len() / points.min(plan.len())).collect();
    let ways = [true, false].map(|newton| SolverSettings { newton, ..plan.solver });
    let mut seconds = [Vec::new(), Vec::new()];
    let mut rows = [Vec::new(), Vec::new()];
    for _ in 0..rounds {
        for way in 0..2 {
            let begin = Instant::now();
            rows[way] = run(plan, &ways[way], &indices);
            seconds[way].push(begin.elapsed().as_secs_f64());
        }
    }
    let mut ratios: Vec<f64> =
        seconds[0].iter().zip(&seconds[1]).map(|(newton, march)| march / newton).collect();
    let told = [0, 1].map(|way| {
        let mut cycles: Vec<f64> = rows[way].iter().map(|row| f64::from(row.cycles)).collect();
        let settled = rows[way].iter().filter(|row| row.status == Status::Periodic).count();
        let rate = indices.len() as f64 / median(&mut seconds[way]);
        format!(
            "{} cycles per point, {settled} of {} settled, {rate:.0} points/s",
            median(&mut cycles),
            indices.len()
        )
    });
    format!("Newton {}; marching {}; ratio of times {:.2}", told[0], told[1], median(&mut ratios))
}

fn run(plan: &Plan, solver: &SolverSettings, indices: &[u64]) -> Vec<Row> {
    let mut listed = Listed { plan, indices: indices.iter(), rows: Vec::with_capacity(indices.len()) };
    plan.simulator.run(InstructionSet::best(), solver, &mut listed);
    listed.rows
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Points of a plan; rows as they come.
struct Listed<'a> {
    plan: &'a Plan,
    indices: std::slice::Iter<'a, u64>,
    rows: Vec<Row>,
}

impl Jobs for Listed<'_> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        self.indices.next().map(|&index| self.plan.point(index))
    }

    fn done(&mut self, _index: u64, row: Row) {
        self.rows.push(row);
    }
}
