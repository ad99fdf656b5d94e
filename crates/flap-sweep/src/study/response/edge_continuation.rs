//! Computes the edges of hysteresis by continuation. Edges are curves in the plane of two parameters, on
//! which an orbit loses its stability.
//!
//! Let p be the parameter of the response. A bistable band of p ends where a Floquet multiplier is critical,
//! for example +1 at a fold. If a second parameter q changes, the ends of the band move along curves in the
//! plane of p and q, which are called edges. Each point of an edge solves these equations:
//!
//! ```text
//! P(x; p, q) − x = 0    P: map of a drive period, x: state at its beginning
//! test(M) = 0           M = ∂P/∂x: monodromy matrix
//! ```
//!
//! The function test(M) of the monodromy matrix M is zero if a Floquet multiplier is critical (Kuznetsov,
//! Elements of Applied Bifurcation Theory, section 10.2):
//!
//! | kind | multipliers | test(M) |
//! |---|---|---|
//! | fold | +1 | det(M − 1) |
//! | period doubling | −1 | det(M + 1) |
//! | torus | a pair of modulus 1 | det(C − 1), with the second compound matrix C of M |
//!
//! Pseudo-arclength continuation computes the curve of solutions in the space of the state x and the
//! parameters p and q.
//!
//! At a cusp, the folds at both ends of a band meet, and the edge turns back in the plane of p and q.

use flap_core::num::Backend;
use flap_core::simulate::{Interrupt, Period, Status, Unfinished};
use nalgebra::linalg::Schur;
use nalgebra::{DMatrix, DVector, Dyn, LU, RowDVector};

use super::curve::{Curve, Step};
use super::edge::{CRITICAL, Edge, EdgeEnd, EdgeKind, EdgeMark, EdgePoint, EdgeRange, Edges, MOST};
use super::run::Responses;
use super::space::OrbitSpace;

/// Initial, shortest and longest distance between successive points of an edge. For this distance, changes of
/// a parameter are divided by about the width of the parameter's range. Changes of a state component are
/// divided by the largest magnitude of the component.
const STEPS: [f64; 3] = [0.01, 1e-5, 0.05];

/// If the cosine of the angle between the tangents at successive points is smaller than this value, the step
/// is halved.
const STRAIGHT: f64 = 0.95;

/// If Newton's iteration does not converge within `SLOW` iterations, the step to the next point is halved. If
/// Newton's iteration needs at most `QUICK` iterations, the next step is longer.
const SLOW: usize = 8;
const QUICK: usize = 4;

/// Largest number of Newton iterations for a point at a given value of a parameter, such as the first point
/// of an edge.
const FIRST: usize = 20;

/// Largest number of iterations of regula falsi for the position of a cusp or a turn.
const MARKED: usize = 50;

/// Change of a state component or a parameter for finite differences. The change is divided as described at
/// [`STEPS`].
const CHANGE: f64 = 1e-3;

/// The tolerances of the integration are the tolerances of the plan times this factor.
///
/// The small tolerances are necessary because the test functions must change smoothly along an edge. At kinks
/// of a force, the monodromy matrix has larger errors than the motion. With a factor of 0.01 instead of
/// 0.0001, the test functions of a bimorph have errors of 5e-6.
const FINER: f64 = 1e-4;

/// Newton's iteration has converged when its step is shorter than this value times the relative tolerance of
/// the plan.
const CONVERGED: f64 = 0.1;

/// A point counts as a point of an edge if it is near the straight line between two successive points of the
/// edge. The largest allowed distance from the line is this fraction of the line's length.
const ON_CHORD: f64 = 0.2;

