//! The spread of a measure: its percentiles.

use serde::Serialize;

use crate::data::columns::Column;

/// Percentiles of the values of a column; NaN, which JSON has as null, if there are no values.
#[derive(Serialize)]
pub(super) struct Spread {
    pub(super) column: String,
    /// The unit in words; empty for none.
    pub(super) unit: String,
    /// Number of values.
    pub(super) count: usize,
    pub(super) min: f64,
    pub(super) p5: f64,
    pub(super) median: f64,
    pub(super) p95: f64,
    pub(super) max: f64,
}

impl Spread {
    /// The spread of the numbers in `rows`. Empty cells do not count.
    pub(super) fn of(column: &Column, numbers: &[f64], rows: &[usize]) -> Spread {
        let mut values: Vec<f64> =
            rows.iter().map(|&row| numbers[row]).filter(|number| !number.is_nan()).collect();
        values.sort_by(f64::total_cmp);
        let [min, p5, median, p95, max] = [0.0, 0.05, 0.5, 0.95, 1.0].map(|share| percentile(&values, share));
        let (column, unit) = (column.name.clone(), column.unit.clone());
        Spread { column, unit, count: values.len(), min, p5, median, p95, max }
    }

    /// The percentiles with their names, by rising value.
    pub(super) fn percentiles(&self) -> [(&'static str, f64); 5] {
        let Spread { min, p5, median, p95, max, .. } = *self;
        [("min", min), ("p5", p5), ("median", median), ("p95", p95), ("max", max)]
    }
}

/// The value below which this share of the rising `values` lies, interpolated between two of them; NaN if there is none.
fn percentile(values: &[f64], share: f64) -> f64 {
    let Some(last) = values.len().checked_sub(1) else { return f64::NAN };
    let place = share * last as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the last place")]
    let below = place.floor() as usize;
    let part = place - below as f64;
    // The product of nought and an infinite difference is no number.
    if part == 0.0 { values[below] } else { values[below] + part * (values[below + 1] - values[below]) }
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
}
