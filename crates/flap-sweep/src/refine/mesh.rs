//! The boxes between the points of a refined grid, and the choice of the boxes to halve.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::estimate::{self, Edge, Tolerance};

/// Coordinates along an axis, between which measures are interpolated.
#[derive(Clone, Debug)]
pub(super) enum Side {
    /// Equidistant coordinates 0, 1, 2 and so on, for axis values with a constant difference or a constant
    /// ratio. `Even(n)` has `n` coordinates.
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

    /// Returns the coordinate that is `steps` steps after the first value of the axis. Two neighbouring
    /// values of the axis are `whole` steps apart.
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

/// Place of a point in the mesh.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Place {
    /// Index of the combination of values of the axes along which no points are added.
    pub(super) map: u64,
    /// Position along each axis of the mesh, as the number of steps from the first value of the axis. A step
    /// is the shortest possible side of a box.
    pub(super) at: Vec<u64>,
}

impl Place {
    /// Returns a copy of the place with the position `to` along one axis.
    fn moved(&self, axis: usize, to: u64) -> Place {
        let mut place = self.clone();
        place.at[axis] = to;
        place
    }
}

/// A box whose corners are points of the grid.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Cell {
    low: Place,
    /// Number of times that the box has been halved along each axis.
    halvings: Vec<u32>,
}

/// Points with their measures, and the boxes between the points.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    sides: Vec<Side>,
    /// Largest number of times that a box can be halved along each axis.
    most: u32,
    measures: usize,
    /// Measures of all points, in the order of the points.
    measured: Vec<f64>,
    /// Index of the point at each place. Points are numbered in the order in which they were added.
    numbers: HashMap<Place, usize>,
    /// For each axis of the mesh, the lines of points that are parallel to the axis. The key in the map is
    /// the place at position 0 of the line, which is the first value of the axis. A line maps the position of
    /// each point along the axis to the index of the point.
    lines: Vec<HashMap<Place, BTreeMap<u64, usize>>>,
    cells: Vec<Cell>,
}

/// A box that is to be halved.
struct Halving {
    /// Priority of the halving: the estimated error of the box times the geometric mean of the side lengths
    /// of the box. Boxes with the highest priority are halved first.
    ///
    /// If the error alone determined the order, all points would be added at jumps of a measure, where
    /// halving does not decrease the error. If the error times the volume determined the order, the largest
    /// error would decrease slowly.
    gain: f64,
    cell: usize,
    axis: usize,
}

impl Mesh {
    /// Returns a mesh with a box between all neighbouring values of the axes. There is a separate set of
    /// boxes for each of the `maps` combinations of values of the axes along which no points are added.
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

    /// Adds a point with its measures. An unknown measure is NaN.
    pub(super) fn add(&mut self, place: Place, measures: &[f64]) {
        let number = self.numbers.len();
        for (axis, lines) in self.lines.iter_mut().enumerate() {
            lines.entry(place.moved(axis, 0)).or_default().insert(place.at[axis], number);
        }
        self.measured.extend_from_slice(measures);
        self.numbers.insert(place, number);
    }

    /// Returns the difference between the largest and the smallest value of each measure. If a measure has no
    /// values, the difference is zero.
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

    /// Halves boxes whose estimated error is larger than the allowed error, beginning with the largest
    /// [`Halving::gain`]. Returns the places of the new points in ascending order: the midpoints of halved
    /// edges.
    ///
    /// The function stops when it has found at least `wanted` new points, and returns at most `room` new
    /// points.
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

    /// Returns the number of all boxes, and the number of boxes whose estimated error is too large. The third
    /// number counts the boxes with a too large error that can still be halved.
    pub(super) fn count(&self, tolerances: &[Tolerance]) -> [u64; 3] {
        let errors = self.cells.iter().map(|cell| self.errors(cell, tolerances).iter().sum::<f64>());
        let above = errors.filter(|error| *error > 1.0).count();
        [self.cells.len() as u64, above as u64, self.halvings(tolerances).len() as u64]
    }

    /// Returns the boxes that should be halved, each with the axis along which it should be halved.
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

    /// Replaces each chosen box by its two halves. `chosen` contains the index of each box and the axis of
    /// the halving.
    fn halve(&mut self, chosen: Vec<(usize, usize)>) {
        for (number, axis) in chosen {
            self.cells[number].halvings[axis] += 1;
            let mut upper = self.cells[number].clone();
            upper.low.at[axis] += self.length(&upper, axis);
            self.cells.push(upper);
        }
    }