impl Responses<'_> {
    /// Returns the edges on which the bistable bands of `curve` end. Each edge is a curve in the plane of two
    /// parameters: the parameter of the response, and the parameter of `second`. `curve` must be a response
    /// of the plan of `self`.
    ///
    /// If the computation is interrupted, edges are missing or incomplete.
    pub fn edges(self, curve: &Curve, second: &EdgeRange, interrupted: Interrupt<'_>) -> Edges {
        let Responses { plan, along } = self;
        let range = [along.values[0], along.values[along.values.len() - 1]];
        let ranges = [range, second.range];
        let [one, other] = ranges.map(|[from, to]| power_of_two(to - from));
        let parameters = [(along.parameter, one), (second.parameter, other)];
        let plane = |kind| Plane {
            space: OrbitSpace::new(plan, curve, parameters, FINER, Backend::best(), interrupted),
            ranges,
            converged: CONVERGED * plan.solver().rtol,
            kind,
        };
        let comparisons = &curve.comparisons;
        let mut found = Edges { edges: Vec::new(), missed: Vec::new() };
        // The points of the continuation for each of these edges.
        let mut traces: Vec<Vec<DVector<f64>>> = Vec::new();
        for place in 1..comparisons.len() {
            if comparisons[place - 1] == comparisons[place] || interrupted() {
                continue;
            }
            let motions = [place - 1, place].map(|index| [&curve.up[index], &curve.down[index]]).concat();
            let start = EdgeKind::ALL.into_iter().find_map(|kind| {
                let plane = plane(kind);
                plane.start(&motions, second).map(|start| (plane, start))
            });
            let Some((plane, start)) = start else {
                found.missed.push(0.5 * (curve.up[place - 1].value + curve.up[place].value));
                continue;
            };
            if traces.iter().any(|trace| is_on(trace, &start.place)) {
                continue;
            }
            let (edge, trace) = plane.trace(&start, second);
            found.edges.push(edge);
            traces.push(trace);
        }
        found
    }
}

/// Returns the power of two that is nearest to the width of a range. Divisions by a power of two have no
/// rounding errors.
fn power_of_two(width: f64) -> f64 {
    width.log2().round().exp2()
}

/// Returns true if a point is close to one of the straight lines that connect successive points of `trace`.
fn is_on(trace: &[DVector<f64>], point: &DVector<f64>) -> bool {
    trace.windows(2).any(|ends| {
        let chord = &ends[1] - &ends[0];
        let share = ((point - &ends[0]).dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
        (point - &ends[0] - &chord * share).norm() <= ON_CHORD * chord.norm()
    })
}

/// Computes edges of one kind in the plane of two parameters.
struct Plane<'a> {
    /// The space of the state and the two parameters. The unit of each parameter is about the width of its
    /// range.
    space: OrbitSpace<'a, 2>,
    ranges: [[f64; 2]; 2],
    /// Newton's iteration has converged when its step is at most this long.
    converged: f64,
    kind: EdgeKind,
}

/// A solution of the equations, which is a point of an edge.
#[derive(Clone)]
struct Solution {
    place: DVector<f64>,
    period: Period,
    /// Derivatives of the equations with respect to the state and the two parameters. The matrix has one more
    /// column than it has rows.
    jacobian: DMatrix<f64>,
    tangent: DVector<f64>,
    iterations: usize,
}

