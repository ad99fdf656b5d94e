//! Continuation of the edges of hysteresis: curves in the plane of two parameters on which an orbit loses its
//! stability.
//!
//! A bistable band of the first parameter p ends where a Floquet multiplier is +1. If a second parameter q changes, the
//! ends of the bistable bands form curves in the plane of p and q. A point of an edge solves these equations:
//!
//! ```text
//! P(x; p, q) − x = 0    P: map of a drive period, x: state at its beginning
//! test(M) = 0           M = ∂P/∂x: monodromy matrix
//! ```
//!
//! The test function is zero if a Floquet multiplier has its critical value (Kuznetsov, Elements of
//! Applied Bifurcation Theory, section 10.2):
//!
//! | kind | multipliers | test(M) |
//! |---|---|---|
//! | fold | +1 | det(M − 1) |
//! | period doubling | −1 | det(M + 1) |
//! | torus | a pair of modulus 1 | det(C − 1), with the second compound matrix C of M |
//!
//! Pseudo-arclength continuation follows the solutions in the space of the state x and the parameters p and q.
//!
//! Both folds of a band meet in a cusp, where the curve turns back in the plane of the parameters p and q.

use flap_core::num::Backend;
use flap_core::simulate::{Interrupt, Period, Status, Unfinished};
use nalgebra::linalg::Schur;
use nalgebra::{DMatrix, DVector, Dyn, LU, RowDVector};

use super::curve::{Curve, Step};
use super::edge::{CRITICAL, Edge, EdgeEnd, EdgeKind, EdgeMark, EdgePoint, EdgeRange, Edges, MOST};
use super::run::Responses;
use super::space::OrbitSpace;

/// Initial, shortest and longest distance between neighbouring points of an edge. A distance of 1 corresponds to about
/// the range of a parameter, and to the largest magnitude of a state component.
const STEPS: [f64; 3] = [0.01, 1e-5, 0.05];

/// Smallest cosine of the angle between tangents of neighbouring points.
const STRAIGHT: f64 = 0.95;

/// Largest number of iterations to compute a point from its neighbour, and number of iterations below which the
/// distance to the next point increases.
const SLOW: usize = 8;
const QUICK: usize = 4;

/// Largest number of iterations for the first point of an edge.
const FIRST: usize = 20;

/// Largest number of iterations for a cusp or a turn.
const MARKED: usize = 50;

/// Change of the state and the parameters for computing derivatives by differences, in the units of [`STEPS`].
const CHANGE: f64 = 1e-3;

/// Tolerances for the integration of drive periods, relative to the usual tolerances.
///
/// The test functions must change smoothly along an edge. At kinks of a force, the responses of a motion have larger
/// errors than the motion. With a hundredth of the usual tolerances, the test functions of a bimorph have errors of 5e-6.
const FINER: f64 = 1e-4;

/// Size of the last step of Newton's iteration, relative to the usual relative tolerance of the integration.
const CONVERGED: f64 = 0.1;

/// Largest distance of a point from the chord between two points of the same edge, relative to the length of the chord.
const ON_CHORD: f64 = 0.2;

impl Responses<'_> {
    /// Returns the edges of the bands of two motions in `curve`. Each edge is a line in the plane of two parameters: the
    /// parameter of the response, and the parameter `second`. `curve` is a response of the same plan.
    ///
    /// If the computation is interrupted, the edges are incomplete.
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

/// Returns the power of two nearest to a width. Divisions by a power of two are exact.
fn power_of_two(width: f64) -> f64 {
    width.log2().round().exp2()
}

/// Returns true if a point is on the polygonal line through the points of a trace.
fn is_on(trace: &[DVector<f64>], point: &DVector<f64>) -> bool {
    trace.windows(2).any(|ends| {
        let chord = &ends[1] - &ends[0];
        let share = ((point - &ends[0]).dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
        (point - &ends[0] - &chord * share).norm() <= ON_CHORD * chord.norm()
    })
}

/// The plane of two parameters, with the equations of an edge of one kind.
struct Plane<'a> {
    /// The space in which the edge is a curve. The units of the parameters are about the widths of their ranges.
    space: OrbitSpace<'a, 2>,
    ranges: [[f64; 2]; 2],
    /// Length of a step of Newton's iteration after which the iteration has converged.
    converged: f64,
    kind: EdgeKind,
}

