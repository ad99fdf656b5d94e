//! The columns of a result file: which there are, in which order, and what they mean.

use flap_core::parameter::{self, Parameter};
use flap_core::simulate::{Point, Row};

use crate::expression;
use crate::plan::Plan;
use crate::text;

/// The columns of the rows of a plan:
/// `point`, the varied parameters, the derived ones, `status`, the measures, then `cycles`, `residual`, `period`,
/// `floquet_max`, `stable`, `rhs_evals`.
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
    fn new(name: &str, unit: &'static str, kind: Kind) -> Column {
        Column { name: name.to_owned(), unit, kind }
    }
}

impl Layout {
    /// The columns that `plan` asks for.
    pub fn of(plan: &Plan) -> Layout {
        let parameters = plan.parameters();
        let varied =
            plan.varied().chain(plan.derived.parameters()).map(|index| (index, &parameters[index])).collect();
        let columns = plan.rows().columns();
        let models =
            columns.iter().map(|column| (column.name.clone(), column.unit, expression::Kind::Number));
        let own = plan.measures.iter().map(|own| (own.name.clone(), "", own.kind()));
        let all: Vec<Measure> = (models.chain(own).enumerate())
            .map(|(index, (name, unit, kind))| Measure { index, name, unit, kind })
            .collect();
        let measures = match &plan.output.columns {
            Some(chosen) => chosen.iter().map(|&index| all[index].clone()).collect(),
            None => all,
        };
        Layout { varied, measures }
    }

    /// The columns, from left to right.
    pub fn columns(&self) -> Vec<Column> {
        let mut columns = vec![Column::new("point", "", Kind::Whole)];
        columns.extend(self.varied.iter().map(|(_, parameter)| {
            let kind = match parameter.kind {
                parameter::Kind::Choice(_) => Kind::Text,
                parameter::Kind::Number(_) | parameter::Kind::Following(..) => Kind::Number,
            };
            Column::new(parameter.name, parameter.unit, kind)
        }));
        columns.push(Column::new("status", "", Kind::Text));
        columns.extend(self.measures.iter().map(|measure| {
            let kind = match measure.kind {
                expression::Kind::Number => Kind::Number,
                expression::Kind::Condition => Kind::Flag,
            };
            Column::new(&measure.name, measure.unit, kind)
        }));
        columns.push(Column::new("cycles", "", Kind::Whole));
        columns.push(Column::new("residual", "", Kind::Number));
        columns.push(Column::new("period", "", Kind::Whole));
        columns.push(Column::new("floquet_max", "", Kind::Number));
        columns.push(Column::new("stable", "", Kind::Flag));
        columns.push(Column::new("rhs_evals", "", Kind::Whole));
        columns
    }

    /// The column names.
    pub fn names(&self) -> Vec<String> {
        self.columns().into_iter().map(|column| column.name).collect()
    }

    /// One text per column. What is not known is empty: the measures of a point that is not periodic,
    /// the multiplier and stability of one without an orbit, and the residual of one that completed no period.
    pub fn cells(&self, point: &Point, row: &Row) -> Vec<String> {
        let mut cells = vec![point.index.to_string()];
        cells.extend(
            self.varied.iter().map(|&(index, parameter)| text::value(parameter, point.values[index])),
        );
        cells.push(row.status.name().to_owned());
        cells.extend(self.measures.iter().map(|measure| {
            let value = measure.value(&row.measures);
            match measure.kind {
                expression::Kind::Number => text::float(value),
                expression::Kind::Condition => text::truth(value),
            }
        }));
        cells.push(row.cycles.to_string());
        cells.push(text::float(row.residual));
        cells.push(row.period.to_string());
        cells.push(text::float(row.floquet_max));
        cells.push(row.stable().map_or_else(String::new, |stable| stable.to_string()));
        cells.push(row.rhs_evals.to_string());
        cells
    }
}
