//! Boxes between points: their corners, their halving, and the choice of the next points.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::estimate::{self, Edge, Tolerance};

/// Coordinates along a refined axis, in which rows are interpolated.
#[derive(Clone, Debug)]
pub(super) enum Side {
    /// Equidistant coordinates, also for a constant ratio of values. Contains their number.
    Even(u64),
    /// Listed values.
    Listed(Vec<f64>),
}

impl Side {
    /// Returns the number of values of the axis.
    fn len(&self) -> u64 {
        match self {
            Side::Even(count) => *count,
            Side::Listed(list) => list.len() as u64,
        }
    }

    /// Returns the coordinate at a number of smallest steps, with `whole` steps between values of the axis.
    fn coordinate(&self, steps: u64, whole: u64) -> f64 {
        let position = steps as f64 / whole as f64;
        match self {
            Side::Even(_) => position,
            Side::Listed(list) => {
                let below = usize::try_from(steps / whole).unwrap_or(usize::MAX);
                let share = (steps % whole) as f64 / whole as f64;
                let low = list.get(below).copied().unwrap_or(f64::NAN);
                if share == 0.0 { low } else { low + (list[below + 1] - low) * share }
            }
        }
    }
}

/// Place of a point.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Place {
    /// Number of the combination of the axes that are not refined.
    pub(super) map: u64,
    /// Along each refined axis, the number of smallest steps from its first value.
    pub(super) at: Vec<u64>,
}

impl Place {
    /// Returns the place with another position along one axis.
    fn moved(&self, axis: usize, to: u64) -> Place {
        let mut place = self.clone();
        place.at[axis] = to;
        place
    }
}

/// A box between points.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Cell {
    low: Place,
    /// Number of halvings along each axis.
    halvings: Vec<u32>,
}

/// Points with their measures, and the boxes between them.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    sides: Vec<Side>,
    /// Largest number of halvings of a box.
    most: u32,
    measures: usize,
    /// Measures of all points, one point after another.
    measured: Vec<f64>,
    /// Number of each point.
    numbers: HashMap<Place, usize>,
    /// For each axis the lines along it, by their place at position 0: the points on the line by their position.
    lines: Vec<HashMap<Place, BTreeMap<u64, usize>>>,
    cells: Vec<Cell>,
}

/// A box that is to be halved.
struct Halving {
    /// Estimated error times the mean side of the box.
    ///
    /// The error alone would spend all points on jumps, whose error does not fall. Times the volume, the mean error
    /// would fall fastest, and the largest error late.
    gain: f64,
    cell: usize,
    axis: usize,
}

impl Mesh {
    /// Returns the mesh of the cells between the values of axes, for each of several `maps`.
    pub(super) fn new(sides: Vec<Side>, maps: u64, most: u32, measures: usize) -> Mesh {
        let mut corners: Vec<Vec<u64>> = vec![Vec::new()];
        for side in &sides {
            let steps = (0..side.len() - 1).map(|cell| cell << most);
            let longer = |corner: &Vec<u64>| {
                let corner = corner.clone();
                steps.clone().map(move |step| [corner.as_slice(), &[step]].concat())
            };
            corners = corners.iter().flat_map(longer).collect();
        }
        let cell = |map: u64, at: &Vec<u64>| Cell {
            low: Place { map, at: at.clone() },
            halvings: vec![0; sides.len()],
        };
        let cells = (0..maps).flat_map(|map| corners.iter().map(move |at| cell(map, at))).collect();
        let lines = vec![HashMap::new(); sides.len()];
        Mesh { sides, most, measures, measured: Vec::new(), numbers: HashMap::new(), lines, cells }
    }

    /// Adds a point with its measures. NaN is unknown.
    pub(super) fn add(&mut self, place: Place, measures: &[f64]) {
        let number = self.numbers.len();
        for (axis, lines) in self.lines.iter_mut().enumerate() {
            lines.entry(place.moved(axis, 0)).or_default().insert(place.at[axis], number);
        }
        self.measured.extend_from_slice(measures);
        self.numbers.insert(place, number);
    }

