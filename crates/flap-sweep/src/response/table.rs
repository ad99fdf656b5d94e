//! Curves as rows of CSV.

use std::io;

use flap_core::parameter::Parameter;

use super::{Along, Curve, Step, parameter};
use crate::csv_sink::cause;
use crate::layout::Layout;
use crate::output::Durable;
use crate::plan::Plan;
use crate::text;

/// Writes one plain header line, then one line per motion: `curve`, the design's varied parameters, `branch`, the parameter
/// that rises and falls, and what follows it in the rows of a sweep.
pub struct Table<W: Durable> {
    layout: Layout,
    parameter: &'static Parameter,
    writer: csv::Writer<W>,
}

impl<W: Durable> Table<W> {
    /// Writes the header.
    ///
    /// # Errors
    /// What writing says.
    pub fn begin(plan: &Plan, along: &Along, target: W) -> io::Result<Table<W>> {
        let mut table = Table {
            layout: Layout::of(plan),
            parameter: parameter(plan, along),
            writer: csv::Writer::from_writer(target),
        };
        let mut names = table.layout.names();
        "curve".clone_into(&mut names[0]);
        let names = table.insert(names, ["branch".to_owned(), table.parameter.name.to_owned()]);
        table.writer.write_record(names).map_err(cause)?;
        Ok(table)
    }

    /// Writes the way up, by rising value, then the way down, by falling value, then the unstable orbits.
    ///
    /// # Errors
    /// What writing says.
    pub fn write(&mut self, curve: &Curve) -> io::Result<()> {
        let up = curve.up.iter().map(|step| ("up", step));
        let down = curve.down.iter().rev().map(|step| ("down", step));
        let unstable = curve.unstable.iter().map(|step| ("unstable", step));
        for (branch, Step { value, row }) in up.chain(down).chain(unstable) {
            let place = [branch.to_owned(), text::value(self.parameter, *value)];
            let cells = self.insert(self.layout.cells(&curve.design, row), place);
            self.writer.write_record(cells).map_err(cause)?;
        }
        self.writer.flush()
    }

    /// Makes what was written durable.
    ///
    /// # Errors
    /// What writing says.
    pub fn finish(mut self) -> io::Result<()> {
        self.writer.flush()?;
        self.writer.get_ref().sync()
    }

    /// Puts two cells behind those of the varied parameters.
    fn insert(&self, mut cells: Vec<String>, two: [String; 2]) -> Vec<String> {
        let behind = 1 + self.layout.varied.len();
        cells.splice(behind..behind, two);
        cells
    }
}
