//! Points per second of each preset, by marching alone and with Newton shooting, to the same residual.

use std::time::Instant;

use flap_core::num::Backend;
use flap_core::ode::ensemble::Occupancy;
use flap_core::simulate::{Jobs, LaneUse, Point, Row, SolverSettings, Status};
use flap_sweep::plan::Plan;

use crate::Effort;
use crate::grid::{grid, presets};
use crate::spread::{Spread, digits};

pub(crate) fn print(effort: Effort) {
    println!(
        "## Presets\n\n\
         Each preset is computed at {0} × {0} points on one thread.\n\
         The voltages are 60 to 100 % of the published voltage, and the frequencies are 85 to 110 % of the published frequency.\n\
         The residual of each orbit is at most {1:e}, at rtol {2:e}.\n\
         The columns *marching* are computed with `newton = false` in `[solver]`.\n\
         The columns *Newton* are computed with [Newton shooting](../glossary.md#newton-shooting), the default.\n\
         \n\
         - *cycles*: median number of drive periods per point\n\
         - *settled*: number of points with an orbit\n\
         - *ratio of times*: time with marching divided by time with Newton shooting\n\
         - *lanes in use*: share of the [lanes](../glossary.md#lane) that integrate a point, on average over the steps with Newton shooting. The remaining lanes are idle\n\
         \n\
         The column *lanes in use* has one share for each part of the computation, and the share in all steps:\n\
         \n\
         1. marching\n\
         2. integration of the motion with its derivatives, which Newton shooting needs\n\
         3. measurement of the settled motion\n\
         4. all steps\n\
         \n\
         | preset | marching, points/s | cycles | settled | Newton, points/s | cycles | settled | ratio of times | lanes in use |\n\
         |---|---|---|---|---|---|---|---|---|",
        effort.side,
        SolverSettings::default().settle_tol,
        SolverSettings::default().rtol
    );
    for preset in presets() {
        let plan = grid(preset, effort.side);
        let ways = [false, true].map(|newton| SolverSettings { newton, ..*plan.solver() });
        let mut seconds = [Vec::new(), Vec::new()];
        let mut last = [Listed::new(&plan), Listed::new(&plan)];
        for _ in 0..effort.rounds {
            for way in 0..2 {
                let begin = Instant::now();
                last[way] = run(&plan, &ways[way]);
                seconds[way].push(begin.elapsed().as_secs_f64());
            }
        }
        print!("| {preset} |");
        for way in 0..2 {
            let rate = Spread::of(seconds[way].iter().map(|seconds| plan.len() as f64 / seconds));
            let cycles = Spread::of(last[way].rows.iter().map(|row| f64::from(row.cycles))).median();
            let settled = last[way].rows.iter().filter(|row| row.status == Status::Periodic).count();
            print!(" {rate} | {} | {settled} |", digits(cycles));
        }
        let ratio = Spread::of_ratios(&seconds[0], &seconds[1]);
        println!(" {ratio} | {} |", lanes_full(&last[1].lane_use));
    }
    println!();
}

/// Runs all points on this thread.
pub(crate) fn run<'a>(plan: &'a Plan, solver: &SolverSettings) -> Listed<'a> {
    let mut listed = Listed::new(plan);
    plan.simulator().run(Backend::best(), solver, &mut listed);
    listed
}

/// The share of lanes in use: in the three ensembles, and in all.
pub(crate) fn lanes_full(lane_use: &LaneUse) -> String {
    let share = |lanes: Occupancy| format!("{:.1} %", 100.0 * lanes.used as f64 / lanes.room.max(1) as f64);
    let LaneUse { marching, varying, measuring } = *lane_use;
    let mut all = marching;
    all += varying;
    all += measuring;
    format!("{}, {}, {}; {}", share(marching), share(varying), share(measuring), share(all))
}

/// Points of a plan; rows as they come.
pub(crate) struct Listed<'a> {
    plan: &'a Plan,
    next: u64,
    pub(crate) rows: Vec<Row>,
    pub(crate) lane_use: LaneUse,
}

impl Listed<'_> {
    fn new(plan: &Plan) -> Listed<'_> {
        Listed { plan, next: 0, rows: Vec::new(), lane_use: LaneUse::default() }
    }
}

impl Jobs for Listed<'_> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        let index = self.next;
        self.next += 1;
        (index < self.plan.len()).then(|| self.plan.point(index))
    }

    fn done(&mut self, _index: u64, row: Row) {
        self.rows.push(row);
    }

    fn occupied(&mut self, lanes: &LaneUse) {
        self.lane_use = *lanes;
    }
}
