//! The kind of picture that suits a file and the wishes of the user.

use super::wishes::Wishes;
use crate::args::PictureKind;
use crate::data::axes::Axes;
use crate::failure::Failure;

/// The kind that is asked for, else the one that suits.
pub(super) fn kind(wishes: &Wishes, axes: &Axes) -> Result<PictureKind, Failure> {
    let kind = match wishes.args.kind {
        Some(kind) => kind,
        None => suitable(wishes, axes)?,
    };
    refuse_strays(wishes, kind)?;
    Ok(kind)
}

fn suitable(wishes: &Wishes, axes: &Axes) -> Result<PictureKind, Failure> {
    if wishes.branch().is_some() {
        return Ok(PictureKind::Hysteresis);
    }
    if wishes.matrix().is_some() {
        return Ok(PictureKind::Matrix);
    }
    let motion = ["time_s", "stroke_deg", "pitch_deg"].iter().all(|name| wishes.place(name).is_some());
    if motion && wishes.x.is_none() && wishes.y.is_none() {
        return Ok(PictureKind::Trajectory);
    }
    // A sample has no axes: its designs make points, not lines or cells.
    if axes.sampled && wishes.by.is_none() {
        return Ok(if has_aims(wishes) { PictureKind::Pareto } else { PictureKind::Scatter });
    }
    if let (Some(x), Some(y)) = (wishes.x, wishes.y) {
        return Ok(of_columns(wishes, axes, x, y));
    }
    if wishes.end == 0 {
        let message = "cannot tell what to draw: this is neither a sweep nor a motion";
        return Err(Failure::usage(message).help("name columns with --x and --y").help(wishes.listed()));
    }
    let frequency = wishes.place("drive_frequency").is_some_and(|column| axes.columns.contains(&column));
    let numbers = axes.columns.len() - axes.words.len();
    let lines = wishes.by.is_some() || numbers < 2 || frequency;
    let colours = wishes.color.is_some() && numbers > 1;
    Ok(if lines && !colours { PictureKind::Response } else { PictureKind::Map })
}

/// The kind for two columns of a grid.
fn of_columns(wishes: &Wishes, axes: &Axes, x: usize, y: usize) -> PictureKind {
    let is_parameter = |column: usize| (1..wishes.end).contains(&column);
    match (is_parameter(x), is_parameter(y)) {
        (true, true) => PictureKind::Map,
        // Designs along one axis are a curve, of which a front says nothing.
        (false, false) if wishes.end > 0 && (axes.columns.len() > 1 || has_aims(wishes)) => {
            PictureKind::Pareto
        }
        (false, false) if wishes.end > 0 => PictureKind::Scatter,
        _ => PictureKind::Response,
    }
}

/// True if the user said which direction is better.
fn has_aims(wishes: &Wishes) -> bool {
    wishes.args.x_aim.is_some() || wishes.args.y_aim.is_some()
}

/// Refuses options that this kind does not have.
fn refuse_strays(wishes: &Wishes, kind: PictureKind) -> Result<(), Failure> {
    use PictureKind::{Histogram, Hysteresis, Map, Pareto, Response, Scatter, Tornado};
    let strays = [
        (wishes.by.is_some(), &[Response, Hysteresis][..], "--by needs", "--kind response or hysteresis"),
        (wishes.color.is_some(), &[Map, Scatter, Pareto], "--color needs", "--kind map, scatter or pareto"),
        (has_aims(wishes), &[Pareto], "--x-aim and --y-aim need", "--kind pareto"),
        (
            wishes.x.is_some(),
            &[Response, Map, Scatter, Pareto, Hysteresis, Histogram, Tornado],
            "--x needs",
            "another kind",
        ),
        (
            wishes.y.is_some(),
            &[Response, Map, Scatter, Pareto, Hysteresis],
            "--y needs",
            "another kind, which has an axis for it",
        ),
    ];
    if matches!(kind, Histogram | Tornado) && wishes.y.is_some() {
        return Err(Failure::usage(format!("a {} has no --y; name its measure with --x", kind.name())));
    }
    match strays.iter().find(|(is_given, kinds, ..)| *is_given && !kinds.contains(&kind)) {
        Some((_, _, option, home)) => {
            let message = format!("{option} {home}, and this picture is a {}", kind.name());
            Err(Failure::usage(message).help("name the kind with --kind"))
        }
        None => Ok(()),
    }
}
