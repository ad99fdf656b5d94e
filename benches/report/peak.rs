//! The share of the processor's peak that the hot loop reaches: executed arithmetic of vectors against fused multiplications
//! and additions that do nothing else, in the same run.

use core::hint::black_box;
use std::time::Instant;

use flap_core::num::{Backend, Kernel, Lanes, Real, Simd, Vector};
use flap_core::ode::ensemble::{MOST_LANES, Next, Queue, SpanEnd, Unobserved, run};
use flap_core::ode::{Start, Tolerances};

use crate::Effort;
use crate::equations::{Drive, SCALE, Wing};
use crate::executed::Executed;
use crate::spread::{Spread, digits};

/// Periods of which the instructions are counted, which takes some ten microseconds for each.
const COUNTED: u64 = 2;

const TOLERANCES: Tolerances = Tolerances { rtol: 1e-6, atol: 1e-7, max_steps: 100_000 };

pub(crate) fn print(effort: Effort) {
    println!(
        "## Share of the peak\n\n\
         This section compares the arithmetic rate of the integration loop with the peak arithmetic rate of the processor.\n\
         The integration loop marches the equations of `examples/own_equations` at rtol 1e-6, with a point in every lane.\n\
         The peak rate is the rate of a loop of fused multiplications and additions in ten independent registers.\n\
         The integration loop and the peak loop run in turn.\n\
         The program executes the integration loop one instruction at a time and counts the instructions.\n\
         The kind of each instruction comes from a disassembly of the program.\n\
         Each count is a number of instructions for one right-hand side.\n\
         flap evaluates the right-hand side for all lanes at once, and one quantity of all lanes fills two registers.\n\
         Counts also include the instructions of an integration step that do not belong to the right-hand side.\n\
         \n\
         - *arithmetic*: instructions that add, multiply, divide or compare vectors of doubles, or fuse a multiplication and an addition\n\
         - *with the stack*: instructions that read or write an operand on the stack in memory\n\n\
         | instructions | executed | arithmetic | of which fused | divisions | with the stack | peak, GFLOP/s | \
         share of the peak's instructions |\n|---|---|---|---|---|---|---|---|"
    );
    for backend in Backend::available().into_iter().filter(|backend| backend.name() != "scalar") {
        println!(
            "{}",
            line(backend, effort).unwrap_or_else(|error| format!("| {backend} | not counted: {error} |"))
        );
    }
}

fn line(backend: Backend, effort: Effort) -> std::io::Result<String> {
    let executed = Executed::of(&format!("{backend} {COUNTED}"))?;
    let lanes = backend.lanes() as f64;
    let counted = rhs_evals(backend, COUNTED) / lanes;
    let [mut peaks, mut shares] = [Vec::new(), Vec::new()];
    for _ in 0..effort.rounds {
        let iterations = effort.periods * 10_000;
        let fused_per_second = backend.dispatch(Fused { iterations });
        let seconds = march_seconds(backend, effort.periods);
        let vectors = rhs_evals(backend, effort.periods) / lanes;
        let per_second = executed.arithmetic() as f64 / counted * vectors / seconds;
        peaks.push(fused_per_second * lanes * 1e-9);
        shares.push(100.0 * per_second / fused_per_second);
    }
    let per_rhs = |count: u64| digits(count as f64 / counted);
    Ok(format!(
        "| {backend} | {} | {} | {} | {} | {} | {} | {} % |",
        per_rhs(executed.all),
        per_rhs(executed.arithmetic()),
        per_rhs(executed.fused),
        per_rhs(executed.divisions),
        per_rhs(executed.stack),
        Spread::of(peaks),
        Spread::of(shares)
    ))
}

/// Marches as many periods as `name` says, which is a backend and a number.
pub(crate) fn march_by_name(name: &str, mark: &mut dyn FnMut()) {
    let (backend, periods) = name.split_once(' ').expect("a backend and periods");
    let backend = Backend::by_name(backend).expect("a backend of this machine");
    backend.dispatch(March { periods: periods.parse().expect("a number"), mark });
}

fn march_seconds(backend: Backend, periods: u64) -> f64 {
    let mut marks = Vec::new();
    backend.dispatch(March { periods, mark: &mut || marks.push(Instant::now()) });
    (marks[1] - marks[0]).as_secs_f64()
}

/// Right-hand sides of all lanes.
fn rhs_evals(backend: Backend, periods: u64) -> f64 {
    backend.dispatch(March { periods, mark: &mut || () }) as f64
}

/// Fused multiplications and additions. Results in instructions per second.
struct Fused {
    iterations: u64,
}

impl Kernel for Fused {
    type Output = f64;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f64 {
        let number = |value| black_box(Vector::<S>::splat(simd, value));
        let (factor, term) = (number(0.5), number(1.0));
        let mut sums = [number(0.0), number(1.0), number(2.0), number(3.0), number(4.0)];
        let begin = Instant::now();
        for _ in 0..self.iterations {
            for sum in &mut sums {
                *sum = sum.mul_add(factor, term);
            }
        }
        let seconds = begin.elapsed().as_secs_f64();
        black_box(sums);
        (self.iterations * 10) as f64 / seconds
    }
}

/// A run in every lane. Results in the right-hand sides of all.
struct March<'a> {
    periods: u64,
    mark: &'a mut dyn FnMut(),
}

impl Kernel for March<'_> {
    type Output = u64;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> u64 {
        let March { periods, mark } = self;
        let mut alike = Alike {
            drive: Drive::new(0.1, 120.0),
            left: Vector::<S>::LANES,
            periods: [periods; MOST_LANES],
            marks: 0,
            rhs_evals: 0,
            mark,
        };
        run(simd, &Wing, &Unobserved, &TOLERANCES, &mut alike);
        alike.rhs_evals
    }
}

/// The same run for every lane. They end together: what is marked ends with the first.
struct Alike<'a> {
    drive: Drive<f64>,
    left: usize,
    /// Periods left in each lane.
    periods: [u64; MOST_LANES],
    marks: u32,
    rhs_evals: u64,
    mark: &'a mut dyn FnMut(),
}

impl Queue<Wing, Unobserved, 4> for Alike<'_> {
    fn next(&mut self, _lane: usize, _idle: bool) -> Option<Start<&Drive<f64>, 4>> {
        self.left = self.left.checked_sub(1)?;
        if self.left == 0 {
            (self.mark)();
        }
        Some(Start::new(&self.drive, [0.0; 4], 1.0 / 120.0, SCALE))
    }

    fn ended(&mut self, lane: usize, end: SpanEnd<'_, (), 4>) -> Option<Next<4>> {
        self.periods[lane] -= 1;
        if self.periods[lane] > 0 {
            return Some(Next::Span);
        }
        if self.marks == 0 {
            self.marks = 1;
            (self.mark)();
        }
        self.rhs_evals += end.outcome.rhs_evals;
        None
    }
}