/// A solution of the equations.
#[derive(Clone)]
struct Solution {
    place: DVector<f64>,
    period: Period,
    /// Derivatives of the equations with respect to state and parameters. The matrix has one more column than rows.
    jacobian: DMatrix<f64>,
    tangent: DVector<f64>,
    iterations: usize,
}

impl Plane<'_> {
    /// Returns the unit vector of the parameter `k`.
    fn axis(&self, k: usize) -> DVector<f64> {
        let mut axis = DVector::zeros(self.space.states() + 2);
        axis[self.space.states() + k] = 1.0;
        axis
    }

    /// Returns the residuals of the equations at a point of the edge, with the drive period that begins at this point.
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

    /// Returns the derivatives of the residuals by central differences.
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

    /// Returns the solution at a point that solves the equations, with a tangent that points along `direction`.
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

    /// Returns the solution near `guess` at the same value of the parameter `k`, by Newton's iteration.
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

    /// Returns the solution at a distance along the tangent of `last`, on the plane perpendicular to this tangent.
    ///
    /// All steps of Newton's iteration use the derivatives at `last`.
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

    /// Returns the point of the edge near these motions, which are the neighbours of the end of a band.
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

    /// Follows the edge from a point in both directions.
    ///
    /// Returns the edge, and all points of the continuation.
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

    /// Returns the points after `start` along its tangent, each with its mark, and the reason for the end.
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

    /// Returns the first parameter outside of its range, with the limit that the parameter exceeds.
    fn outside(&self, place: &DVector<f64>) -> Option<(usize, f64)> {
        self.space.values(place).into_iter().zip(self.ranges).enumerate().find_map(
            |(k, (value, [from, to]))| {
                let limit = value.clamp(from, to);
                (limit != value).then_some((k, limit))
            },
        )
    }

    /// Returns the point between two points with a given value of the parameter `k`.
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

    /// Returns the cusp or turn between two neighbouring points, by regula falsi (Illinois).
    ///
    /// If the edge turns back along the second parameter, the tangent has no component along this parameter. At a cusp
    /// of a fold, the tangent has no components along both parameters, and both components change their sign.
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

    /// Returns the first and the last point, the marked points, and points at equal steps of the second parameter. The
    /// steps begin at the first value of the second parameter.
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

/// Returns the test function of a monodromy matrix: zero if a Floquet multiplier has the critical value of this kind.
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

/// Returns the matrix of all 2 × 2 minors. The eigenvalues of the result are the products of two eigenvalues of `m`.
fn second_compound(m: &DMatrix<f64>) -> DMatrix<f64> {
    let n = m.nrows();
    let pairs: Vec<[usize; 2]> = (0..n).flat_map(|j| (0..j).map(move |i| [i, j])).collect();
    DMatrix::from_fn(pairs.len(), pairs.len(), |row, column| {
        let ([i, j], [k, l]) = (pairs[row], pairs[column]);
        m[(i, k)] * m[(j, l)] - m[(i, l)] * m[(j, k)]
    })
}

/// Returns the decomposition of a matrix of derivatives to which a last row is added.
fn bordered(jacobian: &DMatrix<f64>, last: &DVector<f64>) -> LU<f64, Dyn, Dyn> {
    let rows = jacobian.nrows();
    let mut matrix = jacobian.clone().insert_row(rows, 0.0);
    let last: RowDVector<f64> = last.transpose();
    matrix.set_row(rows, &last);
    matrix.lu()
}

/// Returns true if the Floquet multiplier nearest to modulus 1 is not real.
fn has_pair_of_modulus_one(monodromy: &DMatrix<f64>) -> bool {
    let Some(schur) = Schur::try_new(monodromy.clone(), f64::EPSILON, 200) else { return false };
    let eigenvalues = schur.complex_eigenvalues();
    let distance = |re: f64, im: f64| (re.hypot(im) - 1.0).abs();
    let nearest = eigenvalues.iter().min_by(|a, b| distance(a.re, a.im).total_cmp(&distance(b.re, b.im)));
    nearest.is_some_and(|value| value.im != 0.0 && distance(value.re, value.im) < CRITICAL - 1.0)
}
