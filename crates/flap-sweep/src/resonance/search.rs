//! Searches for the resonance of one design.
//!
//! First, the search runs points on a grid of frequencies, from which it selects the highest peaks. Then
//! [`Maximum`] locates the selected peaks accurately. In this second step, each motion begins on the known
//! orbit with the nearest frequency. A motion that begins on a known orbit settles in about half the time of
//! a motion from rest.
//!
//! The row at a resonance describes the motion that begins at rest, like every row of a sweep. If this motion
//! differs from the motion that the search found at the same frequency, the design has more than one orbit.
//! For a design with more than one orbit, the peaks are located again, and in this second search all motions
//! begin at rest.

use flap_core::parameter::Invalid;
use flap_core::simulate::{Point, Row, Status, Unfinished};

use super::sequence::{Exchange, Sequence};
use super::target::Target;

/// Relative distance between neighbouring frequencies of the grid. For comparison, a peak with the quality
/// factor Q has a relative width of 1/Q.
const SPACING: f64 = 0.02;

/// Smallest and largest number of intervals in the grid of frequencies.
const INTERVALS: [f64; 2] = [8.0, 500.0];

/// Largest number of peaks that the search locates accurately.
const MOST_TOPS: usize = 4;

/// Selection of the peaks that are located accurately, and of the peaks whose points are computed again from
/// rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peaks {
    /// A peak is located accurately if its estimated height is below the height of the highest peak by at
    /// most this fraction.
    contender: f64,
    /// Number of the highest peaks whose points are computed again from rest.
    from_rest: usize,
}

impl Peaks {
    /// Locates the highest peak on the grid of frequencies. Also locates each lower peak that may exceed the
    /// highest peak between two frequencies of the grid.
    pub(super) const HIGHEST: Peaks = Peaks { contender: 0.15, from_rest: 1 };

    /// Locates all peaks, but at most [`MOST_TOPS`] peaks.
    pub(super) const ALL: Peaks = Peaks { contender: 1.0, from_rest: MOST_TOPS };
}

/// Rows report the second peak if it is lower than the highest peak by at most this fraction.
const SECOND: f64 = 0.05;

/// If two computed values differ by at most this fraction, they count as values of the same orbit.
const SAME: f64 = 1e-3;

/// Search for the resonance of one design.
pub(super) struct Search<'a> {
    target: &'a Target,
    point: Point,
    peaks: Peaks,
    /// Lowest and highest frequency of the search (Hz), or the reason why a search is impossible.
    ends: Result<[f64; 2], Unfinished>,
    /// All points that the search has computed.
    seen: Vec<Seen>,
    cycles: u32,
    rhs_evals: u64,
    /// The located peaks, each as `[frequency, value]`, beginning with the highest peak.
    tops: Vec<[f64; 2]>,
    /// Rows of the peaks, computed from motions that begin at rest. If there is no peak, the list contains
    /// one row that shows the reason.
    rows: Vec<Row>,
}

/// A point that the search has computed.
pub(super) struct Seen {
    pub(super) frequency: f64,
    /// Value of the quantity to maximise, or minus infinity if the motion is not periodic.
    value: f64,
    /// A state on the orbit of the point, or `None` if the motion is not periodic.
    state: Option<Vec<f64>>,
    pub(super) status: Status,
}

/// Result of a search for peaks.
pub(super) struct Found {
    /// Lowest and highest frequency of the searched range (Hz).
    pub(super) ends: [f64; 2],
    /// Peaks as `[frequency, value]`, each with the row of the motion that begins at rest.
    pub(super) peaks: Vec<([f64; 2], Row)>,
}

