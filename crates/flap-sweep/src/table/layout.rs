//! Defines the columns of a result file: their order, their descriptions and their cells. This module also
//! contains the columns that all models have.

use std::borrow::Cow;
use std::sync::LazyLock;

use flap_core::parameter::{self, Parameter};
use flap_core::simulate::{NoSlope, Point, Row};

use super::labels::split_unit;
use crate::derivative::{self, column_name, meaning, reasons_of};
use crate::notation::{expression, text};
use crate::plan::Plan;

/// Columns of the result file of a plan.
///
/// The columns are `point`, the varied parameters, the derived parameters, `status`, the measures, and then
/// `cycles`, `residual`, `period`, `floquet_max`, `stable`, `error_estimate`, `rhs_evals`. A plan may select
/// only some of the columns after `status`.
///
/// Rows of response curves begin with the column `curve` instead of `point`. In rows of response curves, the
/// column `branch` and the parameter that varies along the curve come before `status`. The column `bistable`
/// comes after `status`.
#[derive(Debug)]
pub struct Layout<'p> {
    /// Varied parameters, then derived parameters, each with its index in the model's parameter table.
    pub varied: Vec<(usize, &'p Parameter<'p>)>,
    /// Parameter along which the plan computes response curves; `None` if the plan has no response curves.
    pub followed: Option<&'p Parameter<'p>>,
    /// Columns, from left to right.
    entries: Vec<Entry<'p>>,
}

/// Position of a motion on a response curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Branch.
    pub branch: &'static str,
    /// Value of the parameter that varies along the response curve.
    pub value: f64,
    /// True if the motions of the branches `up` and `down` differ at this value of the parameter.
    ///
    /// The value is `None` for unstable orbits, and if neither `up` nor `down` has a motion that is periodic
    /// with the drive.
    pub bistable: Option<bool>,
}

/// A measured column of a result file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Measure {
    /// Index of the measure in the list of a row's measures. The list contains the measures of the model,
    /// then the measures of the plan, then the derivatives.
    pub index: usize,
    /// Description of the column. In the list of a row's measures, 1 means true and 0 means false.
    pub column: Column,
}

impl Measure {
    /// Returns the value of this measure. `measures` is the list of a row's measures. Returns NaN if the row
    /// has no measures.
    pub fn value(&self, measures: &[f64]) -> f64 {
        measures.get(self.index).copied().unwrap_or(f64::NAN)
    }

    /// Returns the cell of this measure. `measures` is the list of a row's measures.
    pub(crate) fn cell(&self, measures: &[f64]) -> Cell<'static> {
        let value = self.value(measures);
        match self.column.kind {
            CellKind::Flag => Cell::Flag((!value.is_nan()).then_some(value != 0.0)),
            CellKind::Text => Cell::Text(gap(value)),
            CellKind::Number | CellKind::Whole => Cell::Number(value),
        }
    }
}

