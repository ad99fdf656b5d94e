//! The spread of a measure: mean, standard deviation and percentiles.

use flap_sweep::picture::sample::percentile;
use serde::Serialize;

use crate::data::columns::Column;

/// Mean, standard deviation and percentiles of the values of a column. A statistic is NaN (null in JSON) if
/// the column has too few values.
#[derive(Serialize)]
pub(super) struct Spread {
    pub(super) column: String,
    /// The unit as text; empty for a column without a unit.
    pub(super) unit: String,
    /// Number of values.
    pub(super) count: usize,
    pub(super) mean: f64,
    /// Standard deviation, with the divisor `count` - 1.
    pub(super) sd: f64,
    /// Standard error of the mean: `sd` divided by the square root of `count`.
    pub(super) se: f64,
    pub(super) min: f64,
    pub(super) p5: f64,
    pub(super) median: f64,
    pub(super) p95: f64,
    pub(super) max: f64,
}

impl Spread {
    /// Returns the statistics of the numbers in the given rows of a column. Empty cells are ignored.
    pub(super) fn of(column: &Column, numbers: &[f64], rows: &[usize]) -> Spread {
        let mut values: Vec<f64> =
            rows.iter().map(|&row| numbers[row]).filter(|number| !number.is_nan()).collect();
        values.sort_by(f64::total_cmp);
        let [min, p5, median, p95, max] = [0.0, 0.05, 0.5, 0.95, 1.0].map(|share| percentile(&values, share));
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let sum_of_squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let sd = if count > 1 { (sum_of_squares / (count - 1) as f64).sqrt() } else { f64::NAN };
        let se = sd / (count as f64).sqrt();
        let (column, unit) = (column.name.clone(), column.unit.clone());
        Spread { column, unit, count, mean, sd, se, min, p5, median, p95, max }
    }

    /// Returns the mean, the standard deviation and the other statistics, each with its name.
    pub(super) fn statistics(&self) -> [(&'static str, f64); 8] {
        let Spread { mean, sd, se, min, p5, median, p95, max, .. } = *self;
        [
            ("mean", mean),
            ("sd", sd),
            ("se", se),
            ("min", min),
            ("p5", p5),
            ("median", median),
            ("p95", p95),
            ("max", max),
        ]
    }
}