impl<'a> Search<'a> {
    /// Returns a search for the peaks of one design. `point` contains the parameter values of the design. The
    /// drive frequency in `point` is ignored.
    pub(super) fn new(target: &'a Target, point: Point, peaks: Peaks) -> Search<'a> {
        let ends = target.ends(&point.values);
        Search {
            target,
            point,
            peaks,
            ends,
            seen: Vec::new(),
            cycles: 0,
            rhs_evals: 0,
            tops: Vec::new(),
            rows: Vec::new(),
        }
    }

    /// Returns the search as a computation that waits for the rows of its points.
    pub(super) fn sequence(self) -> Sequence<'a, Search<'a>> {
        Sequence::new(|exchange| async move { self.run(&exchange).await })
    }

    /// After the end of the search, returns the index and the row of the design.
    pub(super) fn into_row(mut self) -> (u64, Row) {
        let index = self.point.index;
        let mut row = match &self.ends {
            Err(error) => Row::invalid(error),
            Ok(_) => self.rows.swap_remove(0),
        };
        if let (Ok([from, to]), Status::Periodic) = (&self.ends, row.status)
            && let Some(&[frequency, best]) = self.tops.first()
        {
            let second = self.tops[1..].iter().find(|top| best - top[1] <= SECOND * best.abs());
            let margin = (frequency - from).min(to - frequency);
            let gaps = self.seen.iter().filter(|seen| seen.state.is_none()).count();
            row.measures.extend([
                frequency,
                second.map_or(f64::NAN, |top| top[0]),
                if margin <= self.target.range.tolerance { 0.0 } else { margin },
                self.seen.len() as f64,
                gaps as f64,
            ]);
        }
        row.cycles = self.cycles;
        row.rhs_evals = self.rhs_evals;
        (index, row)
    }

    /// After the end of the search, returns the peaks and all computed points.
    ///
    /// # Errors
    /// Returns an error if the design is impossible, or has no range of frequencies to search. Also returns
    /// an error if the quantity to maximise is undefined at all frequencies.
    pub(super) fn into_peaks(self) -> Result<(Found, Vec<Seen>), Unfinished> {
        let ends = self.ends?;
        if self.tops.is_empty()
            && let Some(reason) = self.rows.iter().find_map(|row| row.reason.clone())
        {
            return Err(Invalid::new(reason).into());
        }
        let peaks = self.tops.into_iter().zip(self.rows).collect();
        Ok((Found { ends, peaks }, self.seen))
    }

    fn point_at(&self, frequency: f64, begin: Option<Vec<f64>>) -> Point {
        let mut values = self.point.values.clone();
        values[self.target.frequency] = frequency;
        Point { begin, ..Point::at_rest(0, values) }
    }

    /// Returns a state on the known orbit whose frequency is nearest to `frequency`.
    fn nearest_state(&self, frequency: f64) -> Option<Vec<f64>> {
        let distance = |seen: &&Seen| (seen.frequency - frequency).abs();
        let known = self.seen.iter().filter(|seen| seen.state.is_some());
        known.min_by(|a, b| distance(a).total_cmp(&distance(b))).and_then(|seen| seen.state.clone())
    }

    fn note(&mut self, frequency: f64, row: &Row) {
        let value = row.measures.get(self.target.objective).copied().filter(|value| value.is_finite());
        let state = (row.status == Status::Periodic).then(|| row.state.clone());
        let value = value.unwrap_or(f64::NEG_INFINITY);
        self.seen.push(Seen { frequency, value, state, status: row.status });
        self.cycles = self.cycles.saturating_add(row.cycles);
        self.rhs_evals += row.rhs_evals;
    }

    /// Returns the highest peaks among the points of the grid. The first `grid` points in `seen` are the
    /// points of the grid.
    fn tops(&self, grid: usize) -> Vec<Maximum> {
        let grid: Vec<[f64; 2]> = self.seen[..grid].iter().map(|seen| [seen.frequency, seen.value]).collect();
        let mut tops: Vec<(f64, [[f64; 2]; 3])> = Vec::new();
        for (i, &here) in grid.iter().enumerate() {
            let before = if i > 0 { grid[i - 1] } else { here };
            let after = *grid.get(i + 1).unwrap_or(&here);
            let rises = i == 0 || before[1] < here[1];
            if here[1].is_finite() && rises && here[1] >= after[1] {
                let points = [before, here, after];
                tops.push((summit(&points), points));
            }
        }
        tops.sort_by(|a, b| b.0.total_cmp(&a.0));
        let least = tops.first().map_or(0.0, |(highest, _)| highest - self.peaks.contender * highest.abs());
        tops.retain(|(height, _)| *height >= least);
        tops.truncate(MOST_TOPS);
        tops.into_iter().map(|(_, points)| Maximum::new(points, self.target.range.tolerance)).collect()
    }

    /// Runs the whole search for one design.
    async fn run(mut self, exchange: &Exchange) -> Search<'a> {
        let Ok(ends) = self.ends else { return self };
        let grid = grid(ends);
        let rows = self.rows(exchange, &grid, true).await;
        if self.tops(grid.len()).is_empty() {
            // The row has the status of a motion that is not periodic.
            let row = rows.into_iter().find(|row| row.status != Status::Periodic);
            self.rows = vec![row.unwrap_or_else(|| {
                Row::invalid(
                    "the quantity whose peak is the resonance is undefined at all frequencies from `from` to `to`",
                )
            })];
            return self;
        }
        let mut from_rest = false;
        loop {
            let mut tops = self.locate(exchange, grid.len(), from_rest).await;
            let frequencies: Vec<f64> = tops.iter().take(self.peaks.from_rest).map(|top| top[0]).collect();
            self.rows = self.rows(exchange, &frequencies, true).await;
            let answers = self.latest(&frequencies);
            let is_same =
                |(top, found): (&[f64; 2], &Seen)| (found.value - top[1]).abs() <= SAME * top[1].abs();
            if from_rest || tops.iter().zip(answers).all(is_same) {
                for (top, found) in tops.iter_mut().zip(answers) {
                    top[1] = found.value;
                }
                self.tops = tops;
                return self;
            }
            from_rest = true;
        }
    }

