//! Integrates your own equations with flap's integrator: thousands of runs in SIMD lanes.
//!
//! ```sh
//! cargo run --release -p flap-core --example own_equations -- POINTS.csv RTOL OUT.csv [SET]
//! ```
//!
//! POINTS.csv has the columns `id,F0,f`: the number of the point, the amplitude of the force (N) and the
//! frequency (Hz). Each point is run for 40 drive periods from rest. OUT.csv contains the amplitudes of the
//! actuator's tip and of the pitch, and the mean lift, over the last five periods. The program prints the
//! computing time of all runs to stdout, as JSON. SET is the name of a SIMD instruction set: avx512, avx2,
//! neon or scalar. Without SET, the program uses the fastest instructions of the processor.

#![expect(clippy::print_stdout, reason = "an example prints what it finds")]

mod equations;

use std::error::Error;
use std::fs;
use std::time::{Duration, Instant};

use flap_core::num::Backend;
use flap_core::ode::ensemble::{Unobserved, integrate};
use flap_core::ode::{Start, Tolerances};
use nix::time::{ClockId, clock_gettime};

use equations::{Drive, Measured, SCALE, Sums, Wing};

/// Number of drive periods before the measurement, and number of measured drive periods.
const PERIODS: [u32; 2] = [35, 5];

type Begin = Start<Drive<f64>, 4>;

/// A point: its number, the amplitude of the force (N) and the frequency (Hz).
type Point = (String, f64, f64);

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let ([points, rtol, out], backend) = match &arguments[..] {
        [points, rtol, out] => ([points, rtol, out], Backend::best()),
        [points, rtol, out, backend] => {
            let backend =
                Backend::by_name(backend).ok_or_else(|| format!("this machine has no {backend}"))?;
            ([points, rtol, out], backend)
        }
        _ => return Err("arguments are needed: POINTS.csv RTOL OUT.csv [SET]".into()),
    };
    let points = read(&fs::read_to_string(points)?)?;
    let rtol: f64 = rtol.parse()?;
    let tolerances = Tolerances { rtol, atol: 0.1 * rtol, max_steps: 100_000 };

    let (wall, cpu) = (Instant::now(), cpu_time()?);
    let found = integrated(backend, &points, &tolerances);
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

/// Returns the points in the text of a file.
fn read(text: &str) -> Result<Vec<Point>, Box<dyn Error>> {
    let rows = text.lines().skip(1).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let [id, force, frequency] = cells[..] else { return Err(format!("not a point: {line}").into()) };
        Ok((id.to_owned(), force.parse()?, frequency.parse()?))
    });
    rows.collect()
}

/// Returns the processor time that this process has used.
fn cpu_time() -> Result<Duration, nix::Error> {
    clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID).map(Duration::from)
}

/// The measures over the last periods of every run, and the number of evaluations of the right-hand side in
/// all runs.
struct Found {
    sums: Vec<Sums<f64>>,
    rhs_evals: u64,
}

fn integrated(backend: Backend, points: &[Point], tolerances: &Tolerances) -> Found {
    let begin = |(_, force, frequency): &Point| {
        Start::new(Drive::new(*force, *frequency), [0.0; 4], 1.0 / frequency, SCALE)
    };
    // Most periods are not looked at, which is cheaper; the last ones are.
    let mut starts: Vec<Begin> = points.iter().map(begin).collect();
    let settled = integrate(backend, &Wing, &Unobserved, tolerances, &starts, PERIODS[0]);
    for (start, end) in starts.iter_mut().zip(&settled) {
        start.y = end.y;
    }
    let measured = integrate(backend, &Wing, &Measured, tolerances, &starts, PERIODS[1]);
    let evals = settled.iter().map(|end| end.outcome).chain(measured.iter().map(|end| end.outcome));
    Found {
        rhs_evals: evals.map(|outcome| outcome.rhs_evals).sum(),
        sums: measured.iter().map(|end| end.totals).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reference numbers from a solver in long double precision, with a tolerance of 1e-12 and 2,048 samples
    /// per period.
    const REFERENCE: &str = include_str!("../../tests/data/own_equations.csv");

    #[test]
    fn runs_come_to_what_another_solver_finds() {
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let rows: Vec<Vec<String>> = REFERENCE.lines().skip(1).map(cells).collect();
        let begins: Vec<String> = rows.iter().map(|row| row[..3].join(",")).collect();
        let points = read(&format!("id,F0,f\n{}", begins.join("\n"))).expect("points");
        for (rtol, worst) in [(1e-6, 1e-4), (1e-8, 1e-6)] {
            let tolerances = Tolerances { rtol, atol: 0.1 * rtol, max_steps: 100_000 };
            for backend in Backend::available() {
                let found = integrated(backend, &points, &tolerances);
                for ((row, (_, _, frequency)), sums) in rows.iter().zip(&points).zip(&found.sums) {
                    let lift = sums.lift * frequency / f64::from(PERIODS[1]);
                    for (computed, known) in [sums.tip, sums.psi, lift].into_iter().zip(&row[3..]) {
                        let known: f64 = known.parse().expect("a number");
                        let error = (computed / known - 1.0).abs();
                        assert!(error < worst, "{backend} at {rtol}: {computed} for {known} in {row:?}");
                    }
                }
            }
        }
    }
}
