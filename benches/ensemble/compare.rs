//! Lanes against scalars in one run, and the instructions of both.

use std::time::Instant;

use flap_core::num::Backend;

use crate::sweep::{POINTS, Sweep};

const ROUNDS: usize = 9;

/// Prints a line per backend.
pub(crate) fn lanes_with_scalars() {
    let sweep = Sweep::new();
    println!("lanes against scalars of the same arithmetic class, medians of {ROUNDS} interleaved runs:");
    for backend in Backend::available() {
        let mut ratios = Vec::new();
        let mut lane_seconds = Vec::new();
        let mut rhs_evals = 0;
        for _ in 0..ROUNDS {
            let begin = Instant::now();
            rhs_evals = sweep.lanes(backend);
            let lanes = begin.elapsed().as_secs_f64();
            let begin = Instant::now();
            sweep.scalars(backend);
            let scalars = begin.elapsed().as_secs_f64();
            ratios.push(scalars / lanes);
            lane_seconds.push(lanes);
        }
        let seconds = median(&mut lane_seconds);
        println!(
            "{:7} {:5.2} x the points of scalars: {:.0} points/s, {:.1} M right-hand sides/s{}",
            backend.name(),
            median(&mut ratios),
            POINTS as f64 / seconds,
            rhs_evals as f64 / seconds * 1e-6,
            instructions(backend),
        );
    }
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Instructions per right-hand side and lane while marching, as a phrase.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[expect(clippy::print_stderr, reason = "a bench reports")]
fn instructions(backend: Backend) -> String {
    use crate::counter::count;
    use crate::workload::{Task, Work};

    let per_rhs = |task| {
        let work = Work { preset: "ozaki2018-large", backend, task };
        let instructions = count(&work.to_string(), &mut |_| Ok(()))?;
        std::io::Result::Ok(instructions as f64 / work.rhs_evals() as f64)
    };
    match (per_rhs(Task::March), per_rhs(Task::ScalarMarch)) {
        (Ok(lanes), Ok(scalars)) => {
            format!(", {lanes:.1} instructions per right-hand side (scalars: {scalars:.1})")
        }
        (Err(error), _) | (_, Err(error)) => {
            eprintln!("{error}");
            String::new()
        }
    }
}

#[cfg(not(all(target_os = "linux", target_arch = "x86_64")))]
fn instructions(_set: Backend) -> String {
    String::new()
}