impl Plane<'_> {
    /// Returns the unit vector along the parameter with the number `k`: 0 for the parameter of the response,
    /// 1 for the second parameter.
    fn axis(&self, k: usize) -> DVector<f64> {
        let mut axis = DVector::zeros(self.space.states() + 2);
        axis[self.space.states() + k] = 1.0;
        axis
    }

    /// Returns the residuals of the equations at `place`, and the motion over the drive period that begins at
    /// `place`.
    fn residual(&self, place: &DVector<f64>) -> Result<(DVector<f64>, Period), EdgeEnd> {
        let period = self.space.period(place).map_err(EdgeEnd::Unfinished)?;
        let n = self.space.states();
        let monodromy = self.space.monodromy(&period);
        let residual = DVector::from_fn(n + 1, |i, _| match i {
            i if i < n => period.end[i] / self.space.sizes[i] - place[i],
            _ => test(self.kind, &monodromy),
        });
        Ok((residual, period))
    }

    /// Computes the derivatives of the residuals by central differences.
    fn jacobian(&self, place: &DVector<f64>) -> Result<DMatrix<f64>, EdgeEnd> {
        let n = self.space.states();
        let mut jacobian = DMatrix::zeros(n + 1, n + 2);
        for j in 0..n + 2 {
            let changed = |change: f64| {
                let mut changed = place.clone();
                changed[j] += change;
                self.residual(&changed)
            };
            let slope = (changed(CHANGE)?.0 - changed(-CHANGE)?.0) / (2.0 * CHANGE);
            jacobian.set_column(j, &slope);
        }
        Ok(jacobian)
    }

    /// Adds the derivatives and the tangent to a point that solves the equations. The scalar product of the
    /// tangent and `direction` is positive.
    fn solution(
        &self,
        place: DVector<f64>,
        direction: &DVector<f64>,
        iterations: usize,
    ) -> Result<Solution, EdgeEnd> {
        let jacobian = self.jacobian(&place)?;
        let (_, period) = self.residual(&place)?;
        if self.kind == EdgeKind::Torus && !has_pair_of_modulus_one(&self.space.monodromy(&period)) {
            return Err(EdgeEnd::Resonance);
        }
        let mut last = DVector::zeros(self.space.states() + 2);
        last[self.space.states() + 1] = 1.0;
        let tangent = bordered(&jacobian, direction).solve(&last).ok_or(EdgeEnd::Unconverged)?.normalize();
        Ok(Solution { place, period, jacobian, tangent, iterations })
    }

    /// Returns the solution that Newton's iteration finds near `guess`. The parameter with the number `k`
    /// keeps its value.
    fn solve_at(&self, k: usize, guess: DVector<f64>) -> Result<Solution, EdgeEnd> {
        let axis = self.axis(k);
        let mut place = guess;
        for iterations in 0..FIRST {
            let (residual, _) = self.residual(&place)?;
            let step = bordered(&self.jacobian(&place)?, &axis).solve(&residual.push(0.0));
            let step = step.filter(|step| step.amax() < 1.0).ok_or(EdgeEnd::Unconverged)?;
            place -= &step;
            if step.amax() <= self.converged {
                return self.solution(place, &axis, iterations);
            }
        }
        Err(EdgeEnd::Unconverged)
    }

    /// Returns a solution at the given distance from `last` along the tangent at `last`. Newton's iteration
    /// seeks the solution on a plane that is perpendicular to this tangent.
    ///
    /// To save time, Newton's iteration uses the derivatives at `last` in all its steps.
    fn solve_beside(&self, last: &Solution, distance: f64) -> Result<Solution, EdgeEnd> {
        let guess = &last.place + &last.tangent * distance;
        let lu = bordered(&last.jacobian, &last.tangent);
        let mut place = guess.clone();
        for iterations in 1..=SLOW {
            let (residual, _) = self.residual(&place)?;
            let along = last.tangent.dot(&(&place - &guess));
            let step = lu.solve(&residual.push(along)).ok_or(EdgeEnd::Unconverged)?;
            place -= &step;
            if step.amax() <= self.converged {
                return self.solution(place, &last.tangent, iterations);
            }
            if step.amax() > distance {
                break;
            }
        }
        Err(EdgeEnd::Unconverged)
    }

    /// Returns a point of an edge, computed from the motions next to the end of a band. Returns `None` if no
    /// edge is close to these motions.
    fn start(&self, motions: &[&Step], second: &EdgeRange) -> Option<Solution> {
        let value = self.space.design.values[second.parameter];
        let periodic = motions.iter().filter(|step| step.row.status == Status::Periodic);
        let mut periodic: Vec<&&Step> = periodic.collect();
        // The motion nearest to the loss of its stability first.
        periodic.sort_by(|a, b| b.row.floquet_max.total_cmp(&a.row.floquet_max));
        let [low, high] = [motions[0].value, motions[motions.len() - 1].value];
        let near = (2.0 * low - high)..=(2.0 * high - low);
        periodic.into_iter().find_map(|step| {
            let start = self.solve_at(1, self.space.place(&step.row.state, [step.value, value])).ok()?;
            let is_near = near.contains(&self.space.values(&start.place)[0]);
            (is_near && start.period.floquet_max <= CRITICAL).then_some(start)
        })
    }

    /// Computes the edge from the point `start` in both directions.
    ///
    /// The second result contains the coordinates of all computed points.
    fn trace(&self, start: &Solution, second: &EdgeRange) -> (Edge, Vec<DVector<f64>>) {
        let back = Solution { tangent: -&start.tangent, ..start.clone() };
        let (mut points, before) = self.follow(&back);
        points.reverse();
        points.push((start.clone(), None));
        let mut ends = [before.clone(), before];
        if ends[0] != EdgeEnd::Closed {
            let (more, after) = self.follow(start);
            points.extend(more);
            ends[1] = after;
        }
        let trace = points.iter().map(|(solution, _)| solution.place.clone()).collect();
        if let Some(step) = second.step {
            points = self.at_steps(&points, step);
        }
        let points = points.iter().map(|(solution, mark)| self.point(solution, *mark)).collect();
        (Edge { kind: self.kind, points, ends }, trace)
    }

    /// Computes the edge from `start` in the direction of its tangent. Returns the computed points, the marks
    /// of special points, and the reason why the edge ends.
    fn follow(&self, start: &Solution) -> (Vec<(Solution, Option<EdgeMark>)>, EdgeEnd) {
        let mut last = start.clone();
        let mut distance = STEPS[0];
        let mut found: Vec<(Solution, Option<EdgeMark>)> = Vec::new();
        while found.len() < MOST {
            let next = match self.solve_beside(&last, distance) {
                Ok(next) if next.tangent.dot(&last.tangent) >= STRAIGHT => next,
                Err(end @ EdgeEnd::Unfinished(Unfinished::Interrupted)) => return (found, end),
                other => {
                    distance *= 0.5;
                    if distance < STEPS[1] {
                        return (found, other.err().unwrap_or(EdgeEnd::Unconverged));
                    }
                    continue;
                }
            };
            let marked = self.marked(&last, &next).filter(|(point, _)| self.outside(&point.place).is_none());
            found.extend(marked.map(|(point, mark)| (point, Some(mark))));
            if let Some((k, limit)) = self.outside(&next.place) {
                // The edge may begin at the limit.
                if (self.space.values(&last.place)[k] - limit).abs() > 1e-9 * limit.abs() {
                    found.extend(self.between(k, limit, &last, &next).map(|end| (end, None)));
                }
                return (found, EdgeEnd::Range(self.space.parameters[k]));
            }
            if found.len() > 3 && is_on(&[last.place.clone(), next.place.clone()], &start.place) {
                found.push((start.clone(), None));
                return (found, EdgeEnd::Closed);
            }
            if next.iterations <= QUICK {
                distance = (1.5 * distance).min(STEPS[2]);
            }
            found.push((next.clone(), None));
            last = next;
        }
        (found, EdgeEnd::Long)
    }

    /// If a parameter is outside of its range, returns the number of the parameter and the end of the range
    /// that the parameter exceeds.
    fn outside(&self, place: &DVector<f64>) -> Option<(usize, f64)> {
        self.space.values(place).into_iter().zip(self.ranges).enumerate().find_map(
            |(k, (value, [from, to]))| {
                let limit = value.clamp(from, to);
                (limit != value).then_some((k, limit))
            },
        )
    }

    /// Returns the point of the edge between `one` and `other` at which the parameter with the number `k` has
    /// the given value.
    fn between(&self, k: usize, value: f64, one: &Solution, other: &Solution) -> Option<Solution> {
        let place = self.space.states() + k;
        let scaled = value / self.space.units[k];
        let share = (scaled - one.place[place]) / (other.place[place] - one.place[place]);
        let mut guess = &one.place + (&other.place - &one.place) * share;
        guess[place] = scaled;
        let mut found = self.solve_at(k, guess).ok()?;
        found.place[place] = scaled;
        Some(found)
    }

    /// Returns the cusp or turn of an edge between two successive points, if there is one. A turn is a local
    /// minimum or maximum of the second parameter. The position of the cusp or turn is computed by the
    /// Illinois variant of regula falsi.
    ///
    /// At a turn, the second parameter does not change along the edge: the tangent's component along this
    /// parameter is zero. At a cusp, the tangent's components along both parameters are zero and change their
    /// sign.
    fn marked(&self, last: &Solution, next: &Solution) -> Option<(Solution, EdgeMark)> {
        let n = self.space.states();
        let parameters = |solution: &Solution| solution.tangent.rows(n, 2).into_owned();
        let (before, after) = (parameters(last), parameters(next));
        let (mark, direction) = if self.kind == EdgeKind::Fold && before.dot(&after) < 0.0 {
            (EdgeMark::Cusp, before)
        } else if before[1] * after[1] < 0.0 {
            (EdgeMark::Turn, DVector::from_vec(vec![0.0, before[1]]))
        } else {
            return None;
        };
        let rate = |solution: &Solution| direction.dot(&parameters(solution));
        let mut low = (0.0, rate(last));
        let mut high = ((&next.place - &last.place).dot(&last.tangent), rate(next));
        let enough = 1e-6 * low.1;
        let mut found = None;
        for _ in 0..MARKED {
            let middle = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            let point = self.solve_beside(last, middle).ok()?;
            let value = rate(&point);
            found = Some((point, mark));
            if value.abs() <= enough || high.0 - low.0 <= self.converged {
                break;
            }
            if value > 0.0 {
                low = (middle, value);
                high.1 *= 0.5;
            } else {
                high = (middle, value);
                low.1 *= 0.5;
            }
        }
        found
    }

    /// Returns points of the edge at equal steps of the second parameter, counted from the smallest value of
    /// its range. The list also contains the first point, the last point, and all cusps and turns.
    fn at_steps(
        &self,
        points: &[(Solution, Option<EdgeMark>)],
        step: f64,
    ) -> Vec<(Solution, Option<EdgeMark>)> {
        let from = self.ranges[1][0];
        let number = |solution: &Solution| (self.space.values(&solution.place)[1] - from) / step;
        let last = points.len() - 1;
        let mut found = Vec::new();
        for (i, (solution, mark)) in points.iter().enumerate() {
            if let Some((before, _)) = i.checked_sub(1).map(|before| &points[before]) {
                let [a, b] = [number(before), number(solution)];
                let whole = |number: f64| self.between(1, from + step * number, before, solution);
                let mut numbers: Vec<f64> = Vec::new();
                let mut next = a.min(b).floor() + 1.0;
                while next < a.max(b) {
                    numbers.push(next);
                    next += 1.0;
                }
                if a > b {
                    numbers.reverse();
                }
                found.extend(numbers.into_iter().filter_map(whole).map(|point| (point, None)));
            }
            if mark.is_some() || i == 0 || i == last || number(solution).fract() == 0.0 {
                found.push((solution.clone(), *mark));
            }
        }
        found
    }

    fn point(&self, solution: &Solution, mark: Option<EdgeMark>) -> EdgePoint {
        let Solution { place, period, .. } = solution;
        let mut measures = period.measures.clone();
        self.space.plan.add_own_measures(&self.space.model_values(place), &mut measures);
        let floquet_max = period.floquet_max;
        EdgePoint {
            values: self.space.values(place),
            mark,
            state: self.space.state(place),
            measures,
            floquet_max,
        }
    }
}

