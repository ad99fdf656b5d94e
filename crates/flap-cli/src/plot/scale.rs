//! Ranges and ticks of axes, and the thinning of lines with many points.

/// Returns the smallest and the largest finite number, or `None` if no number is finite.
pub(super) fn range(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let finite = values.into_iter().filter(|value| value.is_finite());
    finite.fold(None, |range, value| {
        let (low, high) = range.unwrap_or((value, value));
        Some((value.min(low), value.max(high)))
    })
}

/// Returns the ranges of the x- and y-coordinates of points. The result is `None` if no x-coordinate or no
/// y-coordinate is finite.
pub(super) fn extent(points: &[(f64, f64)]) -> Option<[(f64, f64); 2]> {
    Some([range(points.iter().map(|point| point.0))?, range(points.iter().map(|point| point.1))?])
}

/// Returns the given range with a margin on both sides. The margin is the fraction `share` of the width of
/// the range. If the given range is empty, the result still has a width.
pub(super) fn padded((low, high): (f64, f64), share: f64) -> (f64, f64) {
    let width = high - low;
    // Numbers that differ only by rounding count as equal.
    if width <= 1e-12 * high.abs().max(low.abs()) {
        let around = if high == 0.0 { 1.0 } else { 0.05 * high.abs() };
        return (low - around, high + around);
    }
    (low - share * width, high + share * width)
}

/// Returns the range of a vertical axis with margins. If the smallest value is at least 0 and less than 30 %
/// of the largest value, the range begins at 0.
pub(super) fn from_zero((low, high): (f64, f64)) -> (f64, f64) {
    let (padded_low, padded_high) = padded((low, high), 0.05);
    if low >= 0.0 && low < 0.3 * high { (0.0, padded_high) } else { (padded_low, padded_high) }
}

/// Returns a distance between ticks at which a range has about `count` ticks. The distance is 1, 2 or 5 times
/// a power of ten.
pub(super) fn step((low, high): (f64, f64), count: f64) -> f64 {
    let rough = (high - low) / count;
    let ten = 10_f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * ten >= rough * 0.75).unwrap_or(10.0);
    factor * ten
}

/// Returns the positions of the ticks within the range.
pub(super) fn ticks(range: (f64, f64), step: f64) -> Vec<f64> {
    let (low, high) = range;
    let first = (low / step - 1e-9).ceil();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a dozen")]
    let count = ((high / step + 1e-9).floor() - first + 1.0).clamp(0.0, 1000.0) as usize;
    (0..count).map(|i| (first + i as f64) * step).collect()
}

/// Returns the number at a tick as text. The number has enough decimals to distinguish ticks at the distance
/// `step`.
pub(super) fn tick(value: f64, range: (f64, f64), step: f64) -> String {
    let largest = range.0.abs().max(range.1.abs());
    // A tick so close to 0 is 0 with rounding errors.
    let value = if value.abs() < 1e-6 * step { 0.0 } else { value };
    if largest >= 1e6 || step < 1e-4 {
        return super::label::short(value);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 5")]
    let decimals = (-(step * 1.0001).log10().floor()).clamp(0.0, 5.0) as usize;
    format!("{value:.decimals$}").replace('-', "−")
}

/// Returns about `most` or fewer points of a line, in their order. The function divides the line into parts
/// and keeps the ends and the extremes of each part, so that peaks remain. The function also keeps one NaN of
/// each part, so that gaps remain.
pub(super) fn thinned(points: &[(f64, f64)], most: usize) -> Vec<(f64, f64)> {
    if points.len() <= most {
        return points.to_vec();
    }
    let stretch = points.len().div_ceil((most / 4).max(1));
    let mut kept = Vec::with_capacity(most);
    for (number, part) in points.chunks(stretch).enumerate() {
        let by_height = |a: &usize, b: &usize| part[*a].1.total_cmp(&part[*b].1);
        let (gaps, numbers): (Vec<usize>, Vec<usize>) =
            (0..part.len()).partition(|&place| part[place].1.is_nan());
        let low = numbers.iter().copied().min_by(by_height);
        let high = numbers.iter().copied().max_by(by_height);
        let ends = [0, part.len() - 1];
        let mut chosen: Vec<usize> =
            ends.into_iter().chain(low).chain(high).chain(gaps.first().copied()).collect();
        chosen.sort_unstable();
        chosen.dedup();
        kept.extend(chosen.into_iter().map(|place| points[number * stretch + place]));
    }
    kept
}

/// Returns `count` evenly spaced whole numbers from 0 to `of` - 1. If `of` is smaller than `count`, returns
/// all whole numbers in this range.
pub(super) fn even(of: usize, count: usize) -> Vec<usize> {
    if of <= count {
        return (0..of).collect();
    }
    (0..count).map(|i| i * (of - 1) / (count - 1).max(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_neither_few_nor_many() {
        for i in 1..400 {
            let range = (-1.3, f64::from(i) * 0.37);
            let ticks = ticks(range, step(range, 6.0));
            assert!((3..=9).contains(&ticks.len()), "{range:?}: {ticks:?}");
        }
    }

    #[test]
    fn ticks_are_round() {
        let range = (95.0, 122.0);
        let step = step(range, 6.0);
        assert_eq!(step, 5.0);
        assert_eq!(ticks(range, step), [95.0, 100.0, 105.0, 110.0, 115.0, 120.0]);
        assert_eq!(tick(105.0, range, step), "105");
        assert_eq!(tick(-0.25, (-1.0, 1.0), 0.05), "−0.25");
        assert_eq!(tick(1e-17, (-1.0, 1.0), 0.5), "0.0");
        assert_eq!(tick(2e-7, (0.0, 1e-6), 2e-7), "2e-7");
        assert_eq!(tick(0.2, (0.1, 0.3), 0.1), "0.2");
    }

    #[test]
    fn ranges_are_never_empty() {
        assert_eq!(range([3.0, f64::NAN, 1.0]), Some((1.0, 3.0)));
        assert_eq!(range([f64::NAN]), None);
        for one in [0.0, 5.0, -2.0] {
            let (low, high) = padded((one, one), 0.1);
            assert!(low < one && one < high);
        }
        assert_eq!(from_zero((0.1, 10.0)).0, 0.0);
        assert!(from_zero((9.0, 10.0)).0 > 8.0);
    }

    #[test]
    fn thinning_keeps_peaks_and_ends() {
        let points: Vec<(f64, f64)> =
            (0..10_000).map(|i| (f64::from(i), if i == 4321 { 9.0 } else { f64::from(i % 7) })).collect();
        let kept = thinned(&points, 400);
        assert!(kept.len() <= 400 && kept.len() > 200, "{}", kept.len());
        assert!(kept.contains(&(4321.0, 9.0)));
        assert_eq!((kept[0], kept[kept.len() - 1]), (points[0], points[9999]));
        assert!(kept.is_sorted_by(|a, b| a.0 < b.0));
        assert_eq!(thinned(&points[..50], 400), points[..50]);
        // A gap in the same part of the line hides no peak.
        let mut gapped = points.clone();
        gapped[4330].1 = f64::NAN;
        let kept = thinned(&gapped, 400);
        assert!(kept.contains(&(4321.0, 9.0)));
        assert_eq!(kept.iter().filter(|point| point.1.is_nan()).count(), 1);
        assert_eq!(even(10, 4), [0, 3, 6, 9]);
        assert_eq!(even(3, 4), [0, 1, 2]);
    }
}
