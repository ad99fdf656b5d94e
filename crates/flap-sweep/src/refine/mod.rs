//! Refines a grid: chooses the points that are added after the points of the axes.
//!
//! The points of the axes are the corners of boxes. When the rows of all corners exist, flap estimates the
//! error of a multilinear interpolation within each box (`estimate`). Boxes with large errors are halved, and
//! the midpoints of their edges are the next points (`mesh`). In each round, flap estimates the errors, adds
//! points and computes their rows. The rounds end when all estimated errors are small enough, or the plan has
//! `max_points` points.
//!
//! The points that a round adds depend only on the settings and on the rows that were written before this
//! round. A resumed run reads these rows from its results file, and therefore adds the same points as a run
//! without an interruption.

mod estimate;
mod mesh;

use std::collections::VecDeque;
use std::io;

use csv::StringRecord;
use serde::{Deserialize, Serialize};

use crate::plan::axes::{Axis, Values};
use crate::plan::refine::{Error, Limit, Refine};
use crate::plan::selection::Selection;
use crate::plan::{Admission, Plan};
use crate::table::layout::Layout;
use estimate::Tolerance;
use mesh::{Mesh, Place, Side};

/// A refinement that has not ended, with the measures of the rows that it has received.
#[derive(Clone, Debug)]
pub struct Refinement {
    refine: Refine,
    /// For each axis of the plan: the number of its values, and the index of the axis among the axes along
    /// which points are added. If no points are added along the axis, the index is `None`.
    axes: Vec<(u64, Option<usize>)>,
    /// Indices of the columns that contain the measures of the refinement.
    columns: Vec<usize>,
    mesh: Mesh,
    /// Points whose rows have not been received yet, in the order of the points.
    waiting: VecDeque<Place>,
    points: u64,
    rounds: u64,
}

/// Result of a refinement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Refined {
    /// Number of times that flap estimated the errors of boxes and then added points.
    pub rounds: u64,
    /// Number of points that the refinement added to the points of the axes.
    pub added: u64,
    /// Number of boxes whose corners are the points of the refined grid.
    pub boxes: u64,
    /// Number of boxes whose estimated error is too large.
    pub above: u64,
    /// True if the refinement ended early because of `max_points`.
    pub is_limited: bool,
}

impl Refinement {
    /// Returns the refinement of `plan` at its beginning, when it has not received any rows.
    ///
    /// Returns `None` if the plan has no refinement, only some of its points are selected, or its rows lack a
    /// measure of the refinement.
    pub fn of(plan: &Plan) -> Option<Refinement> {
        let refine = plan.refine().filter(|_| *plan.selection() == Selection::All)?.clone();
        let names = Layout::of(plan).names();
        let column = |limit: &Limit| names.iter().position(|name| *name == limit.column);
        let columns: Vec<usize> = refine.measures.iter().map(column).collect::<Option<_>>()?;
        let all = plan.axes().as_slice();
        let refined = |axis: usize| refine.along.iter().position(|along| *along == axis);
        let axes: Vec<_> = all.iter().enumerate().map(|(place, axis)| (axis.len(), refined(place))).collect();
        let sides = refine.along.iter().map(|&along| side(&all[along])).collect();
        let maps = axes.iter().filter(|(_, refined)| refined.is_none()).map(|(length, _)| length).product();
        let mesh = Mesh::new(sides, maps, refine.halvings, columns.len());
        let mut refinement =
            Refinement { refine, axes, columns, mesh, waiting: VecDeque::new(), points: 0, rounds: 0 };
        refinement.points = plan.axes().points();
        refinement.waiting = (0..refinement.points).map(|index| refinement.place(index)).collect();
        Some(refinement)
    }

    /// Receives the row of the next point. `cell` returns the number in a column of the row, or NaN if the
    /// number is unknown or the point is excluded.
    pub(crate) fn add(&mut self, cell: impl Fn(usize) -> f64) {
        let measures: Vec<f64> = self.columns.iter().map(|&column| cell(column)).collect();
        if let Some(place) = self.waiting.pop_front() {
            self.mesh.add(place, &measures);
        }
    }

