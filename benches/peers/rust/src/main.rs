//! The crate `ode_solvers`: Dormand-Prince 5(4) with dense output, point by point. Arguments: POINTS RTOL OUT.

mod measures;
mod model;

use core::f64::consts::TAU;
use std::cell::Cell;
use std::error::Error;
use std::fs;
use std::time::Duration;

use nix::time::{ClockId, clock_gettime};
use ode_solvers::dop_shared::{IntegrationError, OutputType};
use ode_solvers::{Dopri5, System, Vector4};

use model::{MEASURED, PERIODS, SAMPLES_PER_PERIOD};

type State = Vector4<f64>;

/// A point's equations.
#[derive(Clone, Copy)]
struct Wing<'a> {
    force: f64,
    frequency: f64,
    evaluations: &'a Cell<u64>,
}

impl System<f64, State> for Wing<'_> {
    fn system(&self, t: f64, y: &State, dy: &mut State) {
        self.evaluations.set(self.evaluations.get() + 1);
        *dy = model::rates(self.force * (TAU * self.frequency * t).sin(), (*y).into()).into();
    }
}

impl Wing<'_> {
    /// The measures of a motion from rest.
    fn measures(self, rtol: f64) -> Result<[f64; 3], IntegrationError> {
        let period = self.frequency.recip();
        let sample = period / SAMPLES_PER_PERIOD;
        // Dense output is at equal distances from the beginning: the measured periods are a leg of their own.
        let begin = (PERIODS - MEASURED) * period;
        let settled = self.leg(0.0, begin, State::zeros(), 1e-3 * period, OutputType::Sparse, rtol)?;
        let settled = *settled.y_out().last().expect("the state at the end");
        let end = PERIODS * period + 0.5 * sample;
        let samples = self.leg(begin, end, settled, sample, OutputType::Dense, rtol)?;
        let samples: Vec<[f64; 4]> = samples.y_out().iter().map(|&y| y.into()).collect();
        Ok(measures::measures(&samples[..=(MEASURED * SAMPLES_PER_PERIOD) as usize]))
    }

    /// Integrates from `begin` to `end`, and keeps the states at the ends of steps or at each sample.
    fn leg(
        self,
        begin: f64,
        end: f64,
        y: State,
        first_step: f64,
        output: OutputType,
        rtol: f64,
    ) -> Result<Dopri5<f64, State, Self>, IntegrationError> {
        let sample = (self.frequency * SAMPLES_PER_PERIOD).recip();
        // What the crate takes if it is not told: safety, gain, and bounds of the factor.
        let (safety, beta, least, most) = (0.9, 0.04, 0.2, 10.0);
        let (atol, longest, steps) = (0.1 * rtol, end - begin, u32::MAX);
        #[rustfmt::skip]
        let mut stepper = Dopri5::from_param(
            self, begin, end, sample, y, rtol, atol, safety, beta, least, most, longest, first_step, steps, steps, output,
        );
        stepper.integrate()?;
        Ok(stepper)
    }
}

fn cpu_time() -> Result<Duration, nix::Error> {
    clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID).map(Duration::from)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [points, rtol, out] = &arguments[..] else {
        return Err("three arguments are needed: POINTS RTOL OUT".into());
    };
    let text = fs::read_to_string(points)?;
    let mut points = Vec::new();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [id, force, frequency] = cells[..] else { return Err(format!("not a point: {line}").into()) };
        points.push((id, force.parse()?, frequency.parse()?));
    }
    let rtol: f64 = rtol.parse()?;

    let evaluations = Cell::new(0);
    let begin = cpu_time()?;
    let runs =
        points.iter().map(|&(_, force, frequency)| Wing { force, frequency, evaluations: &evaluations });
    let found: Vec<[f64; 3]> = runs.map(|wing| wing.measures(rtol)).collect::<Result<_, _>>()?;
    let seconds = cpu_time()?.saturating_sub(begin).as_secs_f64();

    let mut table = vec!["id,max_x,max_psi,lift".to_owned()];
    for ((id, ..), [tip, psi, lift]) in points.iter().zip(found) {
        table.push(format!("{id},{tip:e},{psi:e},{lift:e}"));
    }
    fs::write(out, table.join("\n") + "\n")?;
    let per_point = evaluations.get() as f64 / points.len() as f64;
    println!("{{\"cpu_s\":{seconds},\"rhs_per_point\":{per_point}}}");
    Ok(())
}
