//! Which parameters a sweep varies, and slices through those that a picture does not show.

use std::collections::HashMap;

use flap_sweep::notation::units;

use super::columns::{Cells, NO_WORD, Table};
use super::label;
use crate::failure::Failure;

/// The different values of a column, and which of them each row has.
pub(super) struct Levels {
    /// Per row the index of its value.
    pub(super) codes: Vec<usize>,
    pub(super) values: Values,
}

/// Different values: numbers by rising value, words in the order of the file.
pub(super) enum Values {
    Numbers(Vec<f64>),
    Words(Vec<String>),
}

impl Levels {
    /// The values of the column in these rows. Empty cells are a value of their own, the last.
    pub(super) fn of(table: &Table, column: usize, rows: &[usize]) -> Levels {
        match &table.columns[column].cells {
            Cells::Numbers(values) => {
                let mut distinct: Vec<f64> = rows.iter().map(|&row| values[row]).collect();
                distinct.sort_by(f64::total_cmp);
                distinct.dedup_by(|a, b| a.to_bits() == b.to_bits());
                let places: HashMap<u64, usize> =
                    distinct.iter().enumerate().map(|(place, value)| (value.to_bits(), place)).collect();
                let codes = rows.iter().map(|&row| places[&values[row].to_bits()]).collect();
                Levels { codes, values: Values::Numbers(distinct) }
            }
            Cells::Words { codes, words } => {
                let mut present: Vec<u32> = rows.iter().map(|&row| codes[row]).collect();
                present.sort_unstable();
                present.dedup();
                let text = |code: u32| {
                    let word = if code == NO_WORD { None } else { words.get(code as usize) };
                    word.map_or_else(|| "none".to_owned(), String::clone)
                };
                let places: HashMap<u32, usize> =
                    present.iter().enumerate().map(|(place, code)| (*code, place)).collect();
                Levels {
                    codes: rows.iter().map(|&row| places[&codes[row]]).collect(),
                    values: Values::Words(present.into_iter().map(text).collect()),
                }
            }
            Cells::Unread => {
                Levels { codes: vec![0; rows.len()], values: Values::Words(vec![String::new()]) }
            }
        }
    }

    pub(super) fn len(&self) -> usize {
        match &self.values {
            Values::Numbers(values) => values.len(),
            Values::Words(words) => words.len(),
        }
    }

    /// Value number `place` as text, with its unit.
    pub(super) fn text(&self, place: usize, label: &label::Label) -> String {
        match &self.values {
            Values::Numbers(values) => label.value(values[place]),
            Values::Words(words) => words[place].clone(),
        }
    }

    /// Whether these values always follow from `other`'s, for the same rows.
    fn follow(&self, other: &Levels) -> bool {
        let mut image = vec![usize::MAX; other.len()];
        self.codes.iter().zip(&other.codes).all(|(&mine, &theirs)| {
            let first = image[theirs] == usize::MAX;
            if first {
                image[theirs] = mine;
            }
            image[theirs] == mine
        })
    }
}

/// What the leading columns of a file vary.
pub(super) struct Axes {
    /// Columns with more than one value, without those that follow from one before.
    pub(super) columns: Vec<usize>,
    /// Whether the rows are no grid of them: a sample, of which hardly a value comes twice.
    pub(super) sampled: bool,
}