/// Returns the value of the test function for a monodromy matrix. The value is zero if a Floquet multiplier
/// has the critical value of `kind`.
fn test(kind: EdgeKind, m: &DMatrix<f64>) -> f64 {
    let one = |n| DMatrix::<f64>::identity(n, n);
    match kind {
        EdgeKind::Fold => (m - one(m.nrows())).determinant(),
        EdgeKind::PeriodDoubling => (m + one(m.nrows())).determinant(),
        EdgeKind::Torus => {
            let compound = second_compound(m);
            let n = compound.nrows();
            (compound - one(n)).determinant()
        }
    }
}

/// Returns the matrix of all 2 × 2 minors of `m`. The eigenvalues of the result are the products of pairs of
/// eigenvalues of `m`.
fn second_compound(m: &DMatrix<f64>) -> DMatrix<f64> {
    let n = m.nrows();
    let pairs: Vec<[usize; 2]> = (0..n).flat_map(|j| (0..j).map(move |i| [i, j])).collect();
    DMatrix::from_fn(pairs.len(), pairs.len(), |row, column| {
        let ([i, j], [k, l]) = (pairs[row], pairs[column]);
        m[(i, k)] * m[(j, l)] - m[(i, l)] * m[(j, k)]
    })
}

/// Appends the row `last` to a matrix of derivatives, and returns the LU decomposition of the square matrix.
fn bordered(jacobian: &DMatrix<f64>, last: &DVector<f64>) -> LU<f64, Dyn, Dyn> {
    let rows = jacobian.nrows();
    let mut matrix = jacobian.clone().insert_row(rows, 0.0);
    let last: RowDVector<f64> = last.transpose();
    matrix.set_row(rows, &last);
    matrix.lu()
}

/// Returns true if the Floquet multiplier whose modulus is nearest to 1 is complex, and its modulus is 1
/// within the tolerance.
fn has_pair_of_modulus_one(monodromy: &DMatrix<f64>) -> bool {
    let Some(schur) = Schur::try_new(monodromy.clone(), f64::EPSILON, 200) else { return false };
    let eigenvalues = schur.complex_eigenvalues();
    let distance = |re: f64, im: f64| (re.hypot(im) - 1.0).abs();
    let nearest = eigenvalues.iter().min_by(|a, b| distance(a.re, a.im).total_cmp(&distance(b.re, b.im)));
    nearest.is_some_and(|value| value.im != 0.0 && distance(value.re, value.im) < CRITICAL - 1.0)
}
