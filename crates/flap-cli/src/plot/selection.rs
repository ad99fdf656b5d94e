//! Chooses the kind, the columns and the rows of a picture from the user's request and the file.

use flap_sweep::derivative;
use flap_sweep::picture::measures::{Role, usual};
use flap_sweep::vehicle::control::COMPONENTS;

use super::scale;
use super::slices::{self, Taken};
use crate::args::{Aim, Filter, PictureKind, PlotArgs};
use crate::console;
use crate::data::axes::Axes;
use crate::data::columns::{self, Cells, Column, Table};
use crate::data::source::Source;
use crate::data::{filter, quantity};
use crate::failure::Failure;

/// Columns that some kinds of pictures require.
const NEEDED: [&str; 7] =
    ["time_s", "stroke_deg", "pitch_deg", "stroke_rate_rad_s", "pitch_rate_rad_s", "branch", "bistable"];

/// The column with the names of inputs in the output of `flap vehicle`.
pub(super) const INPUT: &str = "input";

/// The name of the row of means in the column of inputs.
pub(super) const MEAN: &str = "mean";

/// The request of the user, as columns of the file.
pub(super) struct Request<'a> {
    pub(super) args: &'a PlotArgs,
    names: Vec<String>,
    pub(super) x: Option<usize>,
    pub(super) y: Option<usize>,
    pub(super) by: Option<usize>,
    pub(super) color: Option<usize>,
    /// Columns that must have a given value, with this value.
    pub(super) values: Vec<(String, String)>,
    pub(super) filters: Vec<usize>,
    /// Axes over which the best rows are drawn.
    pub(super) best_over: Vec<usize>,
    /// The end of the leading parameters: the index of `status`, or of `branch`.
    pub(super) end: usize,
    /// The measure that is drawn over a parameter.
    pub(super) response: Option<usize>,
    /// Measures for benefit, cost and size of the motion. The three measures differ, and a measure may be missing in
    /// the file.
    pub(super) three: [Option<usize>; 3],
}

