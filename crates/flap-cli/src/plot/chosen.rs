//! The choice of kind, columns and rows for a picture.

use crate::args::{Aim, PictureKind};
use crate::data::columns::Table;
use crate::failure::Failure;

/// Kind and columns of a picture.
pub(super) struct Columns {
    pub(super) kind: PictureKind,
    /// Column of the horizontal axis; of a tornado, the measure.
    pub(super) x: usize,
    /// Column of the vertical axis. A trajectory, a histogram and a tornado have that of `x` once more.
    pub(super) y: usize,
    /// Column with one line for each of its values.
    pub(super) by: Option<usize>,
    /// Column shown as colour.
    pub(super) color: Option<usize>,
}

impl Columns {
    /// Columns without lines and colours.
    pub(super) fn plain(kind: PictureKind, x: usize, y: usize) -> Columns {
        Columns { kind, x, y, by: None, color: None }
    }
}

/// All that a picture shows.
pub(super) struct Chosen {
    pub(super) columns: Columns,
    /// The better directions of x and y.
    pub(super) aims: (Aim, Aim),
    pub(super) rows: Vec<usize>,
    /// The columns of parameters, those of a sample first.
    pub(super) parameters: Vec<usize>,
    /// True if the designs are those of a sample.
    pub(super) sampled: bool,
    pub(super) title: String,
    /// Filters and slices in words.
    pub(super) notes: Vec<String>,
}

impl Chosen {
    /// The failure of a picture for which `column` has no number.
    pub(super) fn nothing(&self, table: &Table, column: usize) -> Failure {
        let (name, rows) = (&table.columns[column].name, self.rows.len());
        let message = format!("none of {rows} rows has a value of {name}: there is nothing to draw");
        Failure::usage(message).help(
            "points whose status is not `periodic` have no measures; `flap results rerun` runs them again",
        )
    }
}