impl Axes {
    /// Looks at the columns from the second up to `end`.
    pub(super) fn of(table: &Table, end: usize) -> Axes {
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

/// Whether values have even steps or even ratios, as those of an axis often do.
fn is_even(levels: &Levels) -> bool {
    let Values::Numbers(values) = &levels.values else { return false };
    let even = |place: &dyn Fn(f64) -> f64| {
        let steps: Vec<f64> = values.windows(2).map(|two| place(two[1]) - place(two[0])).collect();
        steps.iter().all(|step| (step - steps[0]).abs() <= 1e-6 * steps[0].abs())
    };
    even(&|value| value) || (values[0] > 0.0 && even(&f64::ln))
}

/// Whether an axis is drawn with even ratios: values over a decade or more whose ratios are even.
pub(super) fn is_log(values: &[f64]) -> bool {
    let (Some(first), Some(last)) = (values.first(), values.last()) else { return false };
    if values.len() < 3 || *first <= 0.0 || last / first < 9.99 {
        return false;
    }
    let step = (values[1] / values[0]).ln();
    values.windows(2).all(|two| ((two[1] / two[0]).ln() - step).abs() < 1e-6 * step)
}

/// The rows that have the values of `filters`.
pub(super) fn filtered(table: &Table, filters: &[(String, String)]) -> Result<Vec<usize>, Failure> {
    let mut rows: Vec<usize> = (0..table.rows).collect();
    for (name, text) in filters {
        let column = table.find(name)?;
        let kept: Vec<usize> = match &table.columns[column].cells {
            Cells::Numbers(values) => {
                let wanted = wanted(table, column, text)?;
                // Users write fewer digits than files hold.
                let near = |value: f64| (value - wanted).abs() <= 1e-9 * wanted.abs().max(f64::MIN_POSITIVE);
                rows.iter().copied().filter(|&row| near(values[row])).collect()
            }
            Cells::Words { codes, words } => {
                let code = words.iter().position(|word| word == text);
                rows.iter().copied().filter(|&row| Some(codes[row] as usize) == code).collect()
            }
            Cells::Unread => return Err(Failure::Bug(format!("column `{name}` was not read"))),
        };
        if kept.is_empty() {
            let message = format!("no row has {name} = {text}");
            let levels = Levels::of(table, column, &rows);
            return Err(Failure::usage(message).help(listed(table, column, &levels)));
        }
        rows = kept;
    }
    Ok(rows)
}

/// The number that the user wants, in the column's unit.
fn wanted(table: &Table, column: usize, text: &str) -> Result<f64, Failure> {
    let column = &table.columns[column];
    let number = text.parse().ok().or_else(|| units::parse_as(text, &column.unit).ok());
    number.ok_or_else(|| {
        let message = format!("--where {}={text}: not a number", column.name);
        match column.unit.as_str() {
            "" => Failure::usage(message),
            unit => Failure::usage(message)
                .help(format!("write a number in {unit}, or with a unit of the same kind")),
        }
    })
}

/// The values of a column, a dozen at most.
fn listed(table: &Table, column: usize, levels: &Levels) -> String {
    const MOST: usize = 12;
    let text = |place: usize| match &levels.values {
        Values::Numbers(values) => flap_sweep::notation::text::float(values[place]),
        Values::Words(words) => words[place].clone(),
    };
    let many = levels.len();
    let shown: Vec<String> = if many <= MOST {
        (0..many).map(text).collect()
    } else {
        (0..MOST / 2).map(text).chain(["…".to_owned()]).chain((many - MOST / 2..many).map(text)).collect()
    };
    let Column { name, unit } = Column::of(table, column);
    format!("{name} is {}{unit}", shown.join(", "))
}

struct Column<'a> {
    name: &'a str,
    unit: String,
}

impl Column<'_> {
    fn of(table: &Table, column: usize) -> Column<'_> {
        let column = &table.columns[column];
        let unit = if column.unit.is_empty() { String::new() } else { format!(" {}", column.unit) };
        Column { name: &column.name, unit }
    }
}

/// Rows with one value of each axis that the picture does not show, and what was taken.
pub(super) struct Slice {
    pub(super) rows: Vec<usize>,
    /// Such as `drive_voltage_pp = 70 V`, with the value before as it is typed.
    pub(super) taken: Vec<Taken>,
}

/// The value that was taken of an axis.
pub(super) struct Taken {
    /// As it is shown: `Drive voltage 70 V`.
    pub(super) shown: String,
    /// As it is typed: `drive_voltage_pp=70.0`.
    pub(super) typed: String,
    /// How many values there are.
    pub(super) of: usize,
}