impl<'a> Request<'a> {
    /// Checks the columns that the user requested.
    pub(super) fn of(source: &Source, args: &'a PlotArgs) -> Result<Request<'a>, Failure> {
        let find = |name: &Option<String>| name.as_deref().map(|name| source.find(name)).transpose();
        let names = source.names().to_vec();
        let place = |name: &str| names.iter().position(|known| known == name);
        let end = place("branch").or_else(|| place("status")).unwrap_or(0);
        let values = args.values();
        let filters = values.iter().map(|(name, _)| source.find(name)).collect::<Result<_, _>>()?;
        let measures = place("status").map_or(names.len(), |status| status + 1);
        let behind: Vec<&str> = names[measures..].iter().map(String::as_str).collect();
        let mut taken = Vec::new();
        let three = [Role::Benefit, Role::Cost, Role::Motion].map(|role| {
            let found = usual(role, &behind, &taken)?;
            taken.push(behind[found]);
            Some(measures + found)
        });
        Ok(Request {
            best_over: args.best_over.iter().map(|name| source.find(name)).collect::<Result<_, _>>()?,
            x: find(&args.x)?,
            y: find(&args.y)?,
            by: find(&args.by)?,
            color: find(&args.color)?,
            response: usual(Role::Response, &behind, &[]).map(|found| measures + found),
            three,
            args,
            values,
            filters,
            end,
            names,
        })
    }

    /// Returns the name of a column.
    pub(super) fn name(&self, column: usize) -> &str {
        &self.names[column]
    }

    /// Returns the index of the column `name`.
    pub(super) fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Returns true if the picture requires the cells of a column.
    pub(super) fn wants(&self, column: usize) -> bool {
        let [a, b, c] = self.three;
        let some = [self.x, self.y, self.by, self.color, self.response, a, b, c].contains(&Some(column));
        // The column after `branch` is the followed parameter.
        some || self.filters.contains(&column)
            || self.best_over.contains(&column)
            || column <= self.end + 1
            // The columns before the time name the motions.
            || self.place("time_s").is_some_and(|time| column < time)
            || self.matrix().is_some()
            || (self.args.derivatives && derivative::parts(&self.names[column]).is_some())
            || NEEDED.contains(&self.names[column].as_str())
    }

    /// Returns the column with the inputs of a vehicle, if the file has one line for each input.
    pub(super) fn matrix(&self) -> Option<usize> {
        let has = |name: &str| self.place(name).is_some();
        let is_matrix = has("unit") && has("value") && COMPONENTS.iter().all(|name| has(name));
        self.place(INPUT).filter(|_| is_matrix)
    }

    /// Returns the first of the given columns that the user did not request.
    pub(super) fn free(&self, preferred: [Option<usize>; 3]) -> Option<usize> {
        let asked = [self.x, self.y, self.color];
        preferred.into_iter().flatten().find(|column| !asked.contains(&Some(*column)))
    }

    /// Returns the column with the branch of each row of `flap respond`.
    pub(super) fn branch(&self) -> Option<usize> {
        self.place("branch")
    }

    /// Returns the failure of a picture without a required column.
    pub(super) fn unclear(&self, option: &str, why: &str) -> Failure {
        Failure::usage(format!("--{option} is not given, and {why}")).help(self.listed())
    }

    /// Returns the columns, as a help line.
    pub(super) fn listed(&self) -> String {
        columns::listed(self.names.iter().map(String::as_str))
    }
}

/// The kind and the columns of a picture.
pub(super) struct Columns {
    pub(super) kind: PictureKind,
    /// Column of the horizontal axis, or the measure of a tornado.
    pub(super) x: usize,
    /// Column of the vertical axis; equal to `x` in a trajectory, a histogram and a tornado.
    pub(super) y: usize,
    /// Column that distinguishes the lines: each value has one line.
    pub(super) by: Option<usize>,
    /// Column shown as colour.
    pub(super) color: Option<usize>,
}

impl Columns {
    /// Returns columns without lines and colours.
    pub(super) fn plain(kind: PictureKind, x: usize, y: usize) -> Columns {
        Columns { kind, x, y, by: None, color: None }
    }
}

/// Returns the kind and the columns of a picture: as requested, or the defaults for what the user did not request.
pub(super) fn columns(request: &Request, axes: &Axes) -> Result<Columns, Failure> {
    let kind = kind(request, axes)?;
    match kind {
        PictureKind::Response => response(request, axes),
        PictureKind::Map => map(request, axes),
        PictureKind::Scatter => scatter(request),
        PictureKind::Pareto => pareto(request),
        PictureKind::Histogram | PictureKind::Tornado => {
            let x = request.x.or(request.three[0]);
            let x = x.ok_or_else(|| request.unclear("x", NO_MEASURES))?;
            Ok(Columns::plain(kind, x, x))
        }
        PictureKind::Trajectory => trajectory(request),
        PictureKind::Hysteresis => hysteresis(request, axes),
        PictureKind::Matrix => matrix(request),
    }
}

const NO_MEASURES: &str = "the file has no measures";
const NO_VALUES: &str = "no parameter has more than one value";

/// Returns the reason why a picture over axes cannot be drawn.
fn no_values(axes: &Axes) -> &'static str {
    if axes.sampled { "a sample has no axes" } else { NO_VALUES }
}

/// Returns an error if a sample has no axis for the picture: its designs form no lines and no cells.
fn refuse_sample(request: &Request, axes: &Axes, columns: &[usize], form: &str) -> Result<(), Failure> {
    let stray = columns.iter().find(|&&column| axes.members.contains(&column) || column >= request.end);
    match stray.filter(|_| axes.sampled) {
        Some(&column) => {
            let name = request.name(column);
            let message = format!("a sample has no axes: its designs form no {form} over {name}");
            Err(Failure::usage(message).help("draw a sample with --kind scatter, histogram or tornado"))
        }
        None => Ok(()),
    }
}

