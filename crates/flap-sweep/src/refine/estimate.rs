//! Estimates of the error of linear interpolation along an edge of a box.

/// A point on a line: its coordinate and its measure, NaN if unknown.
pub(super) type Sample = (f64, f64);

/// Largest allowed error of a measure, and the range of the measure over all rows, in its unit.
pub(super) struct Tolerance {
    pub(super) error: f64,
    pub(super) range: f64,
}

/// An edge of a box, with the nearest points on its line.
pub(super) struct Edge {
    pub(super) before: Option<Sample>,
    pub(super) ends: [Sample; 2],
    pub(super) after: Option<Sample>,
    /// True if the edge reaches from one value of the axis to the next.
    pub(super) is_whole: bool,
}

impl Edge {
    /// Returns the estimated error of linear interpolation between the ends, relative to the allowed error.
    ///
    /// If the measure is known at one end only, the estimate is half of the range of the measure. If it is unknown at
    /// both ends, there is nothing to interpolate.
    ///
    /// The estimate is that of a parabola through both ends and a neighbour: h² f″/8 at the middle. There are two such
    /// parabolas. Beside a jump or a kink, only one of them contains it, so the smaller estimate counts. Whole edges
    /// take the larger one, because nothing between their ends is known.
    ///
    /// If the measure changes more than twice as much as beside the edge, it may jump: the estimate is half of the
    /// change.
    pub(super) fn error(&self, tolerance: &Tolerance) -> f64 {
        if tolerance.error > 0.0 { self.size(tolerance.range) / tolerance.error } else { 0.0 }
    }

    /// Returns the estimated error in the unit of the measure.
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
        let bend = if self.is_whole { bends.reduce(f64::max) } else { bends.reduce(f64::min) };
        bend.unwrap_or(0.0)
    }
}

/// Returns the axis along which a box is halved, from its `errors` along the axes relative to the allowed error;
/// `None` if it is halved along none.
///
/// Halving leaves a quarter of the error along its axis. The error of a jump stays. A box is therefore also halved
/// along the other axes that a jump crosses: each earlier halving counts as half of the error.
pub(super) fn axis(errors: &[f64], halvings: &[u32], most: u32) -> Option<usize> {
    let share = 1.0 / errors.len() as f64;
    let weight = |axis: usize| errors[axis] * libm::exp2(-f64::from(halvings[axis]));
    let axes = (0..errors.len()).filter(|&axis| halvings[axis] < most && errors[axis] > share);
    axes.reduce(|best, axis| if weight(axis) > weight(best) { axis } else { best })
}
