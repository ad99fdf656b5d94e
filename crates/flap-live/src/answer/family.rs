//! Rows for a family of lines in a chart. The rows equal the rows that `flap sweep` computes for the grid
//! file of the chart.

use flap_sweep::run::{self, RowWriter, Summary};

use super::context::AnswerContext;
use crate::request::{FamilyRequest, Refused};
use crate::rows::Rows;

/// Computes the rows for a family of lines in a chart.
pub(crate) fn family(context: &AnswerContext<'_>, request: &FamilyRequest) -> Result<Rows, Refused> {
    let FamilyRequest { design, x, by } = request;
    let plan = context.opened.plan_of(&context.opened.grid(design, Some(x), by.as_ref())?)?;
    let mut rows = Rows::of(&plan);
    let mut output = RowWriter::begin(&plan, Summary::default(), &mut rows)?;
    let mut run = run::rows(&plan, &context.options, 0);
    while let Some(batch) = run.next_batch()? {
        context.check_wanted()?;
        for row in &batch {
            output.write(row)?;
        }
    }
    Ok(rows)
}