/// Takes the middle value of every axis that is not in `shown`.
pub(super) fn sliced(table: &Table, axes: &[usize], shown: &[usize], mut rows: Vec<usize>) -> Slice {
    let mut taken = Vec::new();
    for &axis in axes.iter().filter(|axis| !shown.contains(axis)) {
        let levels = Levels::of(table, axis, &rows);
        if levels.len() < 2 {
            continue;
        }
        let middle = levels.len() / 2;
        let name = &table.columns[axis].name;
        let value = match &levels.values {
            Values::Numbers(values) => flap_sweep::notation::text::float(values[middle]),
            Values::Words(words) => words[middle].clone(),
        };
        let label = table.label(axis);
        taken.push(Taken {
            shown: format!("{} {}", label.words, levels.text(middle, &label)),
            typed: format!("{name}={value}"),
            of: levels.len(),
        });
        rows = rows
            .into_iter()
            .zip(&levels.codes)
            .filter(|(_, code)| **code == middle)
            .map(|(row, _)| row)
            .collect();
    }
    Slice { rows, taken }
}

#[cfg(test)]
mod tests {
    use super::super::columns::Column;
    use super::*;

    /// A table of columns with a first one that counts.
    fn table(columns: &[(&str, &[f64])]) -> Table {
        let rows = columns[0].1.len();
        let column = |name: &str, values: Vec<f64>| Column {
            name: name.to_owned(),
            unit: if name == "f" { "Hz".to_owned() } else { String::new() },
            cells: Cells::Numbers(values),
        };
        let first = column("point", (0..rows).map(|row| row as f64).collect());
        let rest = columns.iter().map(|(name, values)| column(name, values.to_vec()));
        Table { columns: std::iter::once(first).chain(rest).collect(), rows, of: rows }
    }

    /// Two axes, `f` of three values fastest, one that follows `v`, and one that is the same everywhere.
    fn grid() -> Table {
        table(&[
            ("v", &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]),
            ("f", &[10.0, 20.0, 30.0, 10.0, 20.0, 30.0]),
            ("twice", &[2.0, 2.0, 2.0, 4.0, 4.0, 4.0]),
            ("same", &[7.0; 6]),
        ])
    }

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
    fn slices_take_the_middle_of_what_is_not_shown() {
        let table = grid();
        let slice = sliced(&table, &[1, 2], &[1], (0..6).collect());
        assert_eq!(slice.rows, [1, 4]);
        assert_eq!(slice.taken.len(), 1);
        assert_eq!((slice.taken[0].typed.as_str(), slice.taken[0].of), ("f=20.0", 3));
        assert_eq!(slice.taken[0].shown, "F 20 Hz");
        assert!(sliced(&table, &[1, 2], &[2, 1], (0..6).collect()).taken.is_empty());
    }

    #[test]
    fn filters_take_numbers_with_and_without_units() {
        let table = grid();
        let rows = |name: &str, value: &str| filtered(&table, &[(name.to_owned(), value.to_owned())]);
        assert_eq!(rows("v", "2").unwrap(), [3, 4, 5]);
        assert_eq!(rows("f", "0.02 kHz").unwrap(), [1, 4]);
        assert!(matches!(rows("f", "25"), Err(Failure::Usage(message, help))
            if message == "no row has f = 25" && help == ["f is 10.0, 20.0, 30.0 Hz"]));
        assert!(matches!(rows("f", "fast"), Err(Failure::Usage(..))));
        assert!(matches!(rows("g", "1"), Err(Failure::Usage(..))));
    }

    #[test]
    fn even_ratios_over_a_decade_are_drawn_so() {
        assert!(is_log(&[1.0, 10.0, 100.0]));
        assert!(!is_log(&[1.0, 2.0, 4.0]));
        assert!(!is_log(&[1.0, 20.0, 39.0]));
        assert!(!is_log(&[0.0, 10.0, 100.0]));
    }
}