fn response(request: &Request, axes: &Axes) -> Result<Columns, Failure> {
    let taken = [request.y, request.by];
    let free = || axes.columns.iter().copied().filter(|column| !taken.contains(&Some(*column)));
    // Words are values of lines. They are on the horizontal axis only if nothing else varies.
    let number = || free().rfind(|column| !axes.words.contains(column));
    let x = request.x.or_else(|| frequency(request, axes)).or_else(number).or_else(|| free().next_back());
    let why = no_values(axes);
    let x = x.ok_or_else(|| request.unclear("x", why))?;
    let y = request.y.or(request.response);
    let y = y.ok_or_else(|| request.unclear("y", NO_MEASURES))?;
    refuse_sample(request, axes, &[x], "lines")?;
    let by = request.by.or_else(|| if axes.sampled { None } else { free().find(|&column| column != x) });
    Ok(Columns { by, ..Columns::plain(PictureKind::Response, x, y) })
}

fn map(request: &Request, axes: &Axes) -> Result<Columns, Failure> {
    let free = |other: Option<usize>| {
        let taken = [other, request.color];
        // A column of words forms no cells.
        let is_free = move |column: &usize| !taken.contains(&Some(*column)) && !axes.words.contains(column);
        axes.columns.iter().copied().filter(is_free)
    };
    let x = request
        .x
        .or_else(|| followed(request).filter(|&followed| request.y != Some(followed)))
        .or_else(|| frequency(request, axes).filter(|&f| request.y != Some(f)))
        .or_else(|| free(request.y).next_back());
    let x = x.ok_or_else(|| request.unclear("x", no_values(axes)))?;
    let y = request.y.or_else(|| free(Some(x)).next());
    refuse_sample(request, axes, &[Some(x), y].into_iter().flatten().collect::<Vec<_>>(), "cells")?;
    let y = y.ok_or_else(|| request.unclear("y", "a map needs two parameters with several numbers"))?;
    let color = request.color.or(request.three[0]);
    let color = color.ok_or_else(|| request.unclear("color", NO_MEASURES))?;
    Ok(Columns { color: Some(color), ..Columns::plain(PictureKind::Map, x, y) })
}

fn scatter(request: &Request) -> Result<Columns, Failure> {
    let [benefit, cost, motion] = request.three;
    let (x, y) = plane(request)?;
    let left = [motion, benefit, cost].map(|column| column.filter(|column| ![x, y].contains(column)));
    Ok(Columns {
        color: request.color.or_else(|| request.free(left)),
        ..Columns::plain(PictureKind::Scatter, x, y)
    })
}

fn pareto(request: &Request) -> Result<Columns, Failure> {
    let (x, y) = plane(request)?;
    Ok(Columns { color: request.color, ..Columns::plain(PictureKind::Pareto, x, y) })
}

/// Returns the horizontal and the vertical column; by default, the cost and the benefit.
fn plane(request: &Request) -> Result<(usize, usize), Failure> {
    let [benefit, cost, motion] = request.three;
    let x = request.x.or_else(|| request.free([cost, motion, benefit]));
    let x = x.ok_or_else(|| request.unclear("x", "the file has too few measures"))?;
    let others = [benefit, cost, motion].map(|column| column.filter(|&column| column != x));
    let y = request.y.or_else(|| request.free(others));
    let y = y.ok_or_else(|| request.unclear("y", "the file has too few measures"))?;
    Ok((x, y))
}

fn trajectory(request: &Request) -> Result<Columns, Failure> {
    for name in ["time_s", "stroke_deg", "pitch_deg"] {
        if request.place(name).is_none() {
            let message =
                format!("a trajectory requires the column {name}, as in files of `flap run --trajectory`");
            return Err(Failure::usage(message).help(request.listed()));
        }
    }
    let time = request.place("time_s").unwrap_or(0);
    Ok(Columns::plain(PictureKind::Trajectory, time, time))
}

fn matrix(request: &Request) -> Result<Columns, Failure> {
    let Some(input) = request.matrix() else {
        let message = "a matrix requires the columns input, unit, value, and force and torque, as `flap vehicle --format csv` writes them";
        return Err(Failure::usage(message).help(request.listed()));
    };
    Ok(Columns::plain(PictureKind::Matrix, input, input))
}

