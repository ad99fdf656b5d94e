//! Lines of rows: those that a sweep of the same grid writes.

use std::time::Instant;

use flap_sweep::run::{self, RowWriter, Summary};
use serde::Serialize;

use super::desk::{Desk, failed};
use crate::request::{FamilyRequest, Refused};
use crate::rows::Rows;

/// The rows of a family, and the time that they took.
#[derive(Serialize)]
pub(crate) struct Family {
    #[serde(flatten)]
    rows: Rows,
    milliseconds: f64,
}

/// The rows of a family.
pub(crate) fn family(desk: &Desk<'_>, request: &FamilyRequest) -> Result<Family, Refused> {
    let begun = Instant::now();
    let FamilyRequest { design, x, by } = request;
    let plan = desk.opened.plan_of(&desk.opened.grid(design, Some(x), by.as_ref())?)?;
    let mut rows = Rows::of(&plan);
    let mut output =
        RowWriter::begin(&plan, Summary::default(), &mut rows).map_err(|error| failed(&error))?;
    let mut run = run::rows(&plan, &desk.options, 0);
    while let Some(batch) = run.next_batch().map_err(|error| failed(&error))? {
        desk.go_on()?;
        for row in &batch {
            output.write(row).map_err(|error| failed(&error))?;
        }
    }
    Ok(Family { rows, milliseconds: begun.elapsed().as_secs_f64() * 1e3 })
}
