//! `flap describe`: counts of statuses, percentiles of measures, and the values of the axes in the best rows.

mod best;
mod description;
mod show;
mod spread;
mod words;

use best::Best;
use description::{Count, Description};
use flap_core::simulate::Status;
use spread::Spread;
use words::Words;

use crate::args::{Aim, DescribeArgs, LookArgs};
use crate::console;
use crate::data::axes::Axes;
use crate::data::columns::{Cells, Table};
use crate::data::filter::Filters;
use crate::data::levels::{Levels, Values};
use crate::data::source::Source;
use crate::failure::{Exit, Failure};

/// Measures for which flap lists the best row if the user does not give `--by`.
const MAIN: [&str; 2] = ["lift_mean_mn", "efficiency_gf_per_w"];

pub(crate) fn run(args: &DescribeArgs) -> Result<Exit, Failure> {
    let LookArgs { results, filters, format, read, .. } = &args.look;
    let source = Source::open(results, read, true)?;
    let filters = Filters::of(filters, &source)?;
    let selected = Selected::of(args, &source)?;
    // The numbers of the rows that are kept.
    let (mut row_numbers, mut rows) = (Vec::new(), 0..);
    let table = source.read_kept(
        |column| selected.is_read[column],
        usize::MAX,
        |row| {
            let number = rows.next();
            let is_kept = filters.accept(row)?;
            row_numbers.extend(number.filter(|_| is_kept));
            Ok(is_kept)
        },
    )?;
    if table.rows == 0 {
        return Err(args.look.no_rows(&filters));
    }
    let description = describe(&table, &selected, args, &row_numbers)?;
    console::results(&show::text(&description, *format)?)?;
    Ok(Exit::Done)
}

/// The columns that the user selected.
struct Selected {
    status: Option<usize>,
    /// Columns to summarize, and true if the user chose these columns with `--columns`.
    columns: (Vec<usize>, bool),
    /// For each column of the file, true if flap reads the cells of the column.
    is_read: Vec<bool>,
    /// Measures for which flap lists the best row.
    by: Vec<usize>,
}

impl Selected {
    fn of(args: &DescribeArgs, source: &Source) -> Result<Selected, Failure> {
        let find = |names: &[String]| {
            names.iter().map(|name| source.find(name.trim())).collect::<Result<Vec<usize>, Failure>>()
        };
        let status = source.position("status");
        let first_measure = status.map_or(0, |status| status + 1);
        let columns = match args.columns.as_slice() {
            [] => ((first_measure..source.names().len()).collect(), false),
            names => (find(names)?, true),
        };
        let mut by = find(&args.by)?;
        if by.is_empty() && status.is_some() {
            by = MAIN.into_iter().filter_map(|name| source.position(name)).collect();
            let first = Some(first_measure).filter(|&first| by.is_empty() && first < source.names().len());
            by.extend(first);
        }
        let mut is_read = vec![false; source.names().len()];
        for column in (0..first_measure).chain(columns.0.iter().copied()).chain(by.iter().copied()) {
            is_read[column] = true;
        }
        Ok(Selected { status, columns, is_read, by })
    }
}

fn describe(
    table: &Table,
    selected: &Selected,
    args: &DescribeArgs,
    row_numbers: &[u64],
) -> Result<Description, Failure> {
    let (statuses, rows) = match selected.status {
        Some(status) => statuses(table, status, args.look.all),
        None => (Vec::new(), (0..table.rows).collect()),
    };
    let (columns, are_named) = &selected.columns;
    let (mut spreads, mut words) = (Vec::new(), Vec::new());
    for &column in columns {
        if let Cells::Numbers(numbers) = &table.columns[column].cells {
            spreads.push(Spread::of(&table.columns[column], numbers, &rows));
        } else if *are_named {
            words.push(Words::of(table, column, &rows)?);
        }
    }
    if spreads.is_empty() && words.is_empty() && selected.status.is_none() {
        let message = format!("{} has no column of numbers", args.look.results.display());
        return Err(Failure::usage(message));
    }
    let axes = Axes::of(table, selected.status.unwrap_or(0));
    let mut best = Vec::new();
    for &column in &selected.by {
        let aim = args.look.aim.unwrap_or_else(|| Aim::of(&table.columns[column].name));
        let found = Best::of(table, column, aim, &rows, &axes, row_numbers)?;
        if found.is_none() && !args.by.is_empty() {
            return Err(args.look.without(&table.columns[column].name));
        }
        best.extend(found);
    }
    Ok(Description { rows: table.of, statuses, columns: spreads, words, best })
}

/// Returns the number of rows with each status, and the rows to summarize. If `all` is false, only rows with
/// a periodic motion are summarized.
fn statuses(table: &Table, status: usize, all: bool) -> (Vec<Count>, Vec<usize>) {
    let rows: Vec<usize> = (0..table.rows).collect();
    let levels = Levels::of(table, status, &rows);
    let Values::Words(words) = &levels.values else { return (Vec::new(), rows) };
    let count = |place: usize| levels.codes.iter().filter(|&&code| code == place).count();
    let counts = words.iter().enumerate();
    let counts = counts.map(|(place, word)| Count { status: word.clone(), rows: count(place) }).collect();
    let is_periodic = |row: &usize| words[levels.codes[*row]] == Status::Periodic.name();
    (counts, rows.into_iter().filter(|row| all || is_periodic(row)).collect())
}
