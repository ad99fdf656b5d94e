//! The axes of a sweep: the parameters that its results vary.

use super::columns::Table;
use super::levels::{Levels, Values};

/// The parameters that a file varies.
pub(crate) struct Axes {
    /// Columns with more than one value, without those that follow from one before.
    pub(crate) columns: Vec<usize>,
    /// True for a sample: most of its values are different, so that they form no grid.
    pub(crate) sampled: bool,
}

impl Axes {
    /// The axes among the columns from the second up to `end`.
    pub(crate) fn of(table: &Table, end: usize) -> Axes {
        let rows: Vec<usize> = (0..table.rows).collect();
        let mut kept: Vec<(usize, Levels)> = Vec::new();
        for column in 1..end {
            let levels = Levels::of(table, column, &rows);
            if levels.len() > 1 && !kept.iter().any(|(_, earlier)| levels.follow(earlier)) {
                kept.push((column, levels));
            }
        }
        let full = |levels: &Levels| levels.len() * 2 > table.rows && table.rows > 3;
        // In a sample every column tells the rows apart, so that all others follow from the first.
        let others = (1..end).any(|column| {
            kept.iter().all(|(other, _)| *other != column) && Levels::of(table, column, &rows).len() > 1
        });
        let sampled = match &kept[..] {
            [(_, only)] => others && full(only) && !is_even(only),
            several => several.iter().any(|(_, levels)| full(levels)),
        };
        Axes { columns: kept.into_iter().map(|(column, _)| column).collect(), sampled }
    }
}

/// True for values with even steps or even ratios, as those of an axis often have.
fn is_even(levels: &Levels) -> bool {
    let Values::Numbers(values) = &levels.values else { return false };
    let even = |place: &dyn Fn(f64) -> f64| {
        let steps: Vec<f64> = values.windows(2).map(|two| place(two[1]) - place(two[0])).collect();
        steps.iter().all(|step| (step - steps[0]).abs() <= 1e-6 * steps[0].abs())
    };
    even(&|value| value) || (values[0] > 0.0 && even(&f64::ln))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::columns::tests::{grid, table};

    #[test]
    fn axes_are_what_varies_by_itself() {
        let axes = Axes::of(&grid(), 5);
        assert_eq!(axes.columns, [1, 2]);
        assert!(!axes.sampled);
        let line = Axes::of(&table(&[("f", &[1.0, 2.0, 3.0, 4.0, 5.0])]), 2);
        assert!(!line.sampled, "one axis is no sample");
        let zip = table(&[("f", &[1.0, 2.0, 3.0, 4.0, 5.0]), ("a", &[3.0, 1.0, 4.0, 5.0, 9.0])]);
        assert!(!Axes::of(&zip, 3).sampled, "an axis with another that moves along");
        let sample = table(&[("a", &[0.3, 0.1, 0.9, 0.7, 0.2]), ("b", &[0.6, 0.5, 0.25, 0.1, 0.8])]);
        assert!(Axes::of(&sample, 3).sampled);
    }
}
