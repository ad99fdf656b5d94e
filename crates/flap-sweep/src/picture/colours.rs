//! Colours of lines, points and cells.

/// Colours of series that are distinct for any colour vision (Okabe and Ito), the darker colours first.
pub const SERIES: [&str; 7] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];

/// Colour of lines and letters over a picture: fronts, percentiles, unstable orbits.
pub const DARK: &str = "#222222";

/// Default colour of points and bars.
pub const PLAIN: &str = "#8FB0C9";

/// Colour of cells and points without a value.
pub const MISSING: &str = "#c9c9c9";

/// Colour of bistable bands, which have two stable motions.
pub const BISTABLE: &str = "#f3e3b3";

/// Part of the sequential colour map that is used for lines. The lightest colours of the map are hard to see on white.
pub const MOST_OF_MAP: f64 = 0.88;

/// Returns the position in the sequential map, from 0 to [`MOST_OF_MAP`], of line `index` of `count` ordered lines.
///
/// `None` for a single line, which has the first colour of [`SERIES`].
pub fn shade(index: usize, count: usize) -> Option<f64> {
    (count > 1).then(|| MOST_OF_MAP * index as f64 / (count - 1) as f64)
}

/// Returns true if numbers from `low` to `high` have both signs.
///
/// For numbers with both signs, the colour map is diverging, with zero in the middle. The smaller side must be at least
/// 2 % of the larger side.
pub fn is_signed(low: f64, high: f64) -> bool {
    const LEAST: f64 = 0.02;
    low < 0.0 && high > 0.0 && (-low).min(high) > LEAST * (-low).max(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_in_an_order_spread_over_the_map() {
        assert_eq!(shade(0, 1), None);
        assert_eq!((shade(0, 3), shade(1, 3), shade(2, 3)), (Some(0.0), Some(0.44), Some(0.88)));
    }

    #[test]
    fn numbers_beside_zero_are_not_signed() {
        assert!(is_signed(-1.0, 2.0));
        assert!(!is_signed(-0.01, 2.0) && !is_signed(0.0, 2.0) && !is_signed(-2.0, -1.0));
    }
}
