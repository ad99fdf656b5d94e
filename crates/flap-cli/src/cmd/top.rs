//! `flap top`: the best rows of results.

use std::fmt::Write as _;

use csv::StringRecord;
use flap_core::simulate::Status;
use flap_sweep::notation::text::count;

use super::shown::Shown;
use crate::args::{Aim, LookArgs, TopArgs};
use crate::console;
use crate::data::axes::Ends;
use crate::data::filter::Filters;
use crate::data::source::Source;
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::Table;

pub(crate) fn run(args: &TopArgs) -> Result<Exit, Failure> {
    let LookArgs { results, aim, filters, all, format, read } = &args.look;
    let mut source = Source::open(results, read, true)?;
    let filters = Filters::of(filters, &source)?;
    let columns = columns(args, &source)?;
    let by = source.find(args.by.trim())?;
    let ranking = source.names()[by].clone();
    let status = source.position("status").filter(|_| !all);
    let units: Vec<String> = columns.iter().map(|&column| source.unit(column)).collect();
    let names: Vec<String> = columns.iter().map(|&column| source.names()[column].clone()).collect();

    let aim = aim.unwrap_or_else(|| Aim::of(&ranking));
    // The list begins with the columns of the point, so these columns have the same places in the file and in the list.
    let axes = source.position("status").map_or(0..0, |end| 1..end);
    let mut ends: Vec<Ends> = axes.clone().map(|_| Ends::default()).collect();
    let mut best = Best { most: args.rows.get(), aim, rows: Vec::new() };
    let mut left_out = LeftOut::default();
    let mut row = StringRecord::new();
    let (mut kept, mut ranked) = (0_u64, 0);
    while source.next(&mut row)? {
        if !filters.accept(&row)? {
            continue;
        }
        kept += 1;
        for (ends, axis) in ends.iter_mut().zip(axes.clone()) {
            ends.add(number(row.get(axis).unwrap_or_default()));
        }
        let value = value(&ranking, row.get(by).unwrap_or_default())?;
        if status.is_some_and(|status| row.get(status) != Some(Status::Periodic.name())) {
            left_out.other_statuses += 1;
        } else if value.is_nan() {
            left_out.empty += 1;
        } else {
            let cells: Vec<&str> =
                columns.iter().map(|&column| row.get(column).unwrap_or_default()).collect();
            best.add(value, cells);
            ranked += 1;
        }
    }
    if ranked == 0 {
        return Err(if kept == 0 { args.look.no_rows(&filters) } else { args.look.without(&ranking) });
    }
    let rows = best.sorted();
    let direction = if aim == Aim::Max { "largest" } else { "smallest" };
    let (shown, of) = (
        count(rows.len() as u64, "row"),
        count(ranked, if status.is_some() { "periodic row" } else { "row" }),
    );
    console::say(&format!("{shown} with the {direction} {ranking} of {of}{}", left_out.text()));
    print::table(*format, &names, &rows, || table(&names, &units, &rows))?;
    for (axis, ends) in axes.zip(&ends) {
        let (name, unit, cell) = (&names[axis], &units[axis], &rows[0][axis]);
        if !source.is_no_axis(name) && ends.contain(number(cell)) {
            let shown = Shown::of_column(name, unit, [number(cell)]);
            let (name, value) = (shown.heading(name), shown.cell(cell));
            console::say(&format!(
                "the best row is at the end of {name}, {value}: rows beyond this value may be better"
            ));
        }
    }
    Ok(Exit::Done)
}

/// Returns the columns that flap lists: first the index and the parameters of the point, or the first column
/// of a file without statuses. After these columns, flap lists the ranking column, the columns of `--columns`
/// and the status.
fn columns(args: &TopArgs, source: &Source) -> Result<Vec<usize>, Failure> {
    let status = source.position("status");
    let mut columns: Vec<usize> = (0..status.unwrap_or(1)).collect();
    let asked = [&args.by].into_iter().chain(&args.columns);
    let asked = asked.map(|name| source.find(name.trim())).collect::<Result<Vec<usize>, Failure>>()?;
    for column in asked.into_iter().chain(status) {
        if !columns.contains(&column) {
            columns.push(column);
        }
    }
    Ok(columns)
}

/// Returns the number in a cell of the ranking column, or NaN for an empty cell. Text in the cell is an
/// error.
fn value(by: &str, cell: &str) -> Result<f64, Failure> {
    if cell.is_empty() {
        return Ok(f64::NAN);
    }
    cell.parse().map_err(|_| {
        Failure::usage(format!("column `{by}` contains text such as `{cell}`, and text has no order"))
            .help("choose a column of numbers with --by")
    })
}

/// Returns the number in a cell, or NaN if the cell contains no number.
fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or(f64::NAN)
}

/// The best of the rows that flap has read so far.
struct Best {
    most: usize,
    aim: Aim,
    /// For each row, its value in the ranking column and its cells.
    rows: Vec<(f64, Vec<String>)>,
}

impl Best {
    fn add(&mut self, value: f64, cells: Vec<&str>) {
        // Sorting from time to time is faster than keeping the rows in order.
        if self.rows.len() >= self.most.saturating_mul(2).max(1000) {
            self.cut();
        }
        self.rows.push((value, cells.into_iter().map(str::to_owned).collect()));
    }

    /// Sorts the rows and removes all but the best rows. Rows with equal values stay in the order of the
    /// file.
    fn cut(&mut self) {
        match self.aim {
            Aim::Max => self.rows.sort_by(|a, b| b.0.total_cmp(&a.0)),
            Aim::Min => self.rows.sort_by(|a, b| a.0.total_cmp(&b.0)),
        }
        self.rows.truncate(self.most);
    }

    /// Returns the cells of the best rows. The best row is first.
    fn sorted(mut self) -> Vec<Vec<String>> {
        self.cut();
        self.rows.into_iter().map(|(_, cells)| cells).collect()
    }
}

/// Numbers of rows without a rank: rows that are not periodic, and rows without a value in the ranking
/// column.
#[derive(Default)]
struct LeftOut {
    other_statuses: u64,
    empty: u64,
}

impl LeftOut {
    /// Returns the part of a message that counts the rows without a rank.
    fn text(&self) -> String {
        let mut text = String::new();
        if self.other_statuses > 0 {
            let rows = count(self.other_statuses, "row");
            let _ = write!(text, "; {rows} of other statuses not ranked (--all ranks them)");
        }
        if self.empty > 0 {
            let _ = write!(text, "; {} without a value", count(self.empty, "row"));
        }
        text
    }
}

/// Returns the best rows as a table for a terminal.
fn table(names: &[String], units: &[String], rows: &[Vec<String>]) -> String {
    let shown: Vec<Shown> = (units.iter().enumerate())
        .map(|(place, unit)| {
            Shown::of_column(&names[place], unit, rows.iter().filter_map(|row| row[place].parse().ok()))
        })
        .collect();
    let headings = names.iter().zip(&shown).map(|(name, shown)| shown.heading(name));
    let mut table = Table::with_names(headings.collect());
    for row in rows {
        table.row(row.iter().zip(&shown).map(|(cell, shown)| shown.cell(cell)).collect::<Vec<_>>());
    }
    table.text_within(console::width())
}
