//! Estimates the error of linear interpolation along an edge of a box between points.

/// A point on a line: the coordinate of the point along the line, and the value of a measure at the point. If
/// the value is unknown, it is NaN.
pub(super) type Sample = (f64, f64);

/// Largest allowed error of a measure, and the range of the measure over all rows, both in the unit of the measure.
pub(super) struct Tolerance {
    pub(super) error: f64,
    pub(super) range: f64,
}

/// If the measure is smooth, the parabolas on the two sides of an edge give two errors, whose ratio is
/// usually at most this number. A larger ratio shows that only one of the two parabolas contains a jump or a
/// kink.
const MOST_APART: f64 = 8.0;

/// An edge of a box, with the nearest point on each side of the edge, on the line through the edge.
pub(super) struct Edge {
    pub(super) before: Option<Sample>,
    pub(super) ends: [Sample; 2],
    pub(super) after: Option<Sample>,
    /// True if the box has not been halved along the edge, so that the edge connects two neighbouring values
    /// of the axis.
    pub(super) is_whole: bool,
}

impl Edge {
    /// Returns the estimated error of linear interpolation between the ends of the edge, divided by the
    /// allowed error.
    ///
    /// If the measure is known at one end of the edge only, the estimated error is half of the range of the
    /// measure. If the measure is unknown at both ends of the edge, the estimated error is zero.
    ///
    /// For a parabola through the edge's ends and a neighbouring point, the interpolation error at the middle
    /// of the edge is h² f″/8. The estimated error is the mean of the errors of two parabolas, one through
    /// the neighbouring point on each side of the edge. If the measure has a jump or a kink beside the edge,
    /// only the parabola on this side contains the jump or kink. In the mean, the larger error therefore
    /// counts as at most [`MOST_APART`] times the smaller error. If the edge connects two neighbouring values
    /// of the axis, no point between these values is known. For such an edge, the estimated error is
    /// therefore the larger of the errors of the two parabolas.
    ///
    /// The function also compares the slope of the measure along the edge with the slopes from the ends of
    /// the edge to the neighbouring points. If the slope along the edge is more than twice the largest of
    /// these slopes, the measure may have a jump. For a possible jump, the estimated error is half of the
    /// change of the measure along the edge.
    pub(super) fn error(&self, tolerance: &Tolerance) -> f64 {
        if tolerance.error > 0.0 { self.size(tolerance.range) / tolerance.error } else { 0.0 }
    }

    /// Returns the estimated error of linear interpolation in the unit of the measure.
    fn size(&self, range: f64) -> f64 {
        let [(low, first), (high, last)] = self.ends;
        match (first.is_finite(), last.is_finite()) {
            (false, false) => return 0.0,
            (true, true) => {}
            _ => return 0.5 * range,
        }
        let length = high - low;
        let change = last - first;
        let slope = change / length;
        let known = |sample: &Option<Sample>| sample.filter(|(_, measure)| measure.is_finite());
        let before = known(&self.before).map(|(at, measure)| ((first - measure) / (low - at), low - at));
        let after = known(&self.after).map(|(at, measure)| ((measure - last) / (at - high), at - high));
        let beside = before.into_iter().chain(after);
        let steepest = beside.clone().map(|(slope, _)| (slope * length).abs()).reduce(f64::max);
        let Some(steepest) = steepest else {
            // Two values, and nothing beside them.
            return 0.25 * change.abs();
        };
        if change.abs() > 2.0 * steepest {
            return 0.5 * change.abs();
        }
        let bends = beside
            .map(|(other, distance)| ((slope - other) * length * length / (4.0 * (length + distance))).abs());
        let ends = bends.clone().reduce(f64::min).zip(bends.reduce(f64::max));
        let bend =
            ends.map(
                |(smaller, larger)| {
                    if self.is_whole { larger } else { 0.5 * (smaller + larger.min(MOST_APART * smaller)) }
                },
            );
        bend.unwrap_or(0.0)
    }
}

