//! Chooses the kind of a picture and the columns that the picture shows.

use super::request::Request;
use crate::args::PictureKind;
use crate::data::axes::Axes;
use crate::failure::Failure;

/// The kind of a picture, and the positions of the columns that the picture shows.
pub(super) struct Columns {
    pub(super) kind: PictureKind,
    /// Column on the horizontal axis, or the measure of a tornado picture.
    pub(super) x: usize,
    /// Column on the vertical axis. In pictures of a trajectory or a matrix, and in histogram and tornado
    /// pictures, `y` equals `x`.
    pub(super) y: usize,
    /// Column that distinguishes the lines. The picture has one line for each value of this column.
    pub(super) by: Option<usize>,
    /// Column that the picture shows as colour.
    pub(super) color: Option<usize>,
}

impl Columns {
    /// Returns the columns of a picture that has neither a column `by` nor a column `color`.
    pub(super) fn plain(kind: PictureKind, x: usize, y: usize) -> Columns {
        Columns { kind, x, y, by: None, color: None }
    }
}

/// Returns the kind and the columns of a picture. If the user gave no kind or omitted a column, the function
/// chooses the kind or the column.
pub(super) fn columns(request: &Request, axes: &Axes) -> Result<Columns, Failure> {
    let kind = request.args.kind.map_or_else(|| suitable(request, axes), Ok)?;
    refuse_strays(request, kind)?;
    match kind {
        PictureKind::Response => response(request, axes),
        PictureKind::Map => map(request, axes),
        PictureKind::Scatter => scatter(request, axes),
        PictureKind::Pareto => pareto(request),
        PictureKind::Histogram | PictureKind::Tornado => {
            let x = request.required("x", request.x.or(request.measures[0]), NO_MEASURES)?;
            Ok(Columns::plain(kind, x, x))
        }
        PictureKind::Trajectory => trajectory(request),
        PictureKind::Hysteresis => hysteresis(request, axes),
        PictureKind::Matrix => matrix(request),
    }
}

/// Columns of a motion over time.
const MOTION: [&str; 3] = ["time_s", "stroke_deg", "pitch_deg"];

/// Returns the kind of picture that flap draws if the user did not give `--kind`.
fn suitable(request: &Request, axes: &Axes) -> Result<PictureKind, Failure> {
    if request.branch().is_some() {
        return Ok(PictureKind::Hysteresis);
    }
    if request.matrix().is_some() {
        return Ok(PictureKind::Matrix);
    }
    let is_motion = MOTION.iter().all(|name| request.position(name).is_some());
    if is_motion && request.x.is_none() && request.y.is_none() {
        return Ok(PictureKind::Trajectory);
    }
    // A sample has no axes: its designs form points, not lines or cells.
    if axes.sampled && request.by.is_none() {
        return Ok(if request.has_aims() { PictureKind::Pareto } else { PictureKind::Scatter });
    }
    if let (Some(x), Some(y)) = (request.x, request.y) {
        return Ok(of_columns(request, axes, x, y));
    }
    if request.parameters_end == 0 {
        let message = "no kind of picture suits this file: it is neither a sweep nor a motion";
        return Err(request.unsuitable(message).help("choose columns with --x and --y"));
    }
    let numbers = axes.columns.len() - axes.words.len();
    let lines = request.by.is_some() || numbers < 2 || frequency(request, axes).is_some();
    let colours = request.color.is_some() && numbers > 1;
    Ok(if lines && !colours { PictureKind::Response } else { PictureKind::Map })
}

/// Returns the kind of picture for the columns `x` and `y` that the user requested, if the points form a
/// grid.
fn of_columns(request: &Request, axes: &Axes, x: usize, y: usize) -> PictureKind {
    let is_parameter = |column: usize| (1..request.parameters_end).contains(&column);
    match (is_parameter(x), is_parameter(y)) {
        (true, true) => PictureKind::Map,
        // Designs along one axis form a curve, for which a front has no meaning.
        (false, false) if request.parameters_end > 0 && (axes.columns.len() > 1 || request.has_aims()) => {
            PictureKind::Pareto
        }
        (false, false) if request.parameters_end > 0 => PictureKind::Scatter,
        _ => PictureKind::Response,
    }
}

/// Returns an error if the user gave an option that the kind of picture does not have.
fn refuse_strays(request: &Request, kind: PictureKind) -> Result<(), Failure> {
    use PictureKind::{Histogram, Hysteresis, Map, Pareto, Response, Scatter, Tornado};
    if matches!(kind, Histogram | Tornado) && request.y.is_some() {
        return Err(Failure::usage(format!("a {} has no --y; choose its measure with --x", kind.name())));
    }
    let options = [
        (request.by.is_some(), &[Response, Hysteresis][..], "--by requires --kind response or hysteresis"),
        (request.color.is_some(), &[Map, Scatter, Pareto], "--color requires --kind map, scatter or pareto"),
        (!request.best_over.is_empty(), &[Map, Response], "--best-over requires --kind map or response"),
        (request.args.derivatives, &[Tornado], "--derivatives requires --kind tornado"),
        (request.has_aims(), &[Pareto], "--x-aim and --y-aim require --kind pareto"),
        (
            request.x.is_some(),
            &[Response, Map, Scatter, Pareto, Hysteresis, Histogram, Tornado],
            "--x requires another kind",
        ),
        (
            request.y.is_some(),
            &[Response, Map, Scatter, Pareto, Hysteresis],
            "--y requires another kind, which has an axis for it",
        ),
    ];
    match options.into_iter().find(|(is_given, kinds, _)| *is_given && !kinds.contains(&kind)) {
        Some((_, _, rule)) => {
            let message = format!("{rule}, but this picture is a {}", kind.name());
            Err(Failure::usage(message).help("choose the kind with --kind"))
        }
        None => Ok(()),
    }
}

