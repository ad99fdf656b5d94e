//! Computes the basins of attraction in bistable bands: the fraction of initial states from which the motion
//! settles on each branch.

use flap_core::num::Backend;
use flap_core::simulate::{
    Interrupt, Jobs, Point, PointRun, Row, SolverSettings, TrajectoryRequest, Unfinished,
};

use super::curve::{Comparison, Curve, Step, compare};
use super::run::Responses;
use crate::plan::{Plan, sample};

/// Number of instants in one period at which the states of an orbit are computed, to find their smallest and
/// largest values.
const SAMPLES: u32 = 64;

/// Number and seed of the random initial states with which basins of attraction are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Starts {
    /// Number of initial states at each value of the parameter of the response.
    pub count: u32,
    /// Seed of the random initial states.
    pub seed: u64,
}

/// Basins of attraction of the two stable orbits at one value of the parameter of the response.
#[derive(Clone, Debug, PartialEq)]
pub struct Basin {
    /// Value of the parameter of the response, in SI units.
    pub value: f64,
    /// Number of initial states from which motions are computed.
    pub count: u32,
    /// Three numbers of motions: motions that settle on the orbit of the upward branch, on the orbit of the
    /// downward branch, and on neither orbit.
    pub motions: [u32; 3],
}

impl Basin {
    /// Returns the three numbers in `motions` as fractions of all motions, each with its binomial standard
    /// error.
    pub fn shares(&self) -> [[f64; 2]; 3] {
        let count = f64::from(self.count);
        self.motions.map(|motions| {
            let share = f64::from(motions) / count;
            [share, (share * (1.0 - share) / count).sqrt()]
        })
    }
}

impl Responses<'_> {
    /// Computes the basins of attraction at each parameter value of `curve` at which the two branches have
    /// different stable orbits. The parameter values in the result are in ascending order.
    ///
    /// The initial states are uniformly distributed. Each component of an initial state lies between the
    /// smallest and the largest value that this component has among the states of the two orbits. Each motion
    /// is integrated period by period until the motion settles. Newton shooting is not used, because it may
    /// jump from one basin to the other basin.
    ///
    /// # Errors
    /// [`Unfinished`] if the model cannot compute motions over time, if the states of an orbit cannot be
    /// computed, or after an interruption.
    pub fn basins(
        self,
        curve: &Curve,
        starts: Starts,
        interrupted: Interrupt<'_>,
    ) -> Result<Vec<Basin>, Unfinished> {
        let Responses { plan, along } = self;
        let backend = Backend::best();
        let solver = SolverSettings { newton: false, ..*plan.solver() };
        let mut found = Vec::new();
        for ((up, down), comparison) in curve.up.iter().zip(&curve.down).zip(&curve.comparisons) {
            let orbits = [up, down];
            let are_orbits = orbits.iter().all(|step| step.row.stable() == Some(true));
            if !are_orbits || *comparison != Comparison::Different {
                continue;
            }
            let values = along.values_at(plan, &curve.design, up.value);
            let run = PointRun::new(backend, plan.solver(), &values).until(interrupted);
            let mut motions = Motions {
                ranges: ranges(plan, &run, orbits)?,
                values: &values,
                orbits,
                sizes: &curve.sizes,
                starts,
                next: 0,
                counts: [0; 3],
                interrupted,
            };
            plan.simulator().run(backend, &solver, &mut motions);
            if interrupted() {
                return Err(Unfinished::Interrupted);
            }
            found.push(Basin { value: up.value, count: starts.count, motions: motions.counts });
        }
        Ok(found)
    }
}

/// Returns the smallest and largest value of each state component on two orbits.
fn ranges(plan: &Plan, run: &PointRun<'_>, orbits: [&Step; 2]) -> Result<Vec<[f64; 2]>, Unfinished> {
    let states = orbits[0].row.state.len();
    let request = TrajectoryRequest { cycles: 1, samples_per_cycle: SAMPLES, settled: false };
    let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; states];
    for orbit in orbits {
        let motion = plan.simulator().motions()?.trajectory_from(run, Some(&orbit.row.state), &request)?;
        for sample in motion.rows {
            // The states follow the time.
            for ([least, most], y) in ranges.iter_mut().zip(&sample[1..]) {
                *least = least.min(*y);
                *most = most.max(*y);
            }
        }
    }
    Ok(ranges)
}

/// The motions from random initial states at one value of the parameter of the response.
struct Motions<'a> {
    ranges: Vec<[f64; 2]>,
    values: &'a [f64],
    orbits: [&'a Step; 2],
    sizes: &'a [f64],
    starts: Starts,
    /// Index of the next initial state, from which no motion has started yet.
    next: u32,
    counts: [u32; 3],
    interrupted: Interrupt<'a>,
}

impl Jobs for Motions<'_> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        if self.next == self.starts.count || (self.interrupted)() {
            return None;
        }
        let number = u64::from(self.next);
        self.next += 1;
        let component = |(dimension, [least, most]): (usize, &[f64; 2])| {
            least + sample::coordinate(self.starts.seed, dimension, number) * (most - least)
        };
        let begin = self.ranges.iter().enumerate().map(component).collect();
        Some(Point { begin: Some(begin), ..Point::at_rest(number, self.values.to_vec()) })
    }

    fn done(&mut self, _index: u64, row: Row) {
        let is_same = |orbit: &&Step| compare(&orbit.row, &row, self.sizes) == Comparison::Same;
        let motion = self.orbits.iter().position(is_same).unwrap_or(2);
        self.counts[motion] += 1;
    }

    fn interrupted(&self) -> bool {
        (self.interrupted)()
    }
}
