//! Selects rows by conditions, and by the values of axes that a picture does not show.

use std::collections::BTreeMap;

use crate::args::Aim;
use crate::data::columns::{Cells, Column, Table};
use crate::data::filter;
use crate::data::levels::Levels;
use crate::failure::Failure;

/// Returns the rows that satisfy all conditions: each condition is a column and the value of this column.
pub(super) fn filtered(table: &Table, filters: &[(usize, String)]) -> Result<Vec<usize>, Failure> {
    let mut rows: Vec<usize> = (0..table.rows).collect();
    for &(column, ref text) in filters {
        let Column { name, unit, cells } = &table.columns[column];
        let kept: Vec<usize> = match cells {
            Cells::Numbers(values) => {
                let wanted = filter::number(name, unit, text)?.ok_or_else(|| {
                    let message = format!("`{name}` has numbers, and `{text}` is not a number");
                    Failure::usage(format!("--where {name}={text}: {message}"))
                })?;
                rows.iter().copied().filter(|&row| filter::is_same(values[row], wanted)).collect()
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
            let failure = Failure::usage(message).help(listed(table, column, &levels));
            return Err(failure.helps(prefix_question(table, column, text)));
        }
        rows = kept;
    }
    Ok(rows)
}

/// If a number without a unit looks too large or too small, returns the question whether the user meant a
/// unit with a prefix.
fn prefix_question(table: &Table, column: usize, text: &str) -> Option<String> {
    let Column { name, unit, .. } = &table.columns[column];
    let usual = *table.numbers(column).ok()?.first()?;
    filter::prefix_question(name, unit, text.parse().ok()?, usual)
}

/// Returns a help line with the values of a column, at most twelve.
fn listed(table: &Table, column: usize, levels: &Levels) -> String {
    const MOST: usize = 12;
    let text = |place| levels.value(place).typed();
    let many = levels.len();
    let shown: Vec<String> = if many <= MOST {
        (0..many).map(text).collect()
    } else {
        (0..MOST / 2).map(text).chain(["…".to_owned()]).chain((many - MOST / 2..many).map(text)).collect()
    };
    let Column { name, unit, .. } = &table.columns[column];
    format!("{name} is {} {unit}", shown.join(", ")).trim_end().to_owned()
}

/// Chooses the middle value of each axis in `axes`, because the picture does not show these axes.
///
/// Returns the rows that have the chosen values. Also returns, for each chosen value, a message for stderr
/// and a note for the picture.
pub(super) fn sliced(table: &Table, axes: &[usize], mut rows: Vec<usize>) -> (Vec<usize>, Vec<[String; 2]>) {
    let mut chosen = Vec::new();
    for &axis in axes {
        let levels = Levels::of(table, axis, &rows);
        let (many, middle) = (levels.len(), levels.len() / 2);
        if many < 2 {
            continue;
        }
        let (name, label) = (&table.columns[axis].name, table.label(axis));
        let value = levels.text(middle, &label);
        let message =
            format!("drawn: {name} = {value}, the middle of {many} values; --where chooses another value");
        chosen.push([message, format!("{} {value}", label.words)]);
        rows = rows
            .into_iter()
            .zip(&levels.codes)
            .filter(|(_, code)| **code == middle)
            .map(|(row, _)| row)
            .collect();
    }
    (rows, chosen)
}

/// For each combination of values in the columns `shown`, returns the row with the best number in the column
/// `measure`.
///
/// If no row of a combination has a number, returns the first row of this combination. The returned rows are
/// in the order of the file.
pub(super) fn best(
    table: &Table,
    shown: &[usize],
    measure: usize,
    aim: Aim,
    rows: &[usize],
) -> Result<Vec<usize>, Failure> {
    let numbers = table.numbers(measure)?;
    let levels: Vec<Levels> = shown.iter().map(|&column| Levels::of(table, column, rows)).collect();
    let is_better = |row: usize, than: usize| {
        numbers[than].is_nan()
            || match aim {
                Aim::Max => numbers[row] > numbers[than],
                Aim::Min => numbers[row] < numbers[than],
            }
    };
    let mut found: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for (place, &row) in rows.iter().enumerate() {
        let key = levels.iter().map(|levels| levels.codes[place]).collect();
        let best = found.entry(key).or_insert(row);
        if is_better(row, *best) {
            *best = row;
        }
    }
    let mut rows: Vec<usize> = found.into_values().collect();
    rows.sort_unstable();
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::columns::tests::grid;

    #[test]
    fn slices_take_the_middle_of_what_is_not_shown() {
        let table = grid();
        let (rows, chosen) = sliced(&table, &[2], (0..6).collect());
        assert_eq!(rows, [1, 4]);
        let message = "drawn: f = 20 Hz, the middle of 3 values; --where chooses another value";
        assert_eq!(chosen, [[message, "F 20 Hz"]]);
        assert!(sliced(&table, &[], (0..6).collect()).1.is_empty());
    }

    #[test]
    fn the_best_row_over_an_axis_that_is_not_shown() {
        let table = crate::data::columns::tests::table(&[
            ("v", &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0]),
            ("f", &[10.0, 20.0, 30.0, 10.0, 20.0, 30.0, 10.0]),
            ("lift", &[f64::NAN, 5.0, 4.0, 1.0, 1.0, 3.0, f64::NAN]),
        ]);
        let rows: Vec<usize> = (0..7).collect();
        let best = |shown: &[usize], aim| best(&table, shown, 3, aim, &rows).unwrap();
        assert_eq!(best(&[1], Aim::Max), [1, 5, 6]);
        assert_eq!(best(&[1], Aim::Min), [2, 3, 6]);
        assert_eq!(best(&[], Aim::Max), [1]);
        assert_eq!(best(&[1, 2], Aim::Max), rows);
    }

    #[test]
    fn filters_take_numbers_with_and_without_units() {
        let table = grid();
        let rows = |column: usize, value: &str| filtered(&table, &[(column, value.to_owned())]);
        assert_eq!(rows(1, "2").unwrap(), [3, 4, 5]);
        assert_eq!(rows(2, "0.02 kHz").unwrap(), [1, 4]);
        assert!(matches!(rows(2, "25"), Err(Failure::Usage(message, help))
            if message == "no row has f = 25" && help == ["f is 10.0, 20.0, 30.0 Hz"]));
        assert!(matches!(rows(2, "fast"), Err(Failure::Usage(..))));
    }
}
