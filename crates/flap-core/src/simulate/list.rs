//! Rows of a list of points.

use core::iter::Enumerate;
use std::vec::IntoIter;

use super::error::Unfinished;
use super::jobs::{Jobs, Point};
use super::row::Row;
use super::settings::SolverSettings;
use super::simulator::Rows;
use crate::num::Backend;
use crate::ode::Interrupt;

/// Runs `points` on the lanes of `set`. Returns their rows in the order of the points, whose indices do not matter.
///
/// # Errors
/// [`Unfinished::Interrupted`] if `interrupted` says so, or if `rows` leaves a point without a row.
pub fn run_list(
    rows: &dyn Rows,
    set: Backend,
    solver: &SolverSettings,
    points: Vec<Point>,
    interrupted: Interrupt<'_>,
) -> Result<Vec<Row>, Unfinished> {
    let mut list =
        List { rows: vec![None; points.len()], points: points.into_iter().enumerate(), interrupted };
    rows.run(set, solver, &mut list);
    let rows = if interrupted() { None } else { list.rows.into_iter().collect() };
    rows.ok_or(Unfinished::Interrupted)
}

/// Points in order, and rows by the position of their point.
struct List<'a> {
    points: Enumerate<IntoIter<Point>>,
    rows: Vec<Option<Row>>,
    interrupted: Interrupt<'a>,
}

impl Jobs for List<'_> {
    fn next(&mut self, _idle: bool) -> Option<Point> {
        let (position, point) = self.points.next()?;
        Some(Point { index: position as u64, ..point })
    }

    fn done(&mut self, index: u64, row: Row) {
        if let Some(place) = usize::try_from(index).ok().and_then(|index| self.rows.get_mut(index)) {
            *place = Some(row);
        }
    }

    fn interrupted(&self) -> bool {
        (self.interrupted)()
    }
}