const NO_MEASURES: &str = "the file has no measures";
const FEW_MEASURES: &str = "the file has too few measures";

/// Returns the reason why flap cannot choose an axis for the picture.
fn no_values(axes: &Axes) -> &'static str {
    if axes.sampled { "a sample has no axes" } else { "no parameter has more than one value" }
}

/// Returns an error if the points are a sample and `columns` contains a parameter of the sample or a measure.
/// The designs of a sample form no lines and no cells.
fn refuse_sample(request: &Request, axes: &Axes, columns: &[usize], form: &str) -> Result<(), Failure> {
    let stray =
        columns.iter().find(|&&column| axes.members.contains(&column) || column >= request.parameters_end);
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
    let x = request.required("x", x, no_values(axes))?;
    let y = request.required("y", request.y.or(request.response), NO_MEASURES)?;
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
    // The column after `branch` is the followed parameter.
    let followed = request.branch().map(|branch| branch + 1);
    let mut usual = [followed, frequency(request, axes)].into_iter().flatten();
    let x = request.x.or_else(|| usual.find(|&column| request.y != Some(column)));
    let x = request.required("x", x.or_else(|| free(request.y).next_back()), no_values(axes))?;
    let y = request.y.or_else(|| free(Some(x)).next());
    refuse_sample(request, axes, &[x].into_iter().chain(y).collect::<Vec<_>>(), "cells")?;
    let y = request.required("y", y, "a map needs two parameters with several numbers")?;
    let color = request.required("color", request.color.or(request.measures[0]), NO_MEASURES)?;
    Ok(Columns { color: Some(color), ..Columns::plain(PictureKind::Map, x, y) })
}

fn scatter(request: &Request, axes: &Axes) -> Result<Columns, Failure> {
    let [benefit, cost, motion] = request.measures;
    let (x, y) = plane(request)?;
    // Colours distinguish devices, presets or other options along an axis.
    let color = request.color.or_else(|| axes.words.first().copied());
    let color = color.or_else(|| request.free([motion, benefit, cost], &[x, y]));
    Ok(Columns { color, ..Columns::plain(PictureKind::Scatter, x, y) })
}

fn pareto(request: &Request) -> Result<Columns, Failure> {
    let (x, y) = plane(request)?;
    Ok(Columns { color: request.color, ..Columns::plain(PictureKind::Pareto, x, y) })
}

/// Returns the columns on the horizontal and the vertical axis. By default, these columns are a cost, such as
/// power, and a benefit, such as lift.
fn plane(request: &Request) -> Result<(usize, usize), Failure> {
    let [benefit, cost, motion] = request.measures;
    let x = request.x.or_else(|| request.free([cost, motion, benefit], &[]));
    let x = request.required("x", x, FEW_MEASURES)?;
    let y = request.y.or_else(|| request.free([benefit, cost, motion], &[x]));
    Ok((x, request.required("y", y, FEW_MEASURES)?))
}

fn trajectory(request: &Request) -> Result<Columns, Failure> {
    if let Some(name) = MOTION.iter().find(|name| request.position(name).is_none()) {
        return Err(request.unsuitable(format!(
            "a trajectory requires the column {name}, as in files of `flap run --trajectory`"
        )));
    }
    let time = request.position(MOTION[0]).unwrap_or(0);
    Ok(Columns::plain(PictureKind::Trajectory, time, time))
}

fn matrix(request: &Request) -> Result<Columns, Failure> {
    let input = request.matrix().ok_or_else(|| {
        request.unsuitable(
            "a matrix requires the columns input, unit, value, and force and torque, as `flap vehicle --format csv` writes them",
        )
    })?;
    Ok(Columns::plain(PictureKind::Matrix, input, input))
}

fn hysteresis(request: &Request, axes: &Axes) -> Result<Columns, Failure> {
    let branch = request.branch().filter(|_| request.position("bistable").is_some()).ok_or_else(|| {
        request.unsuitable(
            "a picture of hysteresis requires the columns `branch` and `bistable`, as `flap respond --out` writes them",
        )
    })?;
    let x = request.x.unwrap_or(branch + 1);
    let y = request.required("y", request.y.or(request.response), NO_MEASURES)?;
    let by = request.by.or_else(|| axes.columns.first().copied());
    Ok(Columns { by, ..Columns::plain(PictureKind::Hysteresis, x, y) })
}

/// Returns the column of the drive frequency, if the sweep varies the drive frequency.
fn frequency(request: &Request, axes: &Axes) -> Option<usize> {
    request.position("drive_frequency").filter(|column| axes.columns.contains(column))
}