fn hysteresis(request: &Request, axes: &Axes) -> Result<Columns, Failure> {
    let (Some(branch), Some(_)) = (request.branch(), request.place("bistable")) else {
        let message = "a picture of hysteresis requires the columns `branch` and `bistable`, as `flap respond --out` writes them";
        return Err(Failure::usage(message).help(request.listed()));
    };
    let x = request.x.unwrap_or(branch + 1);
    let y = request.y.or(request.response);
    let y = y.ok_or_else(|| request.unclear("y", NO_MEASURES))?;
    let by = request.by.or_else(|| axes.columns.first().copied());
    Ok(Columns { by, ..Columns::plain(PictureKind::Hysteresis, x, y) })
}

/// Returns the column of the followed parameter of a response.
fn followed(request: &Request) -> Option<usize> {
    request.branch().map(|branch| branch + 1)
}

fn frequency(request: &Request, axes: &Axes) -> Option<usize> {
    request.place("drive_frequency").filter(|column| axes.columns.contains(column))
}

/// Returns the kind of picture that the user requested, or a kind that suits the file.
fn kind(request: &Request, axes: &Axes) -> Result<PictureKind, Failure> {
    let kind = match request.args.kind {
        Some(kind) => kind,
        None => suitable(request, axes)?,
    };
    refuse_strays(request, kind)?;
    Ok(kind)
}

fn suitable(request: &Request, axes: &Axes) -> Result<PictureKind, Failure> {
    if request.branch().is_some() {
        return Ok(PictureKind::Hysteresis);
    }
    if request.matrix().is_some() {
        return Ok(PictureKind::Matrix);
    }
    let motion = ["time_s", "stroke_deg", "pitch_deg"].iter().all(|name| request.place(name).is_some());
    if motion && request.x.is_none() && request.y.is_none() {
        return Ok(PictureKind::Trajectory);
    }
    // A sample has no axes: its designs form points, not lines or cells.
    if axes.sampled && request.by.is_none() {
        return Ok(if has_aims(request) { PictureKind::Pareto } else { PictureKind::Scatter });
    }
    if let (Some(x), Some(y)) = (request.x, request.y) {
        return Ok(of_columns(request, axes, x, y));
    }
    if request.end == 0 {
        let message = "no kind of picture suits this file: it is neither a sweep nor a motion";
        return Err(Failure::usage(message).help("choose columns with --x and --y").help(request.listed()));
    }
    let frequency = request.place("drive_frequency").is_some_and(|column| axes.columns.contains(&column));
    let numbers = axes.columns.len() - axes.words.len();
    let lines = request.by.is_some() || numbers < 2 || frequency;
    let colours = request.color.is_some() && numbers > 1;
    Ok(if lines && !colours { PictureKind::Response } else { PictureKind::Map })
}

/// Returns the kind for two columns of a grid.
fn of_columns(request: &Request, axes: &Axes, x: usize, y: usize) -> PictureKind {
    let is_parameter = |column: usize| (1..request.end).contains(&column);
    match (is_parameter(x), is_parameter(y)) {
        (true, true) => PictureKind::Map,
        // Designs along one axis form a curve, for which a front has no meaning.
        (false, false) if request.end > 0 && (axes.columns.len() > 1 || has_aims(request)) => {
            PictureKind::Pareto
        }
        (false, false) if request.end > 0 => PictureKind::Scatter,
        _ => PictureKind::Response,
    }
}

/// Returns true if the user set a better direction.
fn has_aims(request: &Request) -> bool {
    request.args.x_aim.is_some() || request.args.y_aim.is_some()
}

/// Returns an error if an option does not apply to the kind of picture.
fn refuse_strays(request: &Request, kind: PictureKind) -> Result<(), Failure> {
    use PictureKind::{Histogram, Hysteresis, Map, Pareto, Response, Scatter, Tornado};
    let strays = [
        (request.by.is_some(), &[Response, Hysteresis][..], "--by requires", "--kind response or hysteresis"),
        (
            request.color.is_some(),
            &[Map, Scatter, Pareto],
            "--color requires",
            "--kind map, scatter or pareto",
        ),
        (!request.best_over.is_empty(), &[Map, Response], "--best-over requires", "--kind map or response"),
        (request.args.derivatives, &[Tornado], "--derivatives requires", "--kind tornado"),
        (has_aims(request), &[Pareto], "--x-aim and --y-aim require", "--kind pareto"),
        (
            request.x.is_some(),
            &[Response, Map, Scatter, Pareto, Hysteresis, Histogram, Tornado],
            "--x requires",
            "another kind",
        ),
        (
            request.y.is_some(),
            &[Response, Map, Scatter, Pareto, Hysteresis],
            "--y requires",
            "another kind, which has an axis for it",
        ),
    ];
    if matches!(kind, Histogram | Tornado) && request.y.is_some() {
        return Err(Failure::usage(format!("a {} has no --y; choose its measure with --x", kind.name())));
    }
    match strays.iter().find(|(is_given, kinds, ..)| *is_given && !kinds.contains(&kind)) {
        Some((_, _, option, home)) => {
            let message = format!("{option} {home}, but this picture is a {}", kind.name());
            Err(Failure::usage(message).help("choose the kind with --kind"))
        }
        None => Ok(()),
    }
}

