//! Runs on scalars, in lanes, and from points to rows.

use core::ops::ControlFlow;
use std::hint::black_box;

use flap_core::model::Model;
use flap_core::model::direct_drive::{Constants, DirectDrive};
use flap_core::num::{Backend, Kernel, Lanes, PerLane, Simd, Vector};
use flap_core::ode::step::Step;
use flap_core::ode::{Ode, Start, Tolerances};
use flap_core::simulate::{Jobs, Point, Row, SolverSettings, preset};

use crate::counting::allocations;

pub(crate) const MODEL: DirectDrive = DirectDrive::SINE;
pub(crate) const TOLERANCES: Tolerances = Tolerances { rtol: 1e-4, atol: 1e-6, max_steps: 20_000 };

fn values() -> Vec<f64> {
    let (_, preset) = preset("ozaki2018-large").expect("a preset of the direct-drive model");
    (preset.values)()
}

/// The beginning of a run.
pub(crate) fn start() -> Start<Constants<f64>, 4> {
    MODEL.start(&values()).expect("published parameters are possible")
}

/// One step from rest.
#[inline(always)]
pub(crate) fn one_step<R: Lanes>(token: R::Token, start: &Start<Constants<f64>, 4>) {
    let zero = R::splat(token, 0.0);
    let c = Constants::<R>::fill(zero, &start.constants);
    let h = R::splat(token, start.span * 1e-3);
    let side = R::splat(token, 1.0);
    let y = start.y.map(
        #[inline(always)]
        |y| R::splat(token, y),
    );
    let k1 = MODEL.rhs(&c, &MODEL.input(&c, zero), side, &y);
    let mut step = Step::new(y, k1);
    step.attempt(&MODEL, &c, zero, h, side);
    black_box(step);
}

/// [`one_step`] in lanes.
#[derive(Clone, Copy)]
pub(crate) struct OneStep<'a>(pub(crate) &'a Start<Constants<f64>, 4>);

impl Kernel for OneStep<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        one_step::<Vector<S>>(simd, self.0);
    }
}

/// Breaks at the end of the last cycle.
pub(crate) fn count_down(left: &mut u32) -> ControlFlow<()> {
    *left -= 1;
    if *left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// Allocations and cycles of a sweep over equal points of a preset, from points to rows.
pub(crate) fn sweep(name: &str, backend: Backend, settle_tol: f64, progressive: bool) -> (u64, u64) {
    let (simulator, preset) = preset(name).expect("a published preset");
    let solver = SolverSettings { settle_tol, progressive, ..SolverSettings::default().with_rtol(1e-8) };
    let mut points = Points { left: 48, cycles: 0, values: (preset.values)() };
    let allocations = allocations(|| simulator.run(backend, &solver, &mut points));
    (allocations, points.cycles)
}

struct Points {
    left: u64,
    cycles: u64,
    values: Vec<f64>,
}

impl Jobs for Points {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        self.left = self.left.checked_sub(1)?;
        Some(Point::at_rest(self.left, self.values.clone()))
    }

    fn done(&mut self, _index: u64, row: Row) {
        self.cycles += u64::from(row.cycles);
    }
}
