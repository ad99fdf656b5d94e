//! Computes statistics of a sample: percentiles, bars of a histogram, and rank correlations.

/// Percentiles, in percent, that are marked in pictures of a histogram.
pub const MARKED: [u32; 3] = [5, 50, 95];

/// Returns a percentile of the ascending `values`, by linear interpolation. `share` is the fraction of the
/// values below the percentile, from 0 to 1. Returns NaN if there are no values.
pub fn percentile(values: &[f64], share: f64) -> f64 {
    let Some(last) = values.len().checked_sub(1) else { return f64::NAN };
    let place = share * last as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the last place")]
    let below = place.floor() as usize;
    let part = place - below as f64;
    // Zero times an infinite difference would be NaN.
    if part == 0.0 {
        return values[below];
    }
    let (low, high) = (values[below], values[below + 1]);
    let difference = high - low;
    if difference.is_finite() { low + part * difference } else { low * (1.0 - part) + high * part }
}

/// A histogram of a sample, with percentiles of the sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Edges of the bars, from the smallest to the largest value. All bars have the same width.
    pub edges: Vec<f64>,
    /// Number of values in each bar.
    pub counts: Vec<usize>,
    /// Percentiles of the values, for the percentages in [`MARKED`].
    pub marked: [f64; 3],
}

/// Returns the histogram of the finite `values`; `None` if no value is finite.
///
/// The width of the bars is twice the interquartile range, divided by the cube root of the number of values
/// (rule of Freedman and Diaconis). The histogram has at least 5 and at most 60 bars.
pub fn histogram(values: &[f64]) -> Option<Histogram> {
    const FEWEST: f64 = 5.0;
    const MOST: f64 = 60.0;
    let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let (&low, &high) = (sorted.first()?, sorted.last()?);
    // The range exceeds the largest float. Scaled values have the same bars.
    if !(high - low).is_finite() {
        const SMALLER: f64 = 256.0;
        let smaller: Vec<f64> = sorted.iter().map(|value| value / SMALLER).collect();
        let Histogram { edges, counts, marked } = histogram(&smaller)?;
        let edges = edges.into_iter().map(|edge| SMALLER * edge).collect();
        return Some(Histogram { edges, counts, marked: marked.map(|value| SMALLER * value) });
    }
    let marked = MARKED.map(|percent| percentile(&sorted, f64::from(percent) / 100.0));
    // Values that are equal to rounding share one bar.
    if high - low <= 1e-12 * high.abs().max(low.abs()) {
        let half = if low == 0.0 { 0.5 } else { 0.05 * low.abs() };
        return Some(Histogram { edges: vec![low - half, high + half], counts: vec![sorted.len()], marked });
    }
    let middle_half = percentile(&sorted, 0.75) - percentile(&sorted, 0.25);
    let width = 2.0 * middle_half / (sorted.len() as f64).cbrt();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 5 to 60")]
    let bars = ((high - low) / width).ceil().clamp(FEWEST, MOST) as usize;
    let mut counts = vec![0; bars];
    for value in &sorted {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to bars")]
        let bar = ((value - low) / (high - low) * bars as f64) as usize;
        // The largest value belongs to the last bar.
        counts[bar.min(bars - 1)] += 1;
    }
    let edges = (0..=bars).map(|i| low + (high - low) * i as f64 / bars as f64).collect();
    Some(Histogram { edges, counts, marked })
}

/// Returns Spearman's rank correlation of two columns, from -1 to 1, over rows in which both values are finite.
///
/// All equal values get the mean of their ranks. Returns NaN if fewer than three rows have two finite values,
/// or if a column is constant in these rows.
pub fn rank_correlation(x: &[f64], y: &[f64]) -> f64 {
    let (x, y): (Vec<f64>, Vec<f64>) =
        x.iter().zip(y).filter(|(x, y)| x.is_finite() && y.is_finite()).map(|(x, y)| (*x, *y)).unzip();
    if x.len() < 3 {
        return f64::NAN;
    }
    let middle = (x.len() - 1) as f64 / 2.0;
    let (x, y) = (ranks(&x), ranks(&y));
    let product =
        |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - middle) * (b - middle)).sum() };
    let size = (product(&x, &x) * product(&y, &y)).sqrt();
    if size == 0.0 { f64::NAN } else { (product(&x, &y) / size).clamp(-1.0, 1.0) }
}

/// Returns the rank of each value, counted from 0. All equal values get the mean of their ranks.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut first = 0;
    for same in order.chunk_by(|&a, &b| values[a] == values[b]) {
        let mean = first as f64 + (same.len() - 1) as f64 / 2.0;
        for &place in same {
            ranks[place] = mean;
        }
        first += same.len();
    }
    ranks
}

