//! The spread of a measure: its percentiles.

use flap_sweep::picture::sample::percentile;
use serde::Serialize;

use crate::data::columns::Column;

/// Percentiles of the values of a column; NaN (null in JSON) if there are no values.
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
    /// Returns the percentiles of the numbers in `rows`. Empty cells are ignored.
    pub(super) fn of(column: &Column, numbers: &[f64], rows: &[usize]) -> Spread {
        let mut values: Vec<f64> =
            rows.iter().map(|&row| numbers[row]).filter(|number| !number.is_nan()).collect();
        values.sort_by(f64::total_cmp);
        let [min, p5, median, p95, max] = [0.0, 0.05, 0.5, 0.95, 1.0].map(|share| percentile(&values, share));
        let (column, unit) = (column.name.clone(), column.unit.clone());
        Spread { column, unit, count: values.len(), min, p5, median, p95, max }
    }

    /// Returns the percentiles with their names, in rising order.
    pub(super) fn percentiles(&self) -> [(&'static str, f64); 5] {
        let Spread { min, p5, median, p95, max, .. } = *self;
        [("min", min), ("p5", p5), ("median", median), ("p95", p95), ("max", max)]
    }
}
