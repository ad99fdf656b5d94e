//! Columns of result files and their cells.

use flap_core::parameter::{self, Parameter};

use crate::notation::text;

/// A column of a result file, as tables with types and units see it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name, with its unit for a measure.
    pub name: String,
    /// The unit in words; empty for what has none.
    pub unit: &'static str,
    /// The type of its cells. Any cell may be empty.
    pub kind: Kind,
    /// One line of meaning.
    pub doc: String,
}

/// The type of the cells of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Whole numbers from 0.
    Whole,
    /// Numbers.
    Number,
    /// `true` or `false`.
    Flag,
    /// Words.
    Text,
}

impl Column {
    pub(crate) fn new(name: &str, unit: &'static str, kind: Kind, doc: &str) -> Column {
        Column { name: name.to_owned(), unit, kind, doc: doc.to_owned() }
    }

    pub(crate) fn of_parameter(parameter: &Parameter) -> Column {
        let kind = match parameter.kind {
            parameter::Kind::Choice(_) => Kind::Text,
            parameter::Kind::Number(_) | parameter::Kind::Following(..) => Kind::Number,
        };
        Column::new(parameter.name, parameter.unit, kind, parameter.doc)
    }
}

/// The entry of a row in a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// A whole number.
    Whole(u64),
    /// A number; NaN if it is not known.
    Number(f64),
    /// True or false; `None` if it is not known.
    Flag(Option<bool>),
    /// A word.
    Text(&'static str),
}

impl Cell {
    pub(crate) fn of_parameter(parameter: &Parameter, value: f64) -> Cell {
        text::option(parameter, value).map_or(Cell::Number(value), Cell::Text)
    }
}
