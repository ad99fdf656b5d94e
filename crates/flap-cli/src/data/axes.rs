//! The axes of a sweep: the columns of parameters that vary in a results file.

use flap_sweep::picture::sample::rank_correlation;

use super::columns::{Cells, Table};
use super::levels::{Levels, Values};

/// The parameters that vary in a results file.
#[derive(Clone)]
pub(crate) struct Axes {
    /// Columns with two or more different values. Derived parameters are left out, and also columns whose
    /// values are determined by an earlier column.
    pub(crate) columns: Vec<usize>,
    /// True if the points are a sample, in which most values of a parameter differ, so that the points form
    /// no grid.
    pub(crate) sampled: bool,
    /// Columns among `columns` that belong to a sample. If a column determines the values of other parameters
    /// of the sample, `columns` does not contain these other parameters.
    pub(crate) sample: Vec<usize>,
    /// Columns among `columns` that contain words instead of numbers.
    pub(crate) words: Vec<usize>,
    /// All parameters of a sample. Each parameter of a sample has a different value in every row, so the value of one
    /// parameter determines the values of the other parameters.
    pub(crate) members: Vec<usize>,
}

/// The index of a column with two or more different values, and these values.
type Varied = (usize, Levels);

impl Axes {
    /// Returns the axes among the columns 1 to `end` - 1. Column 0 contains the index of the point.
    pub(crate) fn of(table: &Table, end: usize) -> Axes {
        let rows: Vec<usize> = (0..table.rows).collect();
        let (mut kept, mut others): (Vec<Varied>, Vec<Varied>) = (Vec::new(), Vec::new());
        for column in 1..end {
            let levels = Levels::of(table, column, &rows);
            if levels.len() < 2 {
                continue;
            }
            let follows = table.derived.contains(&table.columns[column].name)
                || kept.iter().any(|(_, earlier)| levels.is_determined_by(earlier));
            if follows { &mut others } else { &mut kept }.push((column, levels));
        }
        let sample = sample(table, &kept, &others);
        // A sample of one parameter alone is treated as a curve over this parameter.
        let sampled = !sample.is_empty() && (kept.len() > 1 || !others.is_empty());
        let members = if sampled { members(table, &sample, &kept, &others) } else { Vec::new() };
        Axes {
            words: (kept.iter().map(|(column, _)| *column))
                .filter(|&column| matches!(table.columns[column].cells, Cells::Words { .. }))
                .collect(),
            members,
            columns: kept.into_iter().map(|(column, _)| column).collect(),
            sampled,
            sample: if sampled { sample } else { Vec::new() },
        }
    }

    /// Returns the columns for which `flap describe` lists the best value: the axes, and all parameters of a
    /// sample.
    pub(crate) fn listed(&self) -> Vec<usize> {
        let mut listed = [self.columns.as_slice(), &self.members].concat();
        listed.sort_unstable();
        listed.dedup();
        listed
    }
}

/// The smallest and the largest value of an axis. If the best row is at the smallest or largest value, an
/// axis with a wider range may have better points.
#[derive(Default)]
pub(crate) struct Ends {
    range: Option<[f64; 2]>,
    /// True if the axis has three or more different values. With only two values, every value would be an
    /// end.
    has_inner: bool,
}

impl Ends {
    /// Returns the smallest and the largest of the values. NaN is ignored.
    pub(crate) fn of(values: &[f64]) -> Ends {
        let mut ends = Ends::default();
        for &value in values {
            ends.add(value);
        }
        ends
    }

    /// Adds a value to the axis, unless the value is NaN.
    pub(crate) fn add(&mut self, value: f64) {
        if value.is_nan() {
            return;
        }
        let [low, high] = self.range.unwrap_or([value; 2]);
        self.has_inner |= low < high && value != low && value != high;
        self.range = Some([low.min(value), high.max(value)]);
    }

    /// Returns true if `value` is an end of an axis with three or more different values.
    pub(crate) fn contain(&self, value: f64) -> bool {
        self.has_inner && self.range.is_some_and(|range| range.contains(&value))
    }
}

/// Returns the columns of all sampled parameters that the sidecar lists. Without a sidecar, returns the
/// columns in `sample` and the columns whose values are determined by a column in `sample`.
fn members(table: &Table, sample: &[usize], kept: &[Varied], others: &[Varied]) -> Vec<usize> {
    let kept_sample = || kept.iter().filter(|(column, _)| sample.contains(column));
    let is_member = |(column, levels): &&Varied| match &table.sample {
        Some(sample) => sample.contains(&table.columns[*column].name),
        None => kept_sample().any(|(_, first)| levels.is_determined_by(first)),
    };
    let mut members: Vec<usize> =
        kept_sample().chain(others.iter().filter(is_member)).map(|(column, _)| *column).collect();
    members.sort_unstable();
    members
}