/// Returns the rank correlation of each parameter with a measure, together with the index of the parameter.
/// The correlation with the largest magnitude is the first.
///
/// The result leaves out parameters whose correlation is not defined. If the rank correlation of two
/// parameters is 1 or -1, the result contains only the first of the two parameters.
pub fn correlations(parameters: &[&[f64]], measure: &[f64]) -> Vec<(usize, f64)> {
    const SAME: f64 = 1.0 - 1e-9;
    let mut found: Vec<(usize, f64)> = Vec::new();
    for (place, column) in parameters.iter().enumerate() {
        let size = rank_correlation(column, measure);
        let follows =
            |&(earlier, _): &(usize, f64)| rank_correlation(column, parameters[earlier]).abs() > SAME;
        if size.is_finite() && !found.iter().any(follows) {
            found.push((place, size));
        }
    }
    found.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_interpolated() {
        assert_eq!(percentile(&[1.0, 2.0, 3.0, 4.0], 0.5), 2.5);
        assert_eq!(percentile(&[1.0, 2.0, 4.0], 0.5), 2.0);
        assert_eq!(percentile(&[0.0, 1.0, f64::INFINITY], 0.5), 1.0);
        assert_eq!(percentile(&[7.0], 0.95), 7.0);
        assert!(percentile(&[], 0.5).is_nan());
        let hundred: Vec<f64> = (0..=100).map(f64::from).collect();
        assert_eq!([0.05, 0.95, 1.0].map(|share| percentile(&hundred, share)), [5.0, 95.0, 100.0]);
    }

    #[test]
    fn bars_hold_all_values() {
        let values: Vec<f64> = (0..=1000).map(|i| (f64::from(i) * 0.37).sin()).chain([f64::NAN]).collect();
        let Histogram { edges, counts, marked } = histogram(&values).unwrap();
        assert_eq!(counts.iter().sum::<usize>(), 1001);
        assert_eq!(edges.len(), counts.len() + 1);
        assert!((5..=60).contains(&counts.len()), "{counts:?}");
        assert!(edges.is_sorted() && marked.is_sorted());
        for (bar, count) in counts.iter().enumerate() {
            let is_in = |value: &&f64| **value >= edges[bar] && **value < edges[bar + 1];
            let within = values.iter().filter(is_in).count();
            assert!(within.abs_diff(*count) <= 1, "bar {bar}: {within} and {count}");
        }
    }

    #[test]
    fn one_value_is_one_bar() {
        let found = histogram(&[2.0, 2.0, f64::NAN]).unwrap();
        assert_eq!(found, Histogram { edges: vec![1.9, 2.1], counts: vec![2], marked: [2.0; 3] });
        assert_eq!(histogram(&[f64::NAN]), None);
        // Most values are equal, so the interquartile range is zero.
        assert_eq!(histogram(&[0.0, 1.0, 1.0, 1.0, 1.0]).unwrap().counts.len(), 60);
    }

    #[test]
    fn a_range_beyond_the_largest_float_has_bars() {
        let most = 1.7e308;
        let found = histogram(&[-most, -most / 2.0, 0.0, 0.5, most / 2.0, most]).unwrap();
        assert_eq!(found.counts.iter().sum::<usize>(), 6);
        assert_eq!((found.edges[0], found.edges[found.edges.len() - 1]), (-most, most));
        assert!(found.edges.iter().all(|edge| edge.is_finite()) && found.edges.is_sorted());
        assert_eq!(found.marked[1], 0.25);
        assert!(found.marked.iter().all(|value| value.is_finite()) && found.marked.is_sorted());
        let three_quarters = percentile(&[-most, most], 0.75);
        assert!((three_quarters / (most / 2.0) - 1.0).abs() < 1e-15, "{three_quarters}");
    }

    /// Spearman (1904): without ties, the rank correlation is 1 - 6 sum d² / (n (n² - 1)).
    #[test]
    fn rank_correlations_are_spearmans() {
        // Ranks 1 to 5 against 2, 1, 4, 3, 5: the sum of d² is 4.
        let found = rank_correlation(&[1.0, 2.0, 3.0, 4.0, 5.0], &[20.0, 10.0, 1e3, 30.0, 1e9]);
        assert!((found - (1.0 - 6.0 * 4.0 / 120.0)).abs() < 1e-12, "{found}");
        // Ties: the value of scipy.stats.spearmanr([1, 2, 2, 3], [1, 3, 2, 4]).
        let found = rank_correlation(&[1.0, 2.0, 2.0, 3.0], &[1.0, 3.0, 2.0, 4.0]);
        assert!((found - 0.948_683_298_050_513_8).abs() < 1e-12, "{found}");
        assert_eq!(rank_correlation(&[1.0, 2.0, 3.0], &[3.0, 2.0, 1.0]), -1.0);
        assert!(rank_correlation(&[1.0, 2.0, f64::NAN], &[3.0, 2.0, 1.0]).is_nan());
        assert!(rank_correlation(&[1.0, 1.0, 1.0], &[3.0, 2.0, 1.0]).is_nan());
    }

    #[test]
    fn parameters_that_follow_others_are_left_out() {
        let a = [0.3, 0.1, 0.9, 0.7, 0.2];
        let twice = a.map(|value| 2.0 * value);
        let less = a.map(|value| -value);
        let b = [0.6, 0.5, 0.25, 0.1, 0.8];
        let found = correlations(&[&b, &a, &twice, &less, &[1.0; 5]], &a.map(f64::exp));
        assert_eq!((found[0], found[1].0, found.len()), ((1, 1.0), 0, 2));
    }
}
