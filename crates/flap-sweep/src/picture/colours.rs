//! Colours of lines, points and cells.

/// Colours for different lines of a picture. People with any colour vision can distinguish these colours
/// (Okabe and Ito). The darker colours come first, except black, which is the last colour.
pub const SERIES: [&str; 7] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"];

/// Colour of lines and letters that are drawn over a picture, such as Pareto fronts, percentiles and unstable
/// orbits.
pub const DARK: &str = "#222222";

/// Default colour of points and bars.
pub const PLAIN: &str = "#8FB0C9";

/// Colour of cells and points without a value.
pub const MISSING: &str = "#c9c9c9";

/// Colour of bistable bands, which have two stable motions.
pub const BISTABLE: &str = "#f3e3b3";

/// Fraction of the sequential colour map that lines use. Lines do not use the lightest colours of the map,
/// because these colours are hard to see on white.
pub const MOST_OF_MAP: f64 = 0.88;

/// Returns the position of a line's colour in the sequential colour map, from 0 to [`MOST_OF_MAP`]. `index`
/// is the position of the line among `count` ordered lines, counted from 0.
///
/// Returns `None` for a single line, because a single line has the first colour of [`SERIES`].
pub fn shade(index: usize, count: usize) -> Option<f64> {
    (count > 1).then(|| MOST_OF_MAP * index as f64 / (count - 1) as f64)
}

/// Returns true if the range from `low` to `high` contains both negative and positive numbers.
///
/// For numbers with both signs, pictures use a diverging colour map with zero in the middle. The result is
/// also false if the shorter of the parts below and above zero is at most 2 % of the longer part.
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