    /// Estimates the errors of boxes, and returns the points that the refinement adds next. Each point is a
    /// list of positions, one along each axis.
    ///
    /// The result is empty if the refinement has ended, or if a row of the earlier points is missing.
    pub fn next_round(&mut self) -> Vec<Vec<f64>> {
        if !self.waiting.is_empty() {
            return Vec::new();
        }
        let room = self.refine.max_points.saturating_sub(self.points);
        // Large enough to fill the lanes of all threads, and small enough that later points use earlier rows.
        let wanted = (self.points / 4).max(64).min(room);
        let places = self.mesh.next_round(&self.tolerances(), (wanted, room));
        self.rounds += u64::from(!places.is_empty());
        self.points += places.len() as u64;
        let positions = places.iter().map(|place| self.positions(place)).collect();
        self.waiting = places.into();
        positions
    }

    /// Returns the number of rounds, the number of added points and the numbers of boxes of the refinement so
    /// far.
    pub fn refined(&self) -> Refined {
        let added = self.points - self.axes.iter().map(|(length, _)| length).product::<u64>();
        let [boxes, above, open] = self.mesh.count(&self.tolerances());
        Refined { rounds: self.rounds, added, boxes, above, is_limited: open > 0 }
    }

    fn tolerances(&self) -> Vec<Tolerance> {
        let limits = self.refine.measures.iter().zip(self.mesh.ranges());
        let tolerance = |(limit, range): (&Limit, f64)| match limit.error {
            Error::Share(share) => Tolerance { error: share * range, range },
            Error::Absolute(error) => Tolerance { error, range },
        };
        limits.map(tolerance).collect()
    }

    /// Returns the place that point number `index` has in the mesh.
    fn place(&self, index: u64) -> Place {
        let mut place = Place { map: 0, at: vec![0; self.refine.along.len()] };
        let (mut rest, mut maps) = (index, 1);
        for (length, refined) in self.axes.iter().rev() {
            let position = rest % length;
            rest /= length;
            if let Some(axis) = refined {
                place.at[*axis] = position << self.refine.halvings;
            } else {
                place.map += position * maps;
                maps *= length;
            }
        }
        place
    }

    /// Converts a place in the mesh to a position along each axis of the plan.
    fn positions(&self, place: &Place) -> Vec<f64> {
        let whole = (1_u64 << self.refine.halvings) as f64;
        let mut rest = place.map;
        let mut positions: Vec<f64> = Vec::with_capacity(self.axes.len());
        for (length, refined) in self.axes.iter().rev() {
            positions.push(if let Some(axis) = refined {
                place.at[*axis] as f64 / whole
            } else {
                let position = rest % length;
                rest /= length;
                position as f64
            });
        }
        positions.reverse();
        positions
    }
}

/// Returns the coordinates along an axis, between which measures are interpolated.
fn side(axis: &Axis) -> Side {
    match axis.parameters().first() {
        Some((_, Values::List(list))) => Side::Listed(list.clone()),
        _ => Side::Even(axis.len()),
    }
}

/// Repeats the refinement of an interrupted run from its written rows. Returns the plan with all points that
/// the interrupted run had added. Also returns the state of the refinement after the rows of the first `done`
/// points.
///
/// `rows` contains the written rows of the plan, in the order of the points.
///
/// Returns `None` if the plan has no refinement.
///
/// # Errors
/// - [`io::ErrorKind::InvalidData`] if `rows` does not contain the row of each point in the order of the
///   plan.
/// - Any error that occurs while a row is read.
pub fn replay(
    plan: &Plan,
    done: u64,
    mut rows: impl Iterator<Item = io::Result<StringRecord>>,
) -> io::Result<Option<(Plan, Refinement)>> {
    let Some(mut refinement) = Refinement::of(plan) else { return Ok(None) };
    let mut plan = plan.clone();
    for index in 0..done {
        if index >= plan.len() {
            plan = plan.with_added_unchecked(refinement.next_round());
        }
        if index >= plan.len() {
            return Err(not_next(index));
        }
        let row = match plan.judge(&plan.point(index).values) {
            Admission::Excluded(_) => None,
            Admission::Runs | Admission::Invalid(_) => {
                let row = rows.next().ok_or_else(|| not_next(index))??;
                if row.get(0) != Some(index.to_string().as_str()) {
                    return Err(not_next(index));
                }
                Some(row)
            }
        };
        refinement.add(|column| {
            let cell = row.as_ref().and_then(|row| row.get(column));
            cell.and_then(|cell| cell.parse().ok()).unwrap_or(f64::NAN)
        });
    }
    Ok(Some((plan, refinement)))
}

fn not_next(index: u64) -> io::Error {
    let message = format!("the row of point {index} is missing, or belongs to another grid");
    io::Error::new(io::ErrorKind::InvalidData, message)
}