    /// Locates the peaks of the grid accurately. Returns `[frequency, value]` of each peak, beginning with
    /// the highest peak.
    async fn locate(&mut self, exchange: &Exchange, grid: usize, from_rest: bool) -> Vec<[f64; 2]> {
        let mut tops = self.tops(grid);
        loop {
            let asking = tops.iter_mut().filter_map(|top| top.next().map(|frequency| (top, frequency)));
            let (asking, frequencies): (Vec<&mut Maximum>, Vec<f64>) = asking.unzip();
            if asking.is_empty() {
                break;
            }
            self.rows(exchange, &frequencies, from_rest).await;
            for (top, answer) in asking.into_iter().zip(self.latest(&frequencies)) {
                top.take(answer.frequency, answer.value);
            }
        }
        let mut tops: Vec<[f64; 2]> = tops.iter().map(Maximum::best).collect();
        tops.sort_by(|a, b| b[1].total_cmp(&a[1]));
        tops
    }

    /// Runs points at the given frequencies and returns their rows. If `from_rest` is true, the motions begin
    /// at rest. Otherwise, each motion begins on the known orbit with the nearest frequency.
    async fn rows(&mut self, exchange: &Exchange, frequencies: &[f64], from_rest: bool) -> Vec<Row> {
        let begin = |frequency| if from_rest { None } else { self.nearest_state(frequency) };
        let points = frequencies.iter().map(|&frequency| self.point_at(frequency, begin(frequency)));
        let rows = exchange.rows(points.collect()).await;
        for (&frequency, row) in frequencies.iter().zip(&rows) {
            self.note(frequency, row);
        }
        rows
    }

    /// Returns the points that the search has computed last, one for each of the given frequencies.
    fn latest(&self, frequencies: &[f64]) -> &[Seen] {
        &self.seen[self.seen.len() - frequencies.len()..]
    }
}

/// Returns a grid of frequencies (Hz) from `from` to `to`, with a constant ratio between neighbouring
/// frequencies.
fn grid([from, to]: [f64; 2]) -> Vec<f64> {
    let span = libm::log(to / from);
    let intervals = (span / SPACING).ceil().clamp(INTERVALS[0], INTERVALS[1]);
    let frequency = |i: u32| from * libm::exp(span * (f64::from(i) / intervals));
    let inner = (1..).take_while(|&i| f64::from(i) < intervals).map(frequency);
    std::iter::once(from).chain(inner).chain([to]).collect()
}

/// Returns the largest value of the parabola through three points, or the middle value if the parabola has no
/// maximum.
fn summit(points: &[[f64; 2]; 3]) -> f64 {
    let [[x0, y0], [x1, y1], [x2, y2]] = *points;
    let (left, right) = ((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1));
    let bend = (right - left) / (x2 - x0);
    let slope = left + bend * (x1 - x0);
    let height = y1 - slope * slope / (4.0 * bend);
    if height.is_finite() { height.max(y1) } else { y1 }
}

/// Length of a golden-section step, as a fraction of the larger part of an interval.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Search for a maximum between two bounds.
///
/// A step goes to the vertex of the parabola through the three best points, as long as the steps shrink fast
/// enough. All other steps are golden-section steps (Brent, Algorithms for Minimization without Derivatives,
/// 1973, chapter 5). If the value at a position cannot be computed, it counts as minus infinity.
#[derive(Clone, Debug)]
pub(super) struct Maximum {
    bounds: [f64; 2],
    /// The position and the value of the best, the second best and the third best point.
    best: [[f64; 2]; 3],
    /// The latest step of the search, and the step before the latest step.
    steps: [f64; 2],
    tolerance: f64,
}

impl Maximum {
    /// Returns a search that begins with three points `[position, value]`, in ascending order of the
    /// positions. The middle point has the highest value.
    ///
    /// At an end of the search range, the middle point is equal to the first or the last of the three points.
    pub(super) fn new(points: [[f64; 2]; 3], tolerance: f64) -> Maximum {
        let [low, top, high] = points;
        let [second, third] = if low[1] > high[1] { [low, high] } else { [high, low] };
        let width = high[0] - low[0];
        let bounds = [low[0], high[0]];
        Maximum { bounds, best: [top, second, third], steps: [width; 2], tolerance: tolerance / 3.0 }
    }

    /// Returns the position and the value of the best point so far.
    pub(super) fn best(&self) -> [f64; 2] {
        self.best[0]
    }

    /// Returns the next position to evaluate, or `None` if the best point is within the tolerance of the
    /// maximum.
    pub(super) fn next(&mut self) -> Option<f64> {
        let [a, b] = self.bounds;
        let x = self.best[0][0];
        let middle = 0.5 * (a + b);
        // Limited by the resolution of doubles.
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

    /// Returns the step to the vertex of the parabola through the three best points, if the step is reliable.
    fn to_the_parabolas_top(&self) -> Option<f64> {
        let [[x, fx], [w, fw], [v, fv]] = self.best;
        let r = (x - w) * (fx - fv);
        let q = (x - v) * (fx - fw);
        let step = ((x - w) * r - (x - v) * q) / (2.0 * (q - r));
        let inside = x + step > self.bounds[0] && x + step < self.bounds[1];
        // If steps do not halve at least every second time, the parabola is no good approximation. NaN fails both
        // tests.
        (inside && step.abs() < 0.5 * self.steps[1].abs()).then_some(step)
    }

    /// Receives the value at the position that [`Maximum::next`] returned.
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

    /// Returns the position of the maximum and the number of evaluations. The search begins with the three
    /// positions `places`.
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