/// The contents of a picture.
pub(super) struct Selection {
    pub(super) columns: Columns,
    /// The better directions of x and y.
    pub(super) aims: (Aim, Aim),
    pub(super) rows: Vec<usize>,
    /// The columns of parameters, sampled parameters first.
    pub(super) parameters: Vec<usize>,
    /// True if the designs are a sample.
    pub(super) sampled: bool,
    pub(super) title: String,
    /// Filters and slices as text.
    pub(super) notes: Vec<String>,
}

impl Selection {
    /// Returns the failure of a picture for which `column` has no number.
    pub(super) fn nothing(&self, table: &Table, column: usize) -> Failure {
        let (name, rows) = (&table.columns[column].name, self.rows.len());
        let message = format!("none of {rows} rows has a value of {name}: there is nothing to draw");
        Failure::usage(message).help(
            "points whose status is not `periodic` have no measures; `flap results rerun` runs them again",
        )
    }
}

/// Chooses kind, columns and rows.
pub(super) fn select(request: &Request, table: &Table, title: String) -> Result<Selection, Failure> {
    let axes = Axes::of(table, request.end);
    let mut free = axes.clone();
    free.columns.retain(|axis| !request.best_over.contains(axis));
    let columns = columns(request, &free)?;
    let mut values = request.values.clone();
    let mut filters = request.filters.clone();
    if let (PictureKind::Map, Some(branch)) = (columns.kind, request.branch())
        && !filters.contains(&branch)
        && has_both_ways(table, branch)
    {
        console::say("drawn: branch = up; --where branch=down chooses the other branch");
        values.push(("branch".to_owned(), "up".to_owned()));
        filters.push(branch);
    }
    let rows = slices::filtered(table, &values)?;
    check_span(table, &columns, &rows)?;
    let label = |column: usize| table.label(column);
    let mut notes: Vec<String> = (filters.iter().zip(&values))
        .map(|(&column, (_, value))| format!("{} {}", label(column).words, shown(table, column, value)))
        .collect();
    notes.extend(request.args.comparisons().into_iter().map(|filter| match filter {
        Filter::Comparison(text) | Filter::Equal(_, text) => quantity::printed(&text),
    }));
    let mut hidden = left(&columns, &axes);
    if let Some(&shown) = request.best_over.iter().find(|over| !hidden.contains(over)) {
        let message = format!("--best-over {}: not an axis that the picture leaves out", request.name(shown));
        let names: Vec<&str> = hidden.iter().map(|&axis| request.name(axis)).collect();
        let help = match names.as_slice() {
            [] => "the picture shows all axes".to_owned(),
            names => format!("the picture leaves out {}", names.join(", ")),
        };
        return Err(Failure::usage(message).help(help));
    }
    hidden.retain(|axis| !request.best_over.contains(axis));
    let mut slice = slices::sliced(table, &hidden, rows);
    if !request.best_over.is_empty() {
        let (measure, second) = match columns.color {
            Some(color) => (color, Some(columns.y)),
            None => (columns.y, columns.by),
        };
        let shown: Vec<usize> = [Some(columns.x), second].into_iter().flatten().collect();
        let aim = Aim::of(request.name(measure));
        slice.rows = slices::best(table, &shown, measure, aim, &slice.rows)?;
        let names: Vec<&str> = request.best_over.iter().map(|&axis| request.name(axis)).collect();
        notes.push(format!("best over {}", names.join(", ")));
        tell_best(table, request, measure, aim, &slice.rows)?;
    }
    for Taken { name, value, of, .. } in &slice.taken {
        console::say(&format!(
            "drawn: {name} = {value}, the middle of {of} values; --where chooses another value"
        ));
    }
    notes.extend(slice.taken.into_iter().map(|taken| taken.shown));
    let mut parameters: Vec<usize> = (1..request.end).collect();
    parameters.sort_by_key(|&column| !table.sample.contains(&table.columns[column].name));
    Ok(Selection {
        aims: aims(request, &columns),
        columns,
        rows: slice.rows,
        parameters,
        sampled: axes.sampled,
        title,
        notes,
    })
}