    /// Returns for each measure the difference between its largest and its smallest value; zero if there are none.
    pub(super) fn ranges(&self) -> Vec<f64> {
        let range = |measure: usize| {
            let values = self.measured.iter().skip(measure).step_by(self.measures);
            let values = values.copied().filter(|value| value.is_finite());
            let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            });
            (high - low).max(0.0)
        };
        (0..self.measures).map(range).collect()
    }

    /// Halves boxes whose estimated error is larger than the allowed one, in the order of their [`Halving::gain`]. Returns the middles of their edges that are not points yet, in ascending order.
    ///
    /// It ends at the first number that is at least `wanted`, and returns at most `room` places.
    pub(super) fn next_round(&mut self, tolerances: &[Tolerance], (wanted, room): (u64, u64)) -> Vec<Place> {
        let mut places = BTreeSet::new();
        loop {
            let mut halvings = self.halvings(tolerances);
            halvings.sort_by(|a, b| {
                b.gain.total_cmp(&a.gain).then_with(|| self.cells[a.cell].cmp(&self.cells[b.cell]))
            });
            let mut chosen = Vec::new();
            for halving in halvings {
                let Halving { cell, axis, .. } = halving;
                let middles = self.middles(&self.cells[cell], axis);
                let missing: Vec<Place> =
                    middles.into_iter().filter(|place| !self.numbers.contains_key(place)).collect();
                let new = missing.iter().filter(|place| !places.contains(*place)).count();
                if new > 0 && (places.len() as u64 >= wanted || (places.len() + new) as u64 > room) {
                    break;
                }
                places.extend(missing);
                chosen.push((cell, axis));
            }
            let is_over = chosen.is_empty() || !places.is_empty();
            self.halve(chosen);
            // Boxes whose new corners are all known were halved: their halves have estimates already.
            if is_over {
                return places.into_iter().collect();
            }
        }
    }

    /// Returns the number of boxes, of boxes with too large an estimated error, and of those among them that can be
    /// halved.
    pub(super) fn count(&self, tolerances: &[Tolerance]) -> [u64; 3] {
        let errors = self.cells.iter().map(|cell| self.errors(cell, tolerances).iter().sum::<f64>());
        let above = errors.filter(|error| *error > 1.0).count();
        [self.cells.len() as u64, above as u64, self.halvings(tolerances).len() as u64]
    }

    /// Returns the boxes that should be halved, each with its axis.
    fn halvings(&self, tolerances: &[Tolerance]) -> Vec<Halving> {
        let halving = |(number, cell): (usize, &Cell)| {
            let errors = self.errors(cell, tolerances);
            let sum: f64 = errors.iter().sum();
            let axis = estimate::axis(&errors, &cell.halvings, self.most).filter(|_| sum > 1.0)?;
            let halvings: u32 = cell.halvings.iter().sum();
            let size = libm::exp2(-f64::from(halvings) / errors.len() as f64);
            Some(Halving { gain: sum * size, cell: number, axis })
        };
        self.cells.iter().enumerate().filter_map(halving).collect()
    }

    /// Replaces each chosen box by its halves along an axis.
    fn halve(&mut self, mut chosen: Vec<(usize, usize)>) {
        chosen.sort_unstable_by_key(|(cell, _)| Reverse(*cell));
        for (number, axis) in chosen {
            let mut upper = self.cells[number].clone();
            upper.halvings[axis] += 1;
            let mut lower = upper.clone();
            upper.low.at[axis] += self.length(&upper, axis);
            std::mem::swap(&mut self.cells[number], &mut lower);
            self.cells.push(upper);
        }
    }

    /// Returns the length of a box along an axis, in smallest steps.
    fn length(&self, cell: &Cell, axis: usize) -> u64 {
        1 << (self.most - cell.halvings[axis])
    }

    /// Returns the lower ends of the edges of a box along an axis.
    fn edges(&self, cell: &Cell, axis: usize) -> Vec<Place> {
        let mut ends = vec![cell.low.clone()];
        for other in (0..self.sides.len()).filter(|other| *other != axis) {
            let length = self.length(cell, other);
            let moved: Vec<Place> = ends.iter().map(|end| end.moved(other, end.at[other] + length)).collect();
            ends.extend(moved);
        }
        ends
    }

    /// Returns the middles of the edges of a box along an axis.
    fn middles(&self, cell: &Cell, axis: usize) -> Vec<Place> {
        let half = self.length(cell, axis) / 2;
        self.edges(cell, axis).into_iter().map(|end| end.moved(axis, end.at[axis] + half)).collect()
    }

    /// Returns the estimated error of a box along each axis, relative to the allowed error.
    fn errors(&self, cell: &Cell, tolerances: &[Tolerance]) -> Vec<f64> {
        let along = |axis: usize| {
            let length = self.length(cell, axis);
            let mut largest = 0.0_f64;
            for low in self.edges(cell, axis) {
                let Some(line) = self.lines[axis].get(&low.moved(axis, 0)) else { continue };
                let (begin, end) = (low.at[axis], low.at[axis] + length);
                let before = line.range(..begin).next_back();
                let after = line.range(end + 1..).next();
                let (Some(first), Some(last)) = (line.get_key_value(&begin), line.get_key_value(&end)) else {
                    continue;
                };
                for (measure, tolerance) in tolerances.iter().enumerate() {
                    let at = |point: (&u64, &usize)| {
                        let steps = self.sides[axis].coordinate(*point.0, 1 << self.most);
                        (steps, self.measured[point.1 * self.measures + measure])
                    };
                    let edge = Edge {
                        before: before.map(at),
                        ends: [at(first), at(last)],
                        after: after.map(at),
                        is_whole: cell.halvings[axis] == 0,
                    };
                    largest = largest.max(edge.error(tolerance));
                }
            }
            largest
        };
        (0..self.sides.len()).map(along).collect()
    }
}
