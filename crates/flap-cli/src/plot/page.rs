//! The HTML page of results, on which users choose columns, filter rows and read values. The page contains
//! the rows, the code and the style.

mod data;

use std::collections::BTreeMap;

use data::{Data, Kind, Start};

use super::request::Request;
use super::{kind, selection, slices};
use crate::args::{Aim, PictureKind, PlotArgs};
use crate::console;
use crate::data::axes::Axes;
use crate::data::columns::{Cells, Table};
use crate::data::filter::Filters;
use crate::data::levels::Value;
use crate::data::source::Source;
use crate::failure::Failure;

/// Largest number of rows in a page, because a browser draws all rows many times while the user moves the
/// mouse.
const MOST_ROWS: usize = 1 << 17;

/// Returns the HTML page of a results file. If `is_verbose` is true, prints warnings about the results to
/// stderr.
pub(super) fn page(args: &PlotArgs, heading: &str, is_verbose: bool) -> Result<String, Failure> {
    let source = Source::open(&args.results, &args.read, is_verbose)?;
    let request = Request::of(&source, args)?;
    let comparisons = Filters::of(&args.comparisons(), &source)?;
    let table = comparisons.read(source, |_| true, MOST_ROWS)?;
    let axes = Axes::of(&table, request.parameters_end);
    let start = start(&request, &table, &axes, args)?;
    if table.of > table.rows {
        console::say(&format!("{} of {} rows are in the page, evenly chosen", table.rows, table.of));
    }
    let json = Data::new(&table, &axes.columns, &start, request.branch()).json();
    let data = json.map_err(|error| Failure::Bug(error.to_string()))?;
    Ok(flap_live::page::results(heading, &data))
}

/// Returns the first view of the page. If `flap plot` can draw a picture with the arguments of the command,
/// the first view is this picture.
fn start(request: &Request, table: &Table, axes: &Axes, args: &PlotArgs) -> Result<Start, Failure> {
    let filters = (request.filters.iter())
        .map(|(column, text)| Ok((request.name(*column).to_owned(), filter(table, *column, text)?)))
        .collect::<Result<BTreeMap<_, _>, Failure>>()?;
    let drawn = kind::columns(request, axes).and_then(|columns| {
        table.numbers(columns.x)?;
        table.numbers(columns.y)?;
        Ok(columns)
    });
    let columns = match drawn {
        Ok(columns) => columns,
        // The page always has a view. Only an explicitly selected kind must be possible.
        Err(failure) if args.kind.is_some() => return Err(failure),
        Err(_) => {
            let numbers = || (0..table.columns.len()).filter(|&column| table.numbers(column).is_ok());
            let x = request.x.or(numbers().next());
            let y = request.y.or(numbers().nth(1)).or(x);
            let (Some(x), Some(y)) = (x, y) else {
                return Err(Failure::usage("no column of the file contains numbers"));
            };
            table.numbers(x)?;
            table.numbers(y)?;
            let (kind, best) = (Kind::Scatter, String::new());
            return Ok(Start { kind, x, y, by: None, color: None, best, filters });
        }
    };
    let (mut best, mut by, mut y) = (String::new(), columns.by, columns.y);
    let kind = match columns.kind {
        PictureKind::Map => Kind::Map,
        PictureKind::Pareto => {
            let sign = |aim: Aim| if aim == Aim::Max { "1" } else { "-1" };
            let (x_aim, y_aim) = selection::aims(request, &columns);
            best = format!("{},{}", sign(x_aim), sign(y_aim));
            Kind::Scatter
        }
        PictureKind::Response => Kind::Line,
        PictureKind::Scatter => Kind::Scatter,
        PictureKind::Histogram | PictureKind::Tornado | PictureKind::Matrix => {
            let message = format!("--html cannot show a {}; use --out FILE.png", columns.kind.name());
            return Err(Failure::usage(message).help("a page shows lines, points, fronts and maps"));
        }
        PictureKind::Hysteresis => {
            by = by.or(request.branch());
            Kind::Line
        }
        PictureKind::Trajectory => {
            y = table.find("stroke_deg")?;
            Kind::Line
        }
    };
    table.numbers(columns.x)?;
    table.numbers(y)?;
    Ok(Start { kind, x: columns.x, y, by, color: columns.color, best, filters })
}

/// Returns the value of a condition `COLUMN=VALUE` in the form that the file contains.
fn filter(table: &Table, column: usize, text: &str) -> Result<Value, Failure> {
    let rows = slices::filtered(table, &[(column, text.to_owned())])?;
    Ok(match &table.columns[column].cells {
        Cells::Numbers(values) => Value::Number(values[rows[0]]),
        _ => Value::Word(text.to_owned()),
    })
}