/// Prints the place of the best row among the given rows.
fn tell_best(
    table: &Table,
    request: &Request,
    measure: usize,
    aim: Aim,
    rows: &[usize],
) -> Result<(), Failure> {
    let Some(&row) = slices::best(table, &[], measure, aim, rows)?.first() else { return Ok(()) };
    let value = |column: usize| -> Result<String, Failure> {
        let number = table.numbers(column)?[row];
        Ok(format!("{} = {}", request.name(column), table.label(column).value(number)))
    };
    let axes = Axes::of(table, request.end);
    let places =
        axes.columns.iter().filter(|column| !axes.words.contains(column)).map(|&column| value(column));
    let places = places.collect::<Result<Vec<String>, Failure>>()?.join(", ");
    console::say(&format!("best: {} at {places}", value(measure)?));
    Ok(())
}

/// Returns true if the file has rows of the branch up and of the branch down.
fn has_both_ways(table: &Table, branch: usize) -> bool {
    let Cells::Words { words, .. } = &table.columns[branch].cells else { return false };
    ["up", "down"].iter().all(|way| words.iter().any(|word| word == way))
}

/// Returns an error if differences of the numbers exceed the largest float, so that no axis can show the numbers.
fn check_span(table: &Table, columns: &Columns, rows: &[usize]) -> Result<(), Failure> {
    /// Margins and ticks require the rest of the range of floating-point numbers.
    const LARGEST: f64 = f64::MAX / 16.0;
    for column in [Some(columns.x), Some(columns.y), columns.color].into_iter().flatten() {
        let Cells::Numbers(values) = &table.columns[column].cells else { continue };
        let Some((low, high)) = scale::range(rows.iter().map(|&row| values[row])) else { continue };
        if high.abs().max(low.abs()) > LARGEST {
            let name = &table.columns[column].name;
            let message =
                format!("the values of {name}, from {low:e} to {high:e}, are too large for a picture");
            return Err(Failure::usage(message).help(format!("choose rows: --where '{name} < 1e300'")));
        }
    }
    Ok(())
}

/// Returns a value that the user typed, in the unit of the picture.
fn shown(table: &Table, column: usize, typed: &str) -> String {
    let Column { name, unit, .. } = &table.columns[column];
    match filter::number(name, unit, typed) {
        Ok(Some(number)) => table.label(column).value(number),
        _ => typed.to_owned(),
    }
}

/// Returns the better directions of x and y.
pub(super) fn aims(request: &Request, columns: &Columns) -> (Aim, Aim) {
    let aim = |asked: Option<Aim>, column: usize| asked.unwrap_or_else(|| Aim::of(request.name(column)));
    (aim(request.args.x_aim, columns.x), aim(request.args.y_aim, columns.y))
}

/// Returns the axes that the picture does not show.
fn left(columns: &Columns, axes: &Axes) -> Vec<usize> {
    use PictureKind::{Histogram, Matrix, Pareto, Scatter, Tornado, Trajectory};
    let shown = [Some(columns.x), Some(columns.y), columns.by];
    let is_left = |column: &usize| match columns.kind {
        Pareto | Trajectory | Matrix => false,
        // All designs of a grid are drawn; for a sample crossed with axes, all points of the sample.
        Scatter | Histogram | Tornado => axes.sampled && !axes.sample.contains(column),
        _ => true,
    };
    axes.columns.iter().copied().filter(|column| is_left(column) && !shown.contains(&Some(*column))).collect()
}
