//! Search for the nearest point, for maps whose points form no grid. In such a map, each position has the
//! colour of the nearest point.

/// Returns, for each position of a raster, the index of the nearest point. If several points are equally
/// near, the first of these points counts.
///
/// `points` are in the unit square. The raster positions are the middles of `columns` times `rows` equal
/// cells of the square, row by row from the bottom. The function multiplies horizontal and vertical distances
/// by `weights`. Without points the result is empty.
pub(super) fn nearest(points: &[[f64; 2]], weights: [f64; 2], [columns, rows]: [usize; 2]) -> Vec<usize> {
    if points.is_empty() {
        return Vec::new();
    }
    let buckets = Buckets::new(points, weights);
    let middle = |place: usize, count: usize| (place as f64 + 0.5) / count as f64;
    let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    places.map(|(row, column)| buckets.nearest([middle(column, columns), middle(row, rows)])).collect()
}

/// Points in groups: the unit square is divided into small squares, and each group contains the points in one
/// small square.
struct Buckets<'p> {
    points: &'p [[f64; 2]],
    weights: [f64; 2],
    /// Number of small squares along each side of the unit square.
    side: usize,
    squares: Vec<Vec<usize>>,
}

impl Buckets<'_> {
    fn new(points: &[[f64; 2]], weights: [f64; 2]) -> Buckets<'_> {
        let side = points.len().isqrt().clamp(1, 1024);
        let mut buckets = Buckets { points, weights, side, squares: vec![Vec::new(); side * side] };
        for (index, &point) in points.iter().enumerate() {
            let [x, y] = point.map(|coordinate| buckets.square(coordinate));
            buckets.squares[y * side + x].push(index);
        }
        buckets
    }

    /// Returns the column or row of the small square that contains a coordinate.
    fn square(&self, coordinate: f64) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to small numbers"
        )]
        let square = (coordinate * self.side as f64).clamp(0.0, self.side as f64 - 1.0) as usize;
        square
    }

    fn nearest(&self, place: [f64; 2]) -> usize {
        let [x, y] = place.map(|coordinate| self.square(coordinate));
        let mut best = (f64::INFINITY, 0);
        for ring in 0..=self.side {
            // Every point outside of the earlier rings is at least this far away.
            let far = self.weights[0].min(self.weights[1]) * ring.saturating_sub(1) as f64 / self.side as f64;
            if best.0 < far * far {
                break;
            }
            for square in self.ring([x, y], ring) {
                for &index in &self.squares[square] {
                    let [dx, dy] =
                        [0, 1].map(|side| self.weights[side] * (self.points[index][side] - place[side]));
                    let distance = dx * dx + dy * dy;
                    if (distance, index) < best {
                        best = (distance, index);
                    }
                }
            }
        }
        best.1
    }

    /// Returns the small squares that form a ring around a given square, at a distance of `ring` squares.
    fn ring(&self, [x, y]: [usize; 2], ring: usize) -> impl Iterator<Item = usize> + '_ {
        let span = move |middle: usize| middle.saturating_sub(ring)..=(middle + ring).min(self.side - 1);
        let is_on_ring = move |column: usize, row: usize| column.abs_diff(x).max(row.abs_diff(y)) == ring;
        span(y).flat_map(move |row| {
            span(x).filter(move |&column| is_on_ring(column, row)).map(move |column| row * self.side + column)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_of_all_points_is_found() {
        // Points of a lattice that is fine in one corner only, so that many squares are empty.
        let points: Vec<[f64; 2]> = (0..400_u32)
            .map(|index| [f64::from(index * 37 % 400) / 400.0, f64::from(index * index % 401) / 401.0])
            .map(|[x, y]| [x * x * x, y * y])
            .chain([[1.0, 1.0]])
            .collect();
        let (columns, rows) = (23, 17);
        for weights in [[1.0, 1.0], [3.0, 0.2]] {
            the_nearest_is_found(&points, weights, [columns, rows]);
        }
    }

    fn the_nearest_is_found(points: &[[f64; 2]], weights: [f64; 2], [columns, rows]: [usize; 2]) {
        let found = nearest(points, weights, [columns, rows]);
        assert_eq!(found.len(), columns * rows);
        for (place, found) in found.into_iter().enumerate() {
            let [x, y] = [
                ((place % columns) as f64 + 0.5) / columns as f64,
                ((place / columns) as f64 + 0.5) / rows as f64,
            ];
            let [across, up] = weights.map(|weight| weight * weight);
            let distance =
                |index: usize| across * (points[index][0] - x).powi(2) + up * (points[index][1] - y).powi(2);
            let least = (0..points.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap();
            assert!(distance(found) <= distance(least) * (1.0 + 1e-12), "place {place}");
        }
    }

    #[test]
    fn each_place_has_its_nearest_point() {
        assert_eq!(nearest(&[[0.1, 0.5], [0.9, 0.5]], [1.0, 1.0], [4, 1]), [0, 0, 1, 1]);
    }

    #[test]
    fn without_points_there_are_no_cells() {
        assert!(nearest(&[], [1.0; 2], [3, 3]).is_empty());
        assert_eq!(nearest(&[[0.0, 0.0]], [1.0; 2], [2, 2]), [0; 4]);
    }
}