impl<'p> Layout<'p> {
    /// Returns the columns of the result file of `plan`.
    pub fn of(plan: &'p Plan) -> Layout<'p> {
        let parameters = plan.parameters();
        let varied: Vec<_> = plan.differing().map(|index| (index, &parameters[index])).collect();
        let columns = plan.rows().columns();
        let models = columns
            .iter()
            .map(|column| Column::new(&column.name, column.unit, CellKind::Number, &column.doc));
        let own = plan.measures().iter().map(|own| {
            let kind = if own.kind() == expression::Kind::Number { CellKind::Number } else { CellKind::Flag };
            Column::new(&own.name, "", kind, "measure of the table [measure] in the grid file")
        });
        let measures = models.chain(own).enumerate();
        let measures = measures.map(|(index, column)| Entry::Measure(Measure { index, column }));
        let measures: Vec<Entry<'p>> = measures.collect();
        let derivatives = derivatives(plan, measures.len());
        let run = RUN.iter().map(Entry::Fixed);
        let followed = plan.followed().map(|along| &parameters[along.parameter]);
        let mut entries = vec![Entry::Fixed(if followed.is_some() { &CURVE } else { &POINT })];
        entries.extend(varied.iter().map(|&(index, parameter)| Entry::Parameter(index, parameter)));
        entries
            .extend(followed.into_iter().flat_map(|parameter| [Entry::Branch, Entry::Followed(parameter)]));
        entries.push(Entry::Fixed(&STATUS));
        entries.extend(followed.map(|_| Entry::Bistable));
        match &plan.output().columns {
            Some(chosen) => {
                let all: Vec<Entry<'p>> = measures.into_iter().chain(run).collect();
                entries.extend(chosen.iter().map(|&index| all[index].clone()).chain(derivatives));
            }
            None => entries.extend(measures.into_iter().chain(derivatives).chain(run)),
        }
        entries.extend(plan.states().iter().enumerate().map(|(place, name)| Entry::State(place, name)));
        Layout { varied, followed, entries }
    }

    /// Returns the selected measures.
    pub fn measures(&self) -> impl Iterator<Item = &Measure> {
        self.entries.iter().filter_map(|entry| match entry {
            Entry::Measure(measure) => Some(measure),
            _ => None,
        })
    }

    /// Returns true if rows have a column with the given name.
    pub fn has(&self, name: &str) -> bool {
        self.entries.iter().any(|entry| entry.column().name == name)
    }

    /// Returns the columns, from left to right.
    pub fn columns(&self) -> Vec<Column> {
        self.entries.iter().map(Entry::column).collect()
    }

    /// Returns the column names.
    pub fn names(&self) -> Vec<String> {
        self.columns().into_iter().map(|column| column.name).collect()
    }

    /// Returns one cell per column. Unknown values are empty cells.
    ///
    /// The measures are unknown if the motion of the point is not periodic. The residual is unknown if no
    /// period of the motion was completed. If no orbit was found, the Floquet multiplier and the stability
    /// are unknown too.
    pub fn cells(&self, point: &Point, row: &Row) -> Vec<Cell<'p>> {
        self.cells_at(point, None, row)
    }

    /// Returns the cells of a motion on a response curve of the design `point`. `place` is the position of
    /// the motion on the curve. Unknown values are empty cells, as in [`Layout::cells`].
    pub fn cells_at(&self, point: &Point, place: Option<Place>, row: &Row) -> Vec<Cell<'p>> {
        self.entries.iter().map(|entry| entry.cell(point, place, row)).collect()
    }
}

/// Returns the columns of derivatives. `before` is the number of measures before the derivatives in the list
/// of a row's measures.
fn derivatives(plan: &Plan, before: usize) -> Vec<Entry<'_>> {
    let Some(gradient) = plan.gradient() else { return Vec::new() };
    let models = plan.rows().columns();
    let name = |of: usize| match of.checked_sub(models.len()) {
        None => (models[of].name.as_str(), models[of].unit),
        Some(place) => (plan.measures()[place].name.as_str(), ""),
    };
    let columns = gradient.pairs().map(|(of, by)| {
        let ((of, unit), by) = (name(of), &plan.parameters()[by]);
        let doc = meaning(of, unit, by.name, gradient.per);
        let per = derivative::unit(unit, by.unit, gradient.per);
        Column::new(&column_name(of, by.name, gradient.per), per, CellKind::Number, &doc)
    });
    let columns = columns.chain([gradient_gap()]).enumerate();
    columns.map(|(place, column)| Entry::Measure(Measure { index: before + place, column })).collect()
}

/// Returns the column `gradient_gap`, which contains the reasons why derivatives of a row are missing.
fn gradient_gap() -> Column {
    let doc =
        "reasons for missing derivatives of the row, such as edge;zero; empty if no derivative is missing";
    Column::new("gradient_gap", "", CellKind::Text, doc)
}

/// Returns the column `branch`, which contains the branch of a response curve.
fn branch() -> Column {
    Column::new(
        "branch",
        "",
        CellKind::Text,
        "branch of the motion: up (rising parameter), down (falling parameter), or unstable (orbits between both branches)",
    )
}

/// Returns the column `bistable`, which is true where a response curve has two different stable motions.
fn bistable() -> Column {
    let doc = "true if the motions of the branches up and down differ at the same value of the parameter; empty if neither motion is periodic";
    Column::new(BISTABLE, "", CellKind::Flag, doc)
}

/// Converts the number that encodes the reasons for missing derivatives into words, such as `edge;zero`: see
/// [`reasons_of`].
fn gap(code: f64) -> &'static str {
    static TEXTS: LazyLock<Vec<String>> = LazyLock::new(|| {
        let words = |code| reasons_of(f64::from(code)).map(NoSlope::name).collect::<Vec<_>>().join(";");
        (0..1_u32 << NoSlope::ALL.len()).map(words).collect()
    });
    TEXTS.iter().zip(0_u32..).find(|(_, other)| f64::from(*other) == code).map_or("", |(text, _)| text)
}

