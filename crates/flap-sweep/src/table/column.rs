//! Columns of result files and their cells.

use std::borrow::Cow;

use flap_core::parameter::{self, Parameter};

use crate::notation::text;

/// A column of a result file, as tables with types and units see it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name, with its unit for a measure.
    pub name: String,
    /// The unit in words; empty for what has none.
    pub unit: Cow<'static, str>,
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
    pub(crate) fn new(name: &str, unit: impl Into<Cow<'static, str>>, kind: Kind, doc: &str) -> Column {
        Column { name: name.to_owned(), unit: unit.into(), kind, doc: doc.to_owned() }
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
pub enum Cell<'t> {
    /// A whole number.
    Whole(u64),
    /// A number; NaN if it is not known.
    Number(f64),
    /// True or false; `None` if it is not known.
    Flag(Option<bool>),
    /// A word.
    Text(&'t str),
}

impl<'t> Cell<'t> {
    pub(crate) fn of_parameter(parameter: &Parameter, value: f64) -> Cell<'static> {
        text::option(parameter, value).map_or(Cell::Number(value), Cell::Text)
    }

    /// The cell of a column of this `kind` from its text in a result file; `None` if that does not belong there.
    pub fn parse(kind: Kind, text: &'t str) -> Option<Cell<'t>> {
        let is_unknown = text.is_empty();
        Some(match kind {
            Kind::Whole => Cell::Whole(text.parse().ok()?),
            Kind::Number => Cell::Number(if is_unknown { f64::NAN } else { text.parse().ok()? }),
            Kind::Flag => Cell::Flag(if is_unknown { None } else { Some(text.parse().ok()?) }),
            Kind::Text => Cell::Text(text),
        })
    }
}
