//! The columns that do not depend on the model: the point, its status, and the course of its run.

use flap_core::simulate::{Point, Row};

use super::column::{Cell, Kind};

/// A column that does not depend on the model.
#[derive(Debug)]
pub(crate) struct Fixed {
    /// Its name.
    pub(crate) name: &'static str,
    pub(super) kind: Kind,
    pub(crate) doc: &'static str,
    pub(super) cell: fn(&Point, &Row) -> Cell<'static>,
}

/// The first column.
pub(crate) const POINT: Fixed = Fixed {
    name: "point",
    kind: Kind::Whole,
    doc: "index of the point in the grid, from 0",
    cell: |point, _| Cell::Whole(point.index),
};

/// The column before the measures.
pub(crate) const STATUS: Fixed = Fixed {
    name: "status",
    kind: Kind::Text,
    doc: "result of the search for an orbit, such as periodic or unsettled",
    cell: |_, row| Cell::Text(row.status.name()),
};

/// The name of the column of curves that is true where the ways up and down have different motions.
pub(crate) const BISTABLE: &str = "bistable";

/// True if measures cannot be called `name`: rows may have another column of that name.
pub(crate) fn is_fixed(name: &str) -> bool {
    name == BISTABLE || [&POINT, &STATUS].into_iter().chain(&RUN).any(|column| column.name == name)
}

/// The columns on the course of a run, behind the measures.
pub(crate) const RUN: [Fixed; 7] = [
    Fixed {
        name: "cycles",
        kind: Kind::Whole,
        doc: "drive periods integrated, those of the measurement included",
        cell: |_, row| Cell::Whole(row.cycles.into()),
    },
    Fixed {
        name: "residual",
        kind: Kind::Number,
        doc: "change of the state over the last period of the motion, in units of settle_tol",
        cell: |_, row| Cell::Number(row.residual),
    },
    Fixed {
        name: "period",
        kind: Kind::Whole,
        doc: "drive periods until the motion repeats; 0 if no orbit was found",
        cell: |_, row| Cell::Whole(row.period.into()),
    },
    Fixed {
        name: "floquet_max",
        kind: Kind::Number,
        doc: "factor by which a change of the motion grows or decays per orbit in the end: below 1 the motion is stable, near 1 it \
              settles slowly",
        cell: |_, row| Cell::Number(row.floquet_max),
    },
    Fixed {
        name: "stable",
        kind: Kind::Flag,
        doc: "true if motions near the orbit approach it",
        cell: |_, row| Cell::Flag(row.stable()),
    },
    Fixed {
        name: "error_estimate",
        kind: Kind::Number,
        doc: "estimated relative error of stroke, pitch, lift and power, the largest; inf if it cannot be estimated",
        cell: |_, row| Cell::Number(row.error_estimate),
    },
    Fixed {
        name: "rhs_evals",
        kind: Kind::Whole,
        doc: "evaluations of the equations of motion",
        cell: |_, row| Cell::Whole(row.rhs_evals),
    },
];

/// The first column of curves, in place of `point`.
pub(crate) const CURVE: Fixed = Fixed {
    name: "curve",
    kind: Kind::Whole,
    doc: "index of the design in the grid, from 0",
    cell: |point, _| Cell::Whole(point.index),
};