/// Returns the columns that rows of every model have: index, status, and columns about the computation of the
/// row.
pub fn fixed_columns() -> Vec<Column> {
    let fixed = [&POINT, &CURVE, &STATUS].into_iter().chain(&RUN);
    fixed.map(|fixed| Column::new(fixed.name, "", fixed.kind, fixed.doc)).collect()
}

/// Returns the columns that the rows of some plans have: `branch` and `bistable` for response curves, and
/// `gradient_gap` for derivatives.
pub fn special_columns() -> [Column; 3] {
    [branch(), bistable(), gradient_gap()]
}

/// A column of a result file, and the source of the values in its cells.
#[derive(Clone, Debug)]
enum Entry<'p> {
    Fixed(&'static Fixed),
    /// A varied or derived parameter, with its index in the model's parameter table.
    Parameter(usize, &'p Parameter<'p>),
    /// Branch of a response curve.
    Branch,
    /// Parameter along which response curves are computed.
    Followed(&'p Parameter<'p>),
    /// Column that is true where a response curve has two different stable motions.
    Bistable,
    Measure(Measure),
    /// A component of the state at the beginning of the motion's period, with the index of the component.
    State(usize, &'p str),
}

impl<'p> Entry<'p> {
    fn column(&self) -> Column {
        match self {
            Entry::Fixed(Fixed { name, kind, doc, .. }) => Column::new(name, "", *kind, doc),
            Entry::Parameter(_, parameter) | Entry::Followed(parameter) => Column::of_parameter(parameter),
            Entry::Branch => branch(),
            Entry::Bistable => bistable(),
            Entry::Measure(measure) => measure.column.clone(),
            Entry::State(_, name) => {
                let doc = "state of the equations of motion at the beginning of a drive period";
                Column::new(name, split_unit(name).1, CellKind::Number, doc)
            }
        }
    }

    fn cell(&self, point: &Point, place: Option<Place>, row: &Row) -> Cell<'p> {
        match self {
            Entry::Fixed(fixed) => (fixed.cell)(point, row),
            Entry::Parameter(index, parameter) => Cell::of_parameter(parameter, point.values[*index]),
            Entry::Branch => Cell::Text(place.map_or("", |place| place.branch)),
            Entry::Followed(_) => Cell::Number(place.map_or(f64::NAN, |place| place.value)),
            Entry::Bistable => Cell::Flag(place.and_then(|place| place.bistable)),
            Entry::State(place, _) => Cell::Number(row.state.get(*place).copied().unwrap_or(f64::NAN)),
            Entry::Measure(measure) => measure.cell(&row.measures),
        }
    }
}

/// Description of a column of a result file: its name, its unit, its type and its meaning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name of the column. The name of a measure includes its unit, as in `lift_mean_mn`.
    pub name: String,
    /// Unit as text; empty for a column without a unit.
    pub unit: Cow<'static, str>,
    /// Type of the cells of the column. Any cell may be empty.
    pub kind: CellKind,
    /// Description of the column in one line.
    pub doc: String,
}

/// Type of the cells of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellKind {
    /// Cells with whole numbers, 0 or more.
    Whole,
    /// Numbers.
    Number,
    /// `true` or `false`.
    Flag,
    /// Words.
    Text,
}

impl Column {
    pub(crate) fn new(name: &str, unit: impl Into<Cow<'static, str>>, kind: CellKind, doc: &str) -> Column {
        Column { name: name.to_owned(), unit: unit.into(), kind, doc: doc.to_owned() }
    }

    pub(crate) fn of_parameter(parameter: &Parameter) -> Column {
        let kind = match parameter.kind {
            parameter::Kind::Choice(_) => CellKind::Text,
            parameter::Kind::Number(_) | parameter::Kind::Following(..) => CellKind::Number,
        };
        Column::new(parameter.name, parameter.unit, kind, parameter.doc)
    }
}

/// One cell of a result file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell<'t> {
    /// A whole number.
    Whole(u64),
    /// A number; NaN if unknown.
    Number(f64),
    /// True or false; `None` if unknown.
    Flag(Option<bool>),
    /// A word.
    Text(&'t str),
}

