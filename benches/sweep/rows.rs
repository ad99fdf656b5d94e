//! Rows of a sweep, into a sink and out of a file.

use std::fs::File;
use std::io::Seek;

use flap_core::num::Backend;
use flap_core::simulate::{Point, Row, never, run_list};
use flap_sweep::files::results::{Format, Reader};
use flap_sweep::plan::Plan;
use flap_sweep::run::Sink;
use flap_sweep::table::layout::Layout;

/// Rows are written this often, so that there are more of them than it takes time to compute.
const COPIES: usize = 16;

/// The rows of all points of a plan.
pub(crate) struct Rows<'p> {
    layout: Layout<'p>,
    rows: Vec<(Point, Row)>,
}

impl<'p> Rows<'p> {
    /// Runs all points on this thread.
    pub(crate) fn of(plan: &'p Plan) -> Rows<'p> {
        let points: Vec<Point> = (0..plan.len()).map(|index| plan.point(index)).collect();
        let rows = run_list(plan.simulator(), Backend::best(), plan.solver(), points.clone(), &never);
        let rows = points.into_iter().zip(rows.expect("every point has a row")).collect();
        Rows { layout: Layout::of(plan), rows }
    }

    /// The number of rows that [`Rows::write`] writes.
    pub(crate) fn len(&self) -> u64 {
        (COPIES * self.rows.len()) as u64
    }

    /// Writes all of them, several times.
    pub(crate) fn write(&self, sink: &mut dyn Sink) {
        for _ in 0..COPIES {
            for (point, row) in &self.rows {
                sink.write(&self.layout.cells(point, row)).expect("room for a row");
            }
        }
        sink.flush().expect("room for rows");
    }
}

/// Reads a file from its beginning, and says how many of its cells are numbers.
pub(crate) fn read(mut file: &File) -> usize {
    file.rewind().expect("a file that can be read again");
    let mut reader = Reader::new(file.try_clone().expect("a file"), Format::Csv).expect("a header");
    let mut row = csv::StringRecord::new();
    let mut numbers = 0;
    while reader.next(&mut row).expect("a row") {
        numbers += row.iter().filter(|cell| cell.parse::<f64>().is_ok()).count();
    }
    numbers
}
