//! Chooses between linear and logarithmic scales.

/// Returns true if an axis or a colour bar with the ascending `values` should be logarithmic.
///
/// A logarithmic scale requires at least three positive values with a constant ratio, over a factor of ten or
/// more.
pub fn is_log(values: &[f64]) -> bool {
    let (Some(first), Some(last)) = (values.first(), values.last()) else { return false };
    if values.len() < 3 || *first <= 0.0 || last / first < 9.99 {
        return false;
    }
    let step = (values[1] / values[0]).ln();
    values.windows(2).all(|two| ((two[1] / two[0]).ln() - step).abs() < 1e-6 * step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constant_ratios_over_a_decade_are_logarithmic() {
        assert!(is_log(&[1.0, 10.0, 100.0]));
        assert!(!is_log(&[1.0, 2.0, 4.0]));
        assert!(!is_log(&[1.0, 20.0, 39.0]));
        assert!(!is_log(&[0.0, 10.0, 100.0]));
    }
}
