//! The columns of a picture of some kind.

use super::chosen::Columns;
use super::wishes::Wishes;
use crate::args::PictureKind;
use crate::data::axes::Axes;
use crate::failure::Failure;

/// The columns that are asked for, and usual ones where none is named.
pub(super) fn columns(wishes: &Wishes, axes: &Axes, kind: PictureKind) -> Result<Columns, Failure> {
    match kind {
        PictureKind::Response => response(wishes, axes),
        PictureKind::Map => map(wishes, axes),
        PictureKind::Scatter => scatter(wishes),
        PictureKind::Pareto => pareto(wishes),
        PictureKind::Histogram | PictureKind::Tornado => {
            let x = wishes.x.or(wishes.three[0]);
            let x = x.ok_or_else(|| wishes.unclear("x", NO_MEASURES))?;
            Ok(Columns::plain(kind, x, x))
        }
        PictureKind::Trajectory => trajectory(wishes),
        PictureKind::Hysteresis => hysteresis(wishes, axes),
        PictureKind::Matrix => matrix(wishes),
    }
}

const NO_MEASURES: &str = "the file has no measures";
const NO_VALUES: &str = "no parameter has more than one value";

/// The reason why a picture over axes has none.
fn no_values(axes: &Axes) -> &'static str {
    if axes.sampled { "a sample has no axes" } else { NO_VALUES }
}

/// Refuses a sample where there must be an axis: its designs form no lines and no cells.
fn refuse_sample(wishes: &Wishes, axes: &Axes, columns: &[usize], form: &str) -> Result<(), Failure> {
    let stray = columns.iter().find(|&&column| axes.members.contains(&column) || column >= wishes.end);
    match stray.filter(|_| axes.sampled) {
        Some(&column) => {
            let name = wishes.name(column);
            let message = format!("a sample has no axes: its designs form no {form} over {name}");
            Err(Failure::usage(message).help("draw a sample with --kind scatter, histogram or tornado"))
        }
        None => Ok(()),
    }
}

fn response(wishes: &Wishes, axes: &Axes) -> Result<Columns, Failure> {
    let taken = [wishes.y, wishes.by];
    let free = || axes.columns.iter().copied().filter(|column| !taken.contains(&Some(*column)));
    // Words are names of lines; they are across only if nothing else varies.
    let number = || free().rfind(|column| !axes.words.contains(column));
    let x = wishes.x.or_else(|| frequency(wishes, axes)).or_else(number).or_else(|| free().next_back());
    let why = no_values(axes);
    let x = x.ok_or_else(|| wishes.unclear("x", why))?;
    let y = wishes.y.or(wishes.response);
    let y = y.ok_or_else(|| wishes.unclear("y", NO_MEASURES))?;
    refuse_sample(wishes, axes, &[x], "lines")?;
    let by = wishes.by.or_else(|| if axes.sampled { None } else { free().find(|&column| column != x) });
    Ok(Columns { by, ..Columns::plain(PictureKind::Response, x, y) })
}

fn map(wishes: &Wishes, axes: &Axes) -> Result<Columns, Failure> {
    let free = |other: Option<usize>| {
        let taken = [other, wishes.color];
        // Words have no cells.
        let is_free = move |column: &usize| !taken.contains(&Some(*column)) && !axes.words.contains(column);
        axes.columns.iter().copied().filter(is_free)
    };
    let x = wishes
        .x
        .or_else(|| followed(wishes).filter(|&followed| wishes.y != Some(followed)))
        .or_else(|| frequency(wishes, axes).filter(|&f| wishes.y != Some(f)))
        .or_else(|| free(wishes.y).next_back());
    let x = x.ok_or_else(|| wishes.unclear("x", no_values(axes)))?;
    let y = wishes.y.or_else(|| free(Some(x)).next());
    refuse_sample(wishes, axes, &[Some(x), y].into_iter().flatten().collect::<Vec<_>>(), "cells")?;
    let y = y.ok_or_else(|| wishes.unclear("y", "a map needs two parameters with several numbers"))?;
    let color = wishes.color.or(wishes.three[0]);
    let color = color.ok_or_else(|| wishes.unclear("color", NO_MEASURES))?;
    Ok(Columns { color: Some(color), ..Columns::plain(PictureKind::Map, x, y) })
}

fn scatter(wishes: &Wishes) -> Result<Columns, Failure> {
    let [benefit, cost, motion] = wishes.three;
    let (x, y) = plane(wishes)?;
    let left = [motion, benefit, cost].map(|column| column.filter(|column| ![x, y].contains(column)));
    Ok(Columns {
        color: wishes.color.or_else(|| wishes.free(left)),
        ..Columns::plain(PictureKind::Scatter, x, y)
    })
}

fn pareto(wishes: &Wishes) -> Result<Columns, Failure> {
    let (x, y) = plane(wishes)?;
    Ok(Columns { color: wishes.color, ..Columns::plain(PictureKind::Pareto, x, y) })
}

/// The columns across and up, by default the cost and the benefit.
fn plane(wishes: &Wishes) -> Result<(usize, usize), Failure> {
    let [benefit, cost, motion] = wishes.three;
    let x = wishes.x.or_else(|| wishes.free([cost, motion, benefit]));
    let x = x.ok_or_else(|| wishes.unclear("x", "the file has too few measures"))?;
    let others = [benefit, cost, motion].map(|column| column.filter(|&column| column != x));
    let y = wishes.y.or_else(|| wishes.free(others));
    let y = y.ok_or_else(|| wishes.unclear("y", "the file has too few measures"))?;
    Ok((x, y))
}

fn trajectory(wishes: &Wishes) -> Result<Columns, Failure> {
    for name in ["time_s", "stroke_deg", "pitch_deg"] {
        if wishes.place(name).is_none() {
            let message = format!("a trajectory needs a column {name}, as `flap run --trajectory` writes it");
            return Err(Failure::usage(message).help(wishes.listed()));
        }
    }
    let time = wishes.place("time_s").unwrap_or(0);
    Ok(Columns::plain(PictureKind::Trajectory, time, time))
}

fn matrix(wishes: &Wishes) -> Result<Columns, Failure> {
    let Some(input) = wishes.matrix() else {
        let message = "a matrix needs the columns input, unit, value and force and torque, as `flap vehicle --format csv` writes them";
        return Err(Failure::usage(message).help(wishes.listed()));
    };
    Ok(Columns::plain(PictureKind::Matrix, input, input))
}

fn hysteresis(wishes: &Wishes, axes: &Axes) -> Result<Columns, Failure> {
    let (Some(branch), Some(_)) = (wishes.branch(), wishes.place("bistable")) else {
        let message = "a picture of hysteresis needs the columns `branch` and `bistable`, as `flap respond --out` writes them";
        return Err(Failure::usage(message).help(wishes.listed()));
    };
    let x = wishes.x.unwrap_or(branch + 1);
    let y = wishes.y.or(wishes.response);
    let y = y.ok_or_else(|| wishes.unclear("y", NO_MEASURES))?;
    let by = wishes.by.or_else(|| axes.columns.first().copied());
    Ok(Columns { by, ..Columns::plain(PictureKind::Hysteresis, x, y) })
}

/// The column of the parameter that a response follows.
fn followed(wishes: &Wishes) -> Option<usize> {
    wishes.branch().map(|branch| branch + 1)
}

fn frequency(wishes: &Wishes, axes: &Axes) -> Option<usize> {
    wishes.place("drive_frequency").filter(|column| axes.columns.contains(column))
}
