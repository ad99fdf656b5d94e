//! What is drawn of a file.

use super::columns::Table;
use crate::args::{Aim, PictureKind};
use crate::failure::Failure;

/// Kind, columns and rows of a picture.
pub(super) struct Chosen {
    pub(super) kind: PictureKind,
    /// Column of the horizontal axis.
    pub(super) x: usize,
    /// Column of the vertical axis; of a trajectory, that of the time once more.
    pub(super) y: usize,
    /// One line for each value of this column.
    pub(super) by: Option<usize>,
    pub(super) color: Option<usize>,
    /// Which x and which y are better.
    pub(super) aims: (Aim, Aim),
    pub(super) rows: Vec<usize>,
    pub(super) title: String,
    /// Which slice it is.
    pub(super) notes: Vec<String>,
}

impl Chosen {
    /// There is no number to be drawn in `column`.
    pub(super) fn nothing(&self, table: &Table, column: usize) -> Failure {
        let (name, rows) = (&table.columns[column].name, self.rows.len());
        let message = format!("none of {rows} rows has a value of {name}: there is nothing to draw");
        Failure::usage(message)
            .help("points whose status is not `periodic` have no measures; `flap rerun` runs them again")
    }
}
