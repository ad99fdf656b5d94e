//! Curves as rows of a table.

use std::io;

use flap_core::parameter::Parameter;

use super::{Along, Curve, Step, parameter};
use crate::files::disk::Durable;
use crate::plan::Plan;
use crate::table::layout::{Cell, Column, Kind, Layout};
use crate::table::lines::Lines;

/// What a row per motion holds: `curve`, the design's varied parameters, `branch`, the parameter that rises and falls, and
/// what follows it in the rows of a sweep.
pub struct Motions {
    layout: Layout,
    parameter: &'static Parameter,
}

impl Motions {
    /// The columns for the curves of `plan`.
    pub fn of(plan: &Plan, along: &Along) -> Motions {
        Motions { layout: Layout::of(plan), parameter: parameter(plan, along) }
    }

    /// The columns, from left to right.
    pub fn columns(&self) -> Vec<Column> {
        let mut columns = self.layout.columns();
        columns[0] = Column::new("curve", "", Kind::Whole, "index of the design in the grid, from 0");
        let branch = "the way that the motion is on: up, down, or unstable between the two";
        let two = [Column::new("branch", "", Kind::Text, branch), Column::of_parameter(self.parameter)];
        self.insert(columns, two)
    }

    /// The way up, by rising value, then the way down, by falling value, then the unstable orbits.
    pub fn rows(&self, curve: &Curve) -> impl Iterator<Item = Vec<Cell>> {
        let up = curve.up.iter().map(|step| ("up", step));
        let down = curve.down.iter().rev().map(|step| ("down", step));
        let unstable = curve.unstable.iter().map(|step| ("unstable", step));
        up.chain(down).chain(unstable).map(|(branch, Step { value, row })| {
            let place = [Cell::Text(branch), Cell::Number(*value)];
            self.insert(self.layout.cells(&curve.design, row), place)
        })
    }

    /// Puts two cells behind those of the varied parameters.
    fn insert<T>(&self, mut cells: Vec<T>, two: [T; 2]) -> Vec<T> {
        let behind = 1 + self.layout.varied.len();
        cells.splice(behind..behind, two);
        cells
    }
}

/// Writes one plain header line, then one line per motion.
pub struct Table<W: Durable> {
    motions: Motions,
    lines: Lines<W>,
}

impl<W: Durable> Table<W> {
    /// Writes the header.
    ///
    /// # Errors
    /// What writing says.
    pub fn begin(plan: &Plan, along: &Along, target: W) -> io::Result<Table<W>> {
        let mut table = Table { motions: Motions::of(plan, along), lines: Lines::new(target) };
        let columns = table.motions.columns();
        table.lines.texts(columns.iter().map(|column| &column.name))?;
        Ok(table)
    }

    /// Writes the rows of a curve.
    ///
    /// # Errors
    /// What writing says.
    pub fn write(&mut self, curve: &Curve) -> io::Result<()> {
        for cells in self.motions.rows(curve) {
            self.lines.cells(&cells)?;
        }
        self.lines.flush()
    }

    /// Makes what was written durable.
    ///
    /// # Errors
    /// What writing says.
    pub fn finish(mut self) -> io::Result<()> {
        self.lines.flush()?;
        self.lines.target().sync()
    }
}