    /// Returns the length of a box along an axis, as a multiple of the shortest possible side of a box.
    fn length(&self, cell: &Cell, axis: usize) -> u64 {
        1 << (self.most - cell.halvings[axis])
    }

    /// Returns the lower ends of those edges of a box that are parallel to an axis.
    fn edges(&self, cell: &Cell, axis: usize) -> Vec<Place> {
        let mut ends = vec![cell.low.clone()];
        for other in (0..self.sides.len()).filter(|other| *other != axis) {
            let length = self.length(cell, other);
            let moved: Vec<Place> = ends.iter().map(|end| end.moved(other, end.at[other] + length)).collect();
            ends.extend(moved);
        }
        ends
    }

    /// Returns the midpoints of those edges of a box that are parallel to an axis.
    fn middles(&self, cell: &Cell, axis: usize) -> Vec<Place> {
        let half = self.length(cell, axis) / 2;
        self.edges(cell, axis).into_iter().map(|end| end.moved(axis, end.at[axis] + half)).collect()
    }

    /// Returns the largest estimated error of a box along each axis, divided by the allowed error.
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

#[cfg(test)]
mod tests {
    use super::*;

    const HALVINGS: u32 = 6;

    /// Refines a mesh over the unit square, with the values of the function `measure` at the points of the
    /// mesh.
    fn refined(side: u64, most: usize, share: f64, measure: impl Fn(f64, f64) -> f64) -> (Mesh, usize) {
        let mut mesh = Mesh::new(vec![Side::Even(side), Side::Even(side)], 1, HALVINGS, 1);
        let whole = ((side - 1) << HALVINGS) as f64;
        let value = |place: &Place| measure(place.at[0] as f64 / whole, place.at[1] as f64 / whole);
        let mut places: Vec<Place> = (0..side * side)
            .map(|index| Place { map: 0, at: vec![(index / side) << HALVINGS, (index % side) << HALVINGS] })
            .collect();
        while !places.is_empty() {
            for place in places {
                let value = value(&place);
                mesh.add(place, &[value]);
            }
            let tolerances = tolerances(&mesh, share);
            let room = (most - mesh.numbers.len()) as u64;
            places = mesh.next_round(&tolerances, (64.min(room), room));
        }
        let points = mesh.numbers.len();
        (mesh, points)
    }

    fn tolerances(mesh: &Mesh, share: f64) -> Vec<Tolerance> {
        mesh.ranges().into_iter().map(|range| Tolerance { error: share * range, range }).collect()
    }

