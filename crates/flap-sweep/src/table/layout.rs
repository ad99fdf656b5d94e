//! The columns of a result file: which there are, in which order, and what they mean.

use flap_core::parameter::{self, Parameter};
use flap_core::simulate::{Point, Row};

use crate::notation::expression;
use crate::notation::text;
use crate::plan::Plan;

/// The columns of the rows of a plan:
/// `point`, the varied parameters, the derived ones, `status`, the measures, then `cycles`, `residual`, `period`,
/// `floquet_max`, `stable`, `error_estimate`, `rhs_evals`.
#[derive(Debug)]
pub struct Layout {
    /// The varied parameters, then the derived ones, each with its index in the model's parameter table.
    pub varied: Vec<(usize, &'static Parameter)>,
    /// The selected measures.
    pub measures: Vec<Measure>,
}

/// A measured column of a result file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Measure {
    /// Index in the measures of a row: the model's columns, then the plan's own.
    pub index: usize,
    /// Name with its unit.
    pub name: String,
    /// The unit in words.
    pub unit: &'static str,
    /// One line of meaning.
    pub doc: String,
    /// Whether it is a number, or true or false: then 1 stands for true and 0 for false.
    pub kind: expression::Kind,
}

impl Measure {
    /// The value in a row's measures; NaN if they are empty.
    pub fn value(&self, measures: &[f64]) -> f64 {
        measures.get(self.index).copied().unwrap_or(f64::NAN)
    }
}

/// A column of a result file, as tables with types and units see it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name, with its unit for a measure.
    pub name: String,
    /// The unit in words; empty for what has none.
    pub unit: &'static str,
    /// What its cells hold. Any cell may be empty.
    pub kind: Kind,
    /// One line of meaning.
    pub doc: String,
}

/// What the cells of a column hold.
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

/// What stands in a row under a column.
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

impl Layout {
    /// The columns that `plan` asks for.
    pub fn of(plan: &Plan) -> Layout {
        let parameters = plan.parameters();
        let varied = plan.differing().map(|index| (index, &parameters[index])).collect();
        let columns = plan.rows().columns();
        let models = columns.iter().map(|column| Measure {
            index: 0,
            name: column.name.clone(),
            unit: column.unit,
            doc: column.doc.clone(),
            kind: expression::Kind::Number,
        });
        let own = plan.measures().iter().map(|own| Measure {
            index: 0,
            name: own.name.clone(),
            unit: "",
            doc: "[measure] in the grid file".to_owned(),
            kind: own.kind(),
        });
        let all: Vec<Measure> =
            models.chain(own).enumerate().map(|(index, measure)| Measure { index, ..measure }).collect();
        let measures = match &plan.output().columns {
            Some(chosen) => chosen.iter().map(|&index| all[index].clone()).collect(),
            None => all,
        };
        Layout { varied, measures }
    }

    /// The columns, from left to right.
    pub fn columns(&self) -> Vec<Column> {
        let mut columns =
            vec![Column::new("point", "", Kind::Whole, "index of the point in the grid, from 0")];
        columns.extend(self.varied.iter().map(|(_, parameter)| Column::of_parameter(parameter)));
        columns.push(Column::new("status", "", Kind::Text, "what became of the point"));
        columns.extend(self.measures.iter().map(|measure| {
            let kind = match measure.kind {
                expression::Kind::Number => Kind::Number,
                expression::Kind::Condition => Kind::Flag,
            };
            Column::new(&measure.name, measure.unit, kind, &measure.doc)
        }));
        for (name, kind, doc) in [
            ("cycles", Kind::Whole, "drive periods integrated, the measured one included"),
            (
                "residual",
                Kind::Number,
                "change of the state over the last period of the motion, in units of settle_tol",
            ),
            ("period", Kind::Whole, "drive periods until the motion repeats; 0 if no orbit was found"),
            (
                "floquet_max",
                Kind::Number,
                "factor by which a change of the motion grows or decays per orbit in the end",
            ),
            ("stable", Kind::Flag, "whether motions near the orbit approach it"),
            (
                "error_estimate",
                Kind::Number,
                "estimated relative error of stroke, pitch, lift and power, the largest; inf if it cannot be estimated",
            ),
            ("rhs_evals", Kind::Whole, "evaluations of the equations of motion"),
        ] {
            columns.push(Column::new(name, "", kind, doc));
        }
        columns
    }

    /// The column names.
    pub fn names(&self) -> Vec<String> {
        self.columns().into_iter().map(|column| column.name).collect()
    }

    /// One cell per column. What is not known is empty: the measures of a point that is not periodic,
    /// the multiplier and stability of one without an orbit, and the residual of one that completed no period.
    pub fn cells(&self, point: &Point, row: &Row) -> Vec<Cell> {
        // Two cells before the measures and seven behind them, besides the parameters.
        let mut cells = Vec::with_capacity(9 + self.varied.len() + self.measures.len());
        cells.push(Cell::Whole(point.index));
        cells.extend(
            self.varied.iter().map(|&(index, parameter)| Cell::of_parameter(parameter, point.values[index])),
        );
        cells.push(Cell::Text(row.status.name()));
        cells.extend(self.measures.iter().map(|measure| {
            let value = measure.value(&row.measures);
            match measure.kind {
                expression::Kind::Number => Cell::Number(value),
                expression::Kind::Condition => Cell::Flag((!value.is_nan()).then_some(value != 0.0)),
            }
        }));
        cells.push(Cell::Whole(row.cycles.into()));
        cells.push(Cell::Number(row.residual));
        cells.push(Cell::Whole(row.period.into()));
        cells.push(Cell::Number(row.floquet_max));
        cells.push(Cell::Flag(row.stable()));
        cells.push(Cell::Number(row.error_estimate));
        cells.push(Cell::Whole(row.rhs_evals));
        cells
    }
}

/// Endings of names, each with its unit in words; of two that fit, the longer one comes first.
const ENDINGS: [(&str, &str); 29] = [
    ("_gf_per_w", "gf/W"),
    ("_deg_per_v", "deg/V"),
    ("_v_per_um", "V/um"),
    ("_rad_s", "rad/s"),
    ("_m_s", "m/s"),
    ("_1_s", "1/s"),
    ("_mgf", "mgf"),
    ("_deg", "deg"),
    ("_rad", "rad"),
    ("_khz", "kHz"),
    ("_hz", "Hz"),
    ("_gf", "gf"),
    ("_mn", "mN"),
    ("_un", "uN"),
    ("_mw", "mW"),
    ("_uw", "uW"),
    ("_ma", "mA"),
    ("_ua", "uA"),
    ("_mm", "mm"),
    ("_um", "um"),
    ("_mg", "mg"),
    ("_kg", "kg"),
    ("_ms", "ms"),
    ("_us", "us"),
    ("_mj", "mJ"),
    ("_uj", "uJ"),
    ("_v", "V"),
    ("_s", "s"),
    ("_m", "m"),
];

/// A column's name without the unit that it ends in, and that unit; empty if there is none.
///
/// ```
/// assert_eq!(flap_sweep::table::layout::split_unit("lift_mean_mn"), ("lift_mean", "mN"));
/// assert_eq!(flap_sweep::table::layout::split_unit("status"), ("status", ""));
/// ```
pub fn split_unit(name: &str) -> (&str, &'static str) {
    let split = ENDINGS.iter().find_map(|(ending, unit)| Some((name.strip_suffix(ending)?, *unit)));
    split.unwrap_or((name, ""))
}
