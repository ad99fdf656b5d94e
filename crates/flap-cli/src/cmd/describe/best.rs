//! The row with the best value of a measure, and the values of the axes in the best rows.

use serde::Serialize;

use crate::args::Aim;
use crate::data::axes::{Axes, Ends};
use crate::data::columns::Table;
use crate::data::levels::{Levels, Value, Values};
use crate::failure::Failure;

/// The row with the best value of a measure.
#[derive(Serialize)]
pub(super) struct Best {
    /// Name of the measure.
    pub(super) column: String,
    pub(super) unit: String,
    /// `max` or `min`.
    pub(super) aim: &'static str,
    pub(super) value: f64,
    /// Index of the point or of the response curve, or the number of the row in files without an index.
    pub(super) point: u64,
    pub(super) axes: Vec<Axis>,
}

/// The values of an axis. An axis is a varied parameter, or the branch of a response curve.
#[derive(Serialize)]
pub(super) struct Axis {
    #[serde(rename = "axis")]
    pub(super) name: String,
    pub(super) unit: String,
    /// Number of different values.
    pub(super) values: usize,
    /// The smallest and the largest value of the axis, or the first and the last word if the values are
    /// words.
    pub(super) range: [Value; 2],
    /// The value of the axis in the best row.
    pub(super) best: Value,
    /// The smallest and the largest value in the best tenth of the rows. If the values are words, the list
    /// contains all words in the best tenth of the rows.
    pub(super) best_tenth: Vec<Value>,
    /// True if the value in the best row is at an end of the axis, and the axis has three or more different
    /// numbers. Always false for parameters of a sample.
    pub(super) at_the_end: bool,
}

impl Best {
    /// Returns the best of the given rows, or `None` if no row has a value of the measure. `row_numbers`
    /// contains, for each row of the table, the number of this row in the file.
    pub(super) fn of(
        table: &Table,
        column: usize,
        aim: Aim,
        rows: &[usize],
        axes: &Axes,
        row_numbers: &[u64],
    ) -> Result<Option<Best>, Failure> {
        let numbers = table.numbers(column)?;
        let mut ranked: Vec<usize> = rows.iter().copied().filter(|&row| !numbers[row].is_nan()).collect();
        ranked.sort_by(|&a, &b| match aim {
            Aim::Max => numbers[b].total_cmp(&numbers[a]),
            Aim::Min => numbers[a].total_cmp(&numbers[b]),
        });
        let Some(&row) = ranked.first() else { return Ok(None) };
        ranked.truncate(ranked.len().div_ceil(10));
        let described = &table.columns[column];
        Ok(Some(Best {
            column: described.name.clone(),
            unit: described.unit.clone(),
            aim: if aim == Aim::Max { "max" } else { "min" },
            value: numbers[row],
            point: point(table, row, row_numbers),
            axes: (axes.listed().into_iter())
                .map(|axis| Axis::of(table, axis, &ranked, axes.members.contains(&axis)))
                .collect(),
        }))
    }
}

/// Returns the row's cell in the first column if this column contains the index of the point or of the
/// response curve. Otherwise returns the number of the row in the file.
fn point(table: &Table, row: usize, row_numbers: &[u64]) -> u64 {
    let first = &table.columns[0];
    let indices = table.numbers(0).ok().filter(|_| ["point", "curve"].contains(&first.name.as_str()));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number from 0")]
    indices.map_or(row_numbers[row], |indices| indices[row] as u64)
}

impl Axis {
    /// Returns the values of an axis in all rows of the table and in the best rows.
    ///
    /// `best` contains the table positions of the best tenth of the rows, beginning with the best row.
    fn of(table: &Table, column: usize, best: &[usize], sampled: bool) -> Axis {
        let rows: Vec<usize> = (0..table.rows).collect();
        let levels = Levels::of(table, column, &rows);
        let mut found: Vec<usize> = best.iter().map(|&row| levels.codes[row]).collect();
        let best_level = found[0];
        found.sort_unstable();
        found.dedup();
        let at_the_end = match &levels.values {
            Values::Numbers(values) => {
                found = vec![found[0], found[found.len() - 1]];
                !sampled && Ends::of(values).contain(values[best_level])
            }
            Values::Words(_) => false,
        };
        let described = &table.columns[column];
        Axis {
            name: described.name.clone(),
            unit: described.unit.clone(),
            values: levels.len(),
            range: [levels.value(0), levels.value(levels.len() - 1)],
            best: levels.value(best_level),
            best_tenth: found.into_iter().map(|level| levels.value(level)).collect(),
            at_the_end,
        }
    }
}