impl<'t> Cell<'t> {
    pub(crate) fn of_parameter(parameter: &Parameter<'t>, value: f64) -> Cell<'t> {
        text::option(parameter, value).map_or(Cell::Number(value), Cell::Text)
    }

    /// Converts the text of a cell in a result file into a cell of the type `kind`. Returns `None` if the
    /// text does not match the type.
    pub fn parse(kind: CellKind, text: &'t str) -> Option<Cell<'t>> {
        let is_unknown = text.is_empty();
        Some(match kind {
            CellKind::Whole => Cell::Whole(text.parse().ok()?),
            CellKind::Number => Cell::Number(if is_unknown { f64::NAN } else { text.parse().ok()? }),
            CellKind::Flag => Cell::Flag(if is_unknown { None } else { Some(text.parse().ok()?) }),
            CellKind::Text => Cell::Text(text),
        })
    }
}

/// A column that does not depend on the model.
#[derive(Debug)]
pub(crate) struct Fixed {
    /// Name of the column.
    pub(crate) name: &'static str,
    pub(super) kind: CellKind,
    pub(crate) doc: &'static str,
    pub(super) cell: fn(&Point, &Row) -> Cell<'static>,
}

/// First column.
pub(crate) const POINT: Fixed = Fixed {
    name: "point",
    kind: CellKind::Whole,
    doc: "index of the point in the grid, counted from 0",
    cell: |point, _| Cell::Whole(point.index),
};

/// First column of the rows of response curves, instead of the column `point`.
pub(crate) const CURVE: Fixed = Fixed {
    name: "curve",
    kind: CellKind::Whole,
    doc: "index of the design in the grid, counted from 0",
    cell: |point, _| Cell::Whole(point.index),
};

/// Column before the measures.
pub(crate) const STATUS: Fixed = Fixed {
    name: "status",
    kind: CellKind::Text,
    doc: "result of the search for an orbit (a periodic motion), such as periodic or unsettled",
    cell: |_, row| Cell::Text(row.status.name()),
};

/// Name of the column that is true where the branches `up` and `down` of a response curve have different
/// motions.
pub(crate) const BISTABLE: &str = "bistable";

/// Returns true if a measure must not have the name `name`, because rows may have a column of flap with this
/// name.
pub(crate) fn is_fixed(name: &str) -> bool {
    name == BISTABLE || [&POINT, &STATUS].into_iter().chain(&RUN).any(|column| column.name == name)
}

/// Columns about the computation of a row, such as `cycles`, which come after the measures.
pub(crate) const RUN: [Fixed; 7] = [
    Fixed {
        name: "cycles",
        kind: CellKind::Whole,
        doc: "number of drive periods that were integrated, including the periods of the measurement",
        cell: |_, row| Cell::Whole(row.cycles.into()),
    },
    Fixed {
        name: "residual",
        kind: CellKind::Number,
        doc: "change of the state over the last period of the motion, relative to the typical size of each state",
        cell: |_, row| Cell::Number(row.residual),
    },
    Fixed {
        name: "period",
        kind: CellKind::Whole,
        doc: "number of drive periods after which the motion repeats; 0 if no orbit was found",
        cell: |_, row| Cell::Whole(row.period.into()),
    },
    Fixed {
        name: "floquet_max",
        kind: CellKind::Number,
        doc: "factor by which a small change of the motion grows or decays per orbit (largest Floquet multiplier): below 1 the \
              motion is stable, near 1 the motion settles slowly",
        cell: |_, row| Cell::Number(row.floquet_max),
    },
    Fixed {
        name: "stable",
        kind: CellKind::Flag,
        doc: "true if the motion returns to the orbit after a small disturbance",
        cell: |_, row| Cell::Flag(row.stable()),
    },
    Fixed {
        name: "error_estimate",
        kind: CellKind::Number,
        doc: "estimated numerical error: the largest relative error of stroke, pitch, lift and power, without the errors of \
              the model; inf if flap cannot estimate the error",
        cell: |_, row| Cell::Number(row.error_estimate),
    },
    Fixed {
        name: "rhs_evals",
        kind: CellKind::Whole,
        doc: "number of evaluations of the equations of motion",
        cell: |_, row| Cell::Whole(row.rhs_evals),
    },
];
