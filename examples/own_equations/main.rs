//! Equations of one's own in flap's integrator: thousands of runs in SIMD lanes.
//!
//! ```sh
//! cargo run --release -p flap-core --example own_equations -- POINTS.csv RTOL OUT.csv [SET]
//! ```
//!
//! POINTS.csv has the columns `id,F0,f`: number, amplitude of the force (N) and frequency (Hz). Each point is run for 40
//! drive periods from rest; OUT.csv says how far tip and hinge swing and what the mean lift is in the last five. The time
//! that the runs took goes to stdout, as JSON. SET names the instructions to be used (avx512, avx2, sse2 or neon): without
//! it, the best.

#![expect(clippy::print_stdout, reason = "an example prints what it finds")]

mod equations;

use std::error::Error;
use std::fs;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use flap_core::num::{Backend, Kernel, Simd};
use flap_core::ode::ensemble::{Continuation, NewRun, Observer, Queue, Unobserved, run};
use flap_core::ode::{Outcome, Start, Tolerances};
use nix::time::{ClockId, clock_gettime};

use equations::{Drive, Measured, SCALE, Sums, Wing};

/// Drive periods before those that are measured, and those.
const PERIODS: [u32; 2] = [35, 5];

type Begin = Start<Drive<f64>, 4>;

/// Number, force (N) and frequency (Hz) of a point.
type Point = (String, f64, f64);

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let ([points, rtol, out], set) = match &arguments[..] {
        [points, rtol, out] => ([points, rtol, out], Backend::best()),
        [points, rtol, out, set] => {
            let set = Backend::by_name(set).ok_or_else(|| format!("this machine has no {set}"))?;
            ([points, rtol, out], set)
        }
        _ => return Err("arguments are needed: POINTS.csv RTOL OUT.csv [SET]".into()),
    };
    let points = read(&fs::read_to_string(points)?)?;
    let rtol: f64 = rtol.parse()?;
    let tolerances = Tolerances { rtol, atol: 0.1 * rtol, max_steps: 100_000 };

    let (wall, cpu) = (Instant::now(), cpu_time()?);
    let found = set.dispatch(Runs { points: &points, tolerances });
    let (wall, cpu) = (wall.elapsed(), cpu_time()?.saturating_sub(cpu));

    let mut table = vec!["id,F0,f,max_x,max_psi,lift".to_owned()];
    for ((id, force, frequency), Sums { tip, psi, lift }) in points.iter().zip(&found.sums) {
        let mean = lift * frequency / f64::from(PERIODS[1]);
        table.push(format!("{id},{force:?},{frequency:?},{tip:e},{psi:e},{mean:e}"));
    }
    fs::write(out, table.join("\n") + "\n")?;
    println!(
        "{{\"solve_s\":{},\"cpu_s\":{},\"rhs_per_point\":{}}}",
        wall.as_secs_f64(),
        cpu.as_secs_f64(),
        found.rhs_evals / points.len().max(1) as u64
    );
    Ok(())
}

/// The points of a file.
fn read(text: &str) -> Result<Vec<Point>, Box<dyn Error>> {
    let rows = text.lines().skip(1).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let [id, force, frequency] = cells[..] else { return Err(format!("not a point: {line}").into()) };
        Ok((id.to_owned(), force.parse()?, frequency.parse()?))
    });
    rows.collect()
}

/// Time that this process has computed.
fn cpu_time() -> Result<Duration, nix::Error> {
    clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID).map(Duration::from)
}

/// All runs, with the instructions of the machine.
struct Runs<'a> {
    points: &'a [Point],
    tolerances: Tolerances,
}

/// Their results.
struct Found {
    sums: Vec<Sums<f64>>,
    rhs_evals: u64,
}

impl Kernel for Runs<'_> {
    type Output = Found;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Found {
        let begin = |(_, force, frequency): &Point| Begin {
            constants: Drive::new(*force, *frequency),
            y: [0.0; 4],
            span: 1.0 / frequency,
            scale: SCALE,
            tighten: 1.0,
        };
        // Most periods are not looked at, which is cheaper; the last ones are.
        let mut settling = Part::new(PERIODS[0], self.points.iter().map(begin).collect());
        run(simd, &Wing, &Unobserved, &self.tolerances, &mut settling);
        let mut measuring = Part::new(PERIODS[1], settling.ends);
        run(simd, &Wing, &Measured, &self.tolerances, &mut measuring);
        Found { sums: measuring.totals, rhs_evals: settling.rhs_evals + measuring.rhs_evals }
    }
}

/// Some periods of every run.
struct Part<T> {
    periods: u32,
    begun: usize,
    /// States of the runs: their beginnings, and once they have ended, their ends.
    ends: Vec<Begin>,
    totals: Vec<T>,
    rhs_evals: u64,
}

impl<T: Default> Part<T> {
    fn new(periods: u32, begins: Vec<Begin>) -> Part<T> {
        let totals = begins.iter().map(|_| T::default()).collect();
        Part { periods, begun: 0, ends: begins, totals, rhs_evals: 0 }
    }
}

impl<V: Observer<Wing, 4>> Queue<Wing, V, 4> for Part<V::Totals<f64>> {
    /// Index of the run and periods that it has made.
    type Run = (usize, u32);

    fn next(&mut self, _idle: bool) -> Option<NewRun<(usize, u32), Drive<f64>, 4>> {
        let begin = *self.ends.get(self.begun)?;
        self.begun += 1;
        Some(((self.begun - 1, 0), begin))
    }

    fn span_end(&mut self, run: &mut (usize, u32), y: &[f64; 4], totals: &V::Totals<f64>) -> ControlFlow<()> {
        let (index, periods) = run;
        *periods += 1;
        if *periods < self.periods {
            return ControlFlow::Continue(());
        }
        self.ends[*index].y = *y;
        self.totals[*index] = *totals;
        ControlFlow::Break(())
    }

    fn ended(&mut self, _run: (usize, u32), outcome: Outcome) -> Option<(Self::Run, Continuation<4>)> {
        // A run that fails keeps the totals of nothing: zeros.
        self.rhs_evals += outcome.rhs_evals;
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of a long-double solver at a tolerance of 1e-12, with 2,048 samples per period: see tests/data.
    const REFERENCE: &str = include_str!("../../tests/data/own_equations.csv");

    #[test]
    fn runs_come_to_what_another_solver_finds() {
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let rows: Vec<Vec<String>> = REFERENCE.lines().skip(1).map(cells).collect();
        let begins: Vec<String> = rows.iter().map(|row| row[..3].join(",")).collect();
        let points = read(&format!("id,F0,f\n{}", begins.join("\n"))).expect("points");
        for (rtol, worst) in [(1e-6, 1e-4), (1e-8, 1e-6)] {
            let tolerances = Tolerances { rtol, atol: 0.1 * rtol, max_steps: 100_000 };
            for set in Backend::available() {
                let found = set.dispatch(Runs { points: &points, tolerances });
                for ((row, (_, _, frequency)), sums) in rows.iter().zip(&points).zip(&found.sums) {
                    let lift = sums.lift * frequency / f64::from(PERIODS[1]);
                    for (computed, known) in [sums.tip, sums.psi, lift].into_iter().zip(&row[3..]) {
                        let known: f64 = known.parse().expect("a number");
                        let error = (computed / known - 1.0).abs();
                        assert!(error < worst, "{set} at {rtol}: {computed} for {known} in {row:?}");
                    }
                }
            }
        }
    }
}