    /// Returns the largest error of the bilinear interpolation of `measure` in the given boxes. A box is
    /// given by its lower corner and its side lengths.
    fn largest_error(
        boxes: impl Iterator<Item = ([f64; 2], [f64; 2])>,
        measure: impl Fn(f64, f64) -> f64,
    ) -> f64 {
        let mut largest = 0.0_f64;
        for ([x, y], [width, height]) in boxes {
            let corner = |right: f64, up: f64| measure(x + right * width, y + up * height);
            let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0), corner(1.0, 1.0)];
            for place in 0..81 {
                let (right, up) = (f64::from(place % 9) / 8.0, f64::from(place / 9) / 8.0);
                let low = corners[0] + (corners[1] - corners[0]) * right;
                let high = corners[2] + (corners[3] - corners[2]) * right;
                largest = largest.max((low + (high - low) * up - corner(right, up)).abs());
            }
        }
        largest
    }

    fn boxes(mesh: &Mesh) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + '_ {
        let whole = ((mesh.sides[0].len() - 1) << HALVINGS) as f64;
        let corner = move |cell: &Cell| [0, 1].map(|axis| cell.low.at[axis] as f64 / whole);
        mesh.cells
            .iter()
            .map(move |cell| (corner(cell), [0, 1].map(|axis| mesh.length(cell, axis) as f64 / whole)))
    }

    fn even_boxes(side: u32) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
        let step = 1.0 / f64::from(side - 1);
        let corner =
            move |index: u32| [index / (side - 1), index % (side - 1)].map(|at| f64::from(at) * step);
        (0..(side - 1) * (side - 1)).map(move |index| (corner(index), [step, step]))
    }

    /// A narrow peak of height 1.
    fn peak(x: f64, y: f64) -> f64 {
        1.0 / (1.0 + 60.0 * ((x - 0.31).powi(2) + (y - 0.64).powi(2)))
    }

    #[test]
    fn interpolation_of_a_smooth_measure_errs_as_estimated() {
        let share = 0.01;
        let (mesh, points) = refined(9, 5000, share, peak);
        let error = largest_error(boxes(&mesh), peak);
        let allowed = tolerances(&mesh, share)[0].error;
        assert!(error < 1.2 * allowed, "{error} of {allowed}, with {points} points");
        assert!(error > 0.3 * allowed, "too many points: {points} give {error} of {allowed}");
        // As many points, or half as many again, on a uniform grid.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
        let side = (points as f64 * 1.5).sqrt() as u32;
        let uniform = largest_error(even_boxes(side), peak);
        assert!(uniform > 4.0 * error, "{points} points: {error}; {side} times {side}: {uniform}");
        assert_eq!(mesh.count(&tolerances(&mesh, share))[1], 0);
    }

    #[test]
    fn the_boxes_cover_the_square_once() {
        let (mesh, _) = refined(5, 400, 0.01, peak);
        let area: f64 = boxes(&mesh).map(|(_, [width, height])| width * height).sum();
        assert!((area - 1.0).abs() < 1e-12);
        for cell in &mesh.cells {
            for axis in [0, 1] {
                for low in mesh.edges(cell, axis) {
                    let high = low.moved(axis, low.at[axis] + mesh.length(cell, axis));
                    assert!(mesh.numbers.contains_key(&low) && mesh.numbers.contains_key(&high));
                }
            }
        }
    }

    #[test]
    fn boxes_at_a_jump_are_the_smallest() {
        let jump = |x: f64, y: f64| if x + 0.4 * y > 0.71 { 1.0 } else { 0.0 };
        let (mesh, points) = refined(5, 20_000, 0.01, jump);
        let crossed = |[x, y]: [f64; 2], [width, height]: [f64; 2]| jump(x, y) != jump(x + width, y + height);
        let width: Vec<f64> =
            boxes(&mesh).filter(|(low, sides)| crossed(*low, *sides)).map(|(_, sides)| sides[0]).collect();
        let smallest = 0.25 / f64::from(1 << HALVINGS);
        assert!(width.len() > 256 && width.iter().all(|width| *width == smallest), "{}", width.len());
        // Points are at the line only: a uniform grid with such boxes has 66,049.
        assert!(points < 3000, "{points}");
        let [_, above, open] = mesh.count(&tolerances(&mesh, 0.01));
        assert!(above > 256 && open == 0);
    }

    #[test]
    fn a_limit_of_points_is_kept_and_used() {
        for most in [100, 101, 333] {
            let (mesh, points) = refined(9, most, 1e-4, peak);
            assert!((most - 1..=most).contains(&points), "{points} of {most}");
            assert!(mesh.count(&tolerances(&mesh, 1e-4))[2] > 0);
        }
    }

    #[test]
    fn the_edge_of_a_measure_is_found() {
        // Unknown in a quarter of a disc.
        let known = |x: f64, y: f64| if x.hypot(y) < 0.6 { f64::NAN } else { x };
        let (mesh, _) = refined(5, 20_000, 0.01, known);
        let smallest = 0.25 / f64::from(1 << HALVINGS);
        let mixed = boxes(&mesh).filter(|([x, y], [width, height])| {
            known(*x, *y).is_nan() != known(x + width, y + height).is_nan()
        });
        let mixed: Vec<[f64; 2]> = mixed.map(|(_, sides)| sides).collect();
        // Along an axis whose edges do not cross the circle, a box is not halved.
        assert!(
            mixed.len() > 100 && mixed.iter().all(|sides| sides[0].min(sides[1]) == smallest),
            "{mixed:?}"
        );
    }

    #[test]
    fn listed_values_are_coordinates() {
        let side = Side::Listed(vec![1.0, 3.0, 11.0]);
        let at = |steps| side.coordinate(steps, 64);
        assert_eq!([at(0), at(32), at(64), at(80), at(128)], [1.0, 2.0, 3.0, 5.0, 11.0]);
        assert_eq!(Side::Even(3).coordinate(80, 64), 1.25);
    }
}