/// Returns the axis along which a box should be halved, or `None` if the box should not be halved. `errors`
/// contains the estimated error along each axis, divided by the allowed error.
///
/// If a measure is smooth, halving a box reduces the error along the halved axis to a quarter. If the measure
/// has a jump, halving does not reduce the error. The error along an axis is therefore divided by two for
/// each earlier halving of the box along this axis. With this division, a box at a jump is halved along all
/// axes and not only along one axis.
pub(super) fn axis(errors: &[f64], halvings: &[u32], most: u32) -> Option<usize> {
    let share = 1.0 / errors.len() as f64;
    let weight = |axis: usize| errors[axis] * libm::exp2(-f64::from(halvings[axis]));
    let axes = (0..errors.len()).filter(|&axis| halvings[axis] < most && errors[axis] > share);
    axes.reduce(|best, axis| if weight(axis) > weight(best) { axis } else { best })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(before: Option<Sample>, ends: [Sample; 2], after: Option<Sample>, is_whole: bool) -> f64 {
        Edge { before, ends, after, is_whole }.size(10.0)
    }

    #[test]
    fn the_error_of_a_parabola_is_exact() {
        // Between 4 and 6 the chord of x² is 1 above it in the middle, at any distance of the neighbours.
        let square = |x: f64| (x, x * x);
        for (before, after) in [(3.5, 9.0), (1.0, 6.25)] {
            let (before, after) = (Some(square(before)), Some(square(after)));
            for (before, after) in [(before, after), (before, None), (None, after)] {
                assert!((size(before, [square(4.0), square(6.0)], after, false) - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn beside_a_kink_only_whole_edges_are_in_doubt() {
        let bend = |x: f64| (x, x.abs());
        let edge = |is_whole| size(Some(bend(-1.0)), [bend(0.0), bend(1.0)], Some(bend(2.0)), is_whole);
        // The slopes -1 and 1 give a parabola with h² f″ / 8 = 2 / 8.
        assert_eq!((edge(false), edge(true)), (0.0, 0.25));
        // Slopes of 0, 1 and 3 give parabolas with 1 / 8 and 2 / 8.
        let uneven = size(Some((-1.0, 0.0)), [(0.0, 0.0), (1.0, 1.0)], Some((2.0, 4.0)), false);
        assert_eq!(uneven, 0.1875);
        // Of 0.01 / 8 and 3.01 / 8, the second counts 8 times the first at most.
        let kink = size(Some((-1.0, -1.0)), [(0.0, 0.0), (1.0, 1.01)], Some((2.0, 5.03)), false);
        assert!((kink - 4.5 * 0.01 / 8.0).abs() < 1e-12);
    }

    #[test]
    fn a_jump_errs_by_half_of_its_height() {
        let flat = |x: f64, height: f64| (x, height);
        let jump = [flat(0.0, 1.0), flat(1.0, 5.0)];
        assert_eq!(size(Some(flat(-1.0, 1.0)), jump, Some(flat(2.0, 5.5)), false), 2.0);
        assert_eq!(size(Some(flat(-1.0, f64::NAN)), jump, Some(flat(2.0, 5.5)), false), 2.0);
        // Beside the jump nothing changes.
        let beside = [flat(1.0, 5.0), flat(2.0, 5.0)];
        assert_eq!(size(Some(flat(0.0, 1.0)), beside, Some(flat(3.0, 5.0)), false), 0.0);
        // Two values alone.
        assert_eq!(size(None, jump, None, true), 1.0);
    }

    #[test]
    fn where_a_measure_ends_half_of_its_range_is_in_doubt() {
        assert_eq!(size(None, [(0.0, 1.0), (1.0, f64::NAN)], None, true), 5.0);
        assert_eq!(size(Some((-1.0, 2.0)), [(0.0, f64::NAN), (1.0, f64::NAN)], None, true), 0.0);
        let edge = Edge { before: None, ends: [(0.0, 1.0), (1.0, f64::NAN)], after: None, is_whole: true };
        assert_eq!(edge.error(&Tolerance { error: 0.1, range: 10.0 }), 50.0);
        assert_eq!(edge.error(&Tolerance { error: 0.0, range: 0.0 }), 0.0);
    }

    #[test]
    fn boxes_are_halved_along_the_axis_of_the_largest_error() {
        assert_eq!(axis(&[3.0, 2.0], &[0, 0], 6), Some(0));
        // A jump that crosses both axes: they take turns.
        assert_eq!(axis(&[3.0, 2.9], &[1, 0], 6), Some(1));
        // An axis is left out if it is halved often enough, or its error does not matter.
        assert_eq!(axis(&[3.0, 0.6], &[6, 0], 6), Some(1));
        assert_eq!(axis(&[3.0, 0.4], &[6, 0], 6), None);
    }
}
