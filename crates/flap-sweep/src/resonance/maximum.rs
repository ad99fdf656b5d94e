//! The largest value of a function of one variable, asked for one value at a time.

/// Share of the larger part of an interval in which a golden-section step goes.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// The search for a maximum between two bounds: steps to the top of the parabola through the three best points while those
/// shrink fast enough, golden sections otherwise (R. P. Brent, Algorithms for Minimization without Derivatives, 1973,
/// chapter 5). Values may be minus infinity where there are none.
#[derive(Clone, Debug)]
pub(super) struct Maximum {
    bounds: [f64; 2],
    /// The best point, the second best, and the one before: place and value.
    best: [[f64; 2]; 3],
    /// The latest step, and the one before it.
    steps: [f64; 2],
    tolerance: f64,
}

impl Maximum {
    /// A search from three points `[place, value]` by rising place, the one in the middle the highest. At an end of the
    /// range it is one of the others.
    pub(super) fn new(points: [[f64; 2]; 3], tolerance: f64) -> Maximum {
        let [low, top, high] = points;
        let [second, third] = if low[1] > high[1] { [low, high] } else { [high, low] };
        let width = high[0] - low[0];
        let bounds = [low[0], high[0]];
        Maximum { bounds, best: [top, second, third], steps: [width; 2], tolerance: tolerance / 3.0 }
    }

    /// The best point so far: place and value.
    pub(super) fn best(&self) -> [f64; 2] {
        self.best[0]
    }

    /// The place at which the function is to be evaluated next; `None` if the best point is within the tolerance of the
    /// maximum.
    pub(super) fn next(&mut self) -> Option<f64> {
        let [a, b] = self.bounds;
        let x = self.best[0][0];
        let middle = 0.5 * (a + b);
        // No finer than doubles can tell apart.
        let tolerance = self.tolerance + 1e-12 * x.abs();
        if (x - middle).abs() <= 2.0 * tolerance - 0.5 * (b - a) {
            return None;
        }
        let step = if let Some(step) = self.to_the_parabolas_top() {
            let u = x + step;
            let near_a_bound = u - a < 2.0 * tolerance || b - u < 2.0 * tolerance;
            if near_a_bound { tolerance.copysign(middle - x) } else { step }
        } else {
            let larger = if x < middle { b - x } else { a - x };
            self.steps[0] = larger;
            GOLDEN * larger
        };
        self.steps = [step, self.steps[0]];
        Some(if step.abs() >= tolerance { x + step } else { x + tolerance.copysign(step) })
    }

    /// The step to the top of the parabola through the three best points, if it can be trusted.
    fn to_the_parabolas_top(&self) -> Option<f64> {
        let [[x, fx], [w, fw], [v, fv]] = self.best;
        let r = (x - w) * (fx - fv);
        let q = (x - v) * (fx - fw);
        let step = ((x - w) * r - (x - v) * q) / (2.0 * (q - r));
        let inside = x + step > self.bounds[0] && x + step < self.bounds[1];
        // Steps that do not shrink to half every second time are no sign of a parabola. NaN fails both.
        (inside && step.abs() < 0.5 * self.steps[1].abs()).then_some(step)
    }

    /// Takes the value at the place that [`Maximum::next`] asked for.
    pub(super) fn take(&mut self, place: f64, value: f64) {
        let [x, w, v] = self.best;
        let tried = [place, value];
        if value >= x[1] {
            self.bounds[usize::from(place < x[0])] = x[0];
            self.best = [tried, x, w];
        } else {
            self.bounds[usize::from(place > x[0])] = place;
            if value >= w[1] || w[0] == x[0] {
                self.best = [x, tried, w];
            } else if value >= v[1] || v[0] == x[0] || v[0] == w[0] {
                self.best = [x, w, tried];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The place found and how many values that took, from points at the ends and at `top`.
    fn search(f: impl Fn(f64) -> f64, places: [f64; 3], tolerance: f64) -> (f64, u32) {
        let mut maximum = Maximum::new(places.map(|place| [place, f(place)]), tolerance);
        let mut values = 0;
        while let Some(place) = maximum.next() {
            assert!(place >= places[0] && place <= places[2], "{place}");
            maximum.take(place, f(place));
            values += 1;
            assert!(values < 100);
        }
        (maximum.best()[0], values)
    }

    #[test]
    fn a_resonance_curve_takes_few_values() {
        for peak in [118.3, 119.0, 120.5, 121.7] {
            let f = |x: f64| 1.0 / (1.0 + ((x - peak) / 4.0).powi(2)).sqrt();
            let (place, values) = search(f, [118.0, 120.0, 122.0], 0.05);
            assert!((place - peak).abs() < 0.05, "{place} for {peak}");
            assert!(values <= 9, "{values} for {peak}");
        }
    }

    #[test]
    fn a_cusp_is_found_too() {
        let (place, values) = search(|x| -(x - 1.234).abs(), [0.0, 1.0, 2.0], 1e-3);
        assert!((place - 1.234).abs() < 1e-3 && values < 40, "{place} {values}");
    }

    #[test]
    fn a_cliff_is_approached_from_where_there_are_values() {
        let f = |x: f64| if x > 1.5 { f64::NEG_INFINITY } else { x };
        let (place, _) = search(f, [0.0, 1.0, 2.0], 1e-3);
        assert!((place - 1.5).abs() < 2e-3 && place <= 1.5, "{place}");
    }

    #[test]
    fn a_maximum_at_the_end_of_the_range_is_left_there() {
        let (place, _) = search(|x| -x, [1.0, 1.0, 2.0], 1e-3);
        assert!(place < 1.0 + 1e-3);
        let (place, _) = search(|x| x, [1.0, 2.0, 2.0], 1e-3);
        assert!(place > 2.0 - 1e-3);
        let (place, _) = search(|x| -(x - 1.3).powi(2), [1.0, 1.0, 2.0], 1e-3);
        assert!((place - 1.3).abs() < 1e-3, "the end of the range was highest, but not a maximum");
    }
}
