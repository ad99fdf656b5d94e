//! Computes the unstable orbits in a bistable band, which connect the two stable branches.
//!
//! At the upper end of a bistable band, the upward branch of stable orbits turns back towards smaller
//! parameter values and becomes unstable. At the lower end of the band, the unstable branch turns again and
//! continues as the downward branch.
//!
//! The unstable orbits are computed by pseudo-arclength continuation (Keller, 1977). The unknowns are the
//! state at the beginning of the period, and the parameter of the response. Each orbit is sought on a plane
//! that is perpendicular to the line through the last two orbits.

use flap_core::num::Backend;
use flap_core::simulate::{Interrupt, Period, Row, Status};
use nalgebra::{DMatrix, DVector};

use super::curve::{Comparison, Curve, Step};
use super::space::OrbitSpace;
use crate::plan::{Along, Plan};

/// Initial, shortest and longest distance between successive orbits of the continuation. For this distance,
/// changes of the parameter are divided by the width of the band. Changes of a state component are divided by
/// the largest magnitude of the component.
const STEPS: [f64; 3] = [0.01, 1e-5, 0.03];

/// Largest number of steps of the continuation in one band.
const MOST: usize = 2000;

/// If Newton's iteration does not converge within `SLOW` iterations, the step is repeated with half the
/// length. If Newton's iteration needs at most `QUICK` iterations, the next step is longer.
const SLOW: usize = 8;
const QUICK: usize = 3;

/// Change of the parameter for finite differences, as a fraction of the width of the band.
const CHANGE: f64 = 1e-3;

/// The tolerances of the integration are the tolerances of the plan times this factor.
///
/// The errors of the integrated states must be far below `settle_tol`. With errors near `settle_tol`,
/// Newton's iteration may not find the next orbit.
const FINER: f64 = 1e-2;

/// Returns the unstable orbits in all bistable bands of a curve. If the computation is interrupted, the list
/// is incomplete.
pub(super) fn unstable(
    plan: &Plan,
    along: &Along,
    curve: &Curve,
    backend: Backend,
    interrupted: Interrupt<'_>,
) -> Vec<Step> {
    let is_bistable = |index: usize| {
        let rows = [&curve.up[index].row, &curve.down[index].row];
        rows.iter().all(|row| row.status == Status::Periodic)
            && curve.comparisons[index] == Comparison::Different
    };
    let mut found = Vec::new();
    for last in 1..curve.up.len() {
        let ends_here = is_bistable(last) && (last + 1 == curve.up.len() || !is_bistable(last + 1));
        // The branch ends between this value and the next. Two of its orbits define the direction.
        if !ends_here || curve.up[last - 1].row.status != Status::Periodic {
            continue;
        }
        let first = (0..last).rev().take_while(|&index| is_bistable(index)).last().unwrap_or(last);
        let width = (curve.up[last].value - curve.up[first].value).max(along.tolerance);
        let space = OrbitSpace::new(plan, curve, [(along.parameter, width)], FINER, backend, interrupted);
        found.extend(space.turn(&curve.up[last - 1], &curve.up[last]));
    }
    found
}

/// An orbit that Newton's iteration has found.
struct Orbit {
    place: DVector<f64>,
    period: Period,
    residual: f64,
    iterations: usize,
    rhs_evals: u64,
}

/// Follows a branch of orbits, which is a curve in the space of states and one parameter. The unit of the
/// parameter is the width of the band.
impl OrbitSpace<'_, 1> {
    /// Continues a branch beyond its last two stable orbits, `before` and `last`, and returns the unstable
    /// orbits that follow on the branch. The list is empty if the branch does not become unstable.
    fn turn(&self, before: &Step, last: &Step) -> Vec<Step> {
        let mut places = [before, last].map(|step| self.place(&step.row.state, [step.value]));
        let mut distance = STEPS[0];
        let mut found: Vec<Step> = Vec::new();
        for _ in 0..MOST {
            let [a, b] = &places;
            let direction = (b - a).normalize();
            let Some(orbit) = self.correct(&(b + &direction * distance), &direction) else {
                distance *= 0.5;
                if distance < STEPS[1] {
                    return found;
                }
                continue;
            };
            let (row, [value]) = (self.row(&orbit), self.values(&orbit.place));
            if orbit.iterations <= QUICK {
                distance = (1.5 * distance).min(STEPS[2]);
            }
            match row.status {
                Status::Unstable => found.push(Step { value, row }),
                // The continuation has turned at the other end and reached the other branch.
                _ if !found.is_empty() => return found,
                // The branch continues, so the band ended for another reason.
                _ if value > last.value + self.units[0] => return found,
                _ => {}
            }
            places = [places[1].clone(), orbit.place];
        }
        found
    }

    /// Returns the orbit that Newton's iteration finds near `guess`, on the plane through `guess` that is
    /// perpendicular to `direction`.
    fn correct(&self, guess: &DVector<f64>, direction: &DVector<f64>) -> Option<Orbit> {
        let n = self.states();
        let mut place = guess.clone();
        let mut rhs_evals = 0;
        for iterations in 0..SLOW {
            let period = self.period(&place).ok()?;
            rhs_evals += period.rhs_evals;
            let mut miss = DVector::from_fn(n + 1, |i, _| match i {
                i if i < n => period.end[i] / self.sizes[i] - place[i],
                _ => 0.0,
            });
            let residual = miss.amax();
            if residual <= self.solver.settle_tol {
                return Some(Orbit { place, period, residual, iterations, rhs_evals });
            }
            miss[n] = direction.dot(&(&place - guess));
            let mut changed = place.clone();
            changed[n] += CHANGE;
            let changed = self.period(&changed).ok()?;
            rhs_evals += changed.rhs_evals;
            let monodromy = self.monodromy(&period);
            let jacobian = DMatrix::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
                (true, true) => monodromy[(i, j)] - f64::from(u8::from(i == j)),
                (true, false) => (changed.end[i] - period.end[i]) / (CHANGE * self.sizes[i]),
                (false, _) => direction[j],
            });
            place -= jacobian.lu().solve(&miss)?;
        }
        None
    }

    fn row(&self, orbit: &Orbit) -> Row {
        let n = self.states();
        let Orbit { place, period, residual, iterations, rhs_evals } = orbit;
        let floquet_max = period.floquet_max;
        // A period with n responses counts as n + 1 periods, and each was also measured.
        let periods = (2 * iterations + 1) * (n + 2);
        Row {
            status: if floquet_max < 1.0 { Status::Periodic } else { Status::Unstable },
            measures: period.measures.clone(),
            cycles: u32::try_from(periods).unwrap_or(u32::MAX),
            residual: *residual,
            period: 1,
            floquet_max,
            error_estimate: f64::NAN,
            state: self.state(place),
            rhs_evals: *rhs_evals,
            reason: None,
        }
    }
}