/// Returns the columns in `kept` that belong to a sample according to the sidecar or, without a sidecar,
/// according to the values in the columns.
fn sample(table: &Table, kept: &[Varied], others: &[Varied]) -> Vec<usize> {
    let full = |levels: &Levels| levels.len() * 2 > table.rows && table.rows > 3;
    let looks_sampled = |(column, levels): &&Varied| {
        if let Some(sample) = &table.sample {
            let is_named = |column: usize| sample.contains(&table.columns[column].name);
            let followers = others.iter().filter(|(_, other)| other.is_determined_by(levels));
            return is_named(*column) || followers.map(|(other, _)| *other).any(is_named);
        }
        let is_alone = kept.len() == 1;
        if full(levels) {
            // In a sample, every column has a different value in each row, so all others follow from the first.
            return !is_alone || (!others.is_empty() && !is_even(levels));
        }
        // A sample crossed with axes.
        !is_alone
            && levels.len() >= FEWEST
            && others.iter().any(|other| is_mixed((*column, levels), other, table))
    };
    kept.iter().filter(looks_sampled).map(|(column, _)| *column).collect()
}

/// Without a sidecar, flap recognises a sample that is combined with axes only if it has at least this number
/// of points.
const FEWEST: usize = 8;

/// Returns true if two columns look like two parameters of a sample. In a sample, `other` determines the values
/// of `column`, these values are unevenly spaced, and the rank correlation is small.
fn is_mixed((column, levels): (usize, &Levels), (other, others): &Varied, table: &Table) -> bool {
    let (Cells::Numbers(one), Cells::Numbers(two)) =
        (&table.columns[column].cells, &table.columns[*other].cells)
    else {
        return false;
    };
    levels.is_determined_by(others) && !is_even(levels) && rank_correlation(one, two).abs() < 0.9
}

/// Returns true for values with constant steps or constant ratios, as axes often have.
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

    #[test]
    fn axes_of_three_values_or_more_have_ends() {
        let ends = Ends::of(&[2.0, 1.0, f64::NAN, 3.0, 2.0]);
        assert_eq!([1.0, 2.0, 3.0, f64::NAN].map(|value| ends.contain(value)), [true, false, true, false]);
        assert!(!Ends::of(&[1.0, 2.0, 2.0, f64::NAN]).contain(1.0));
        assert!(!Ends::of(&[]).contain(0.0));
    }

    #[test]
    fn samples_are_crossed_with_axes() {
        let twice =
            |values: [f64; 8]| values.into_iter().flat_map(|value| [value, value]).collect::<Vec<_>>();
        let a = twice([0.3, 0.1, 0.9, 0.7, 0.2, 0.45, 0.66, 0.81]);
        let b = twice([0.6, 0.5, 0.25, 0.1, 0.8, 0.9, 0.33, 0.42]);
        let f: Vec<f64> = (0..16).map(|row| f64::from(row % 2)).collect();
        let mut crossed = table(&[("a", &a), ("b", &b), ("f", &f)]);
        let axes = Axes::of(&crossed, 4);
        assert_eq!((&axes.columns, axes.sampled), (&vec![1, 3], true));
        assert_eq!((&axes.members, axes.listed()), (&vec![1, 2], vec![1, 2, 3]));
        // The sidecar takes precedence: these are designs of a list.
        crossed.sample = Some(vec!["other".to_owned()]);
        assert!(!Axes::of(&crossed, 4).sampled);
        crossed.sample = Some(vec!["b".to_owned()]);
        assert!(Axes::of(&crossed, 4).sampled);
    }

    #[test]
    fn derived_parameters_are_no_axes() {
        // The product of two axes has a different value in each row, as a sample has.
        let mut table = table(&[
            ("v", &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]),
            ("f", &[10.0, 20.0, 35.0, 10.0, 20.0, 35.0]),
            ("product", &[10.1, 20.2, 35.3, 20.4, 40.5, 70.6]),
        ]);
        assert!(Axes::of(&table, 4).sampled, "without a sidecar");
        table.sample = Some(Vec::new());
        table.derived = vec!["product".to_owned()];
        let axes = Axes::of(&table, 4);
        assert_eq!((axes.columns, axes.sampled, axes.members), (vec![1, 2], false, vec![]));
    }
}
