//! The parameters that move a measure of a point most: `flap run --gradient`.

use std::fmt::Write as _;

use flap_core::simulate::{Column, NoSlope, Row, Status};
use flap_sweep::study::strongest;

use super::params::wrapped;
use super::point::Chosen;
use crate::console;
use crate::failure::Failure;
use crate::table::{Table, six_digits};

/// Parameters that are listed.
const LISTED: usize = 10;

/// The place of the measure called `column`.
pub(crate) fn measure(chosen: &Chosen, column: &str) -> Result<usize, Failure> {
    let names = || chosen.simulator().columns().iter().map(|column| column.name.as_str());
    names().position(|name| name == column).ok_or_else(|| {
        let failure = Failure::usage(format!("--gradient: there is no measure `{column}`"));
        failure.nearest(column, names(), "`flap params` lists the measures of a model")
    })
}

/// The parameters by which a measure of a settled row changes most, as a table.
pub(crate) fn strongest(chosen: &Chosen, row: &Row, measure: usize) -> Result<String, Failure> {
    let Column { name: column, unit, .. } = &chosen.simulator().columns()[measure];
    if row.status != Status::Periodic {
        let status = row.status.name();
        return Err(Failure::usage(format!(
            "--gradient: the motion is {status}: only periodic ones have derivatives"
        )));
    }
    let fixed = chosen.set_parameters();
    let slopes = strongest::slopes(&chosen.plan, chosen.simulator(), &chosen.run(), row, measure, fixed)?;
    let value = row.measures[measure];
    let mut table = Table::with_headings(&["parameter", "value", "unit", "change per %", "% per %"]);
    for (index, slope) in slopes.known.iter().take(LISTED) {
        let parameter = &chosen.plan.parameters()[*index];
        table.row([
            parameter.name.to_owned(),
            six_digits(chosen.values[*index]),
            parameter.unit.to_owned(),
            six_digits(0.01 * slope),
            six_digits(slope / value.abs()),
        ]);
    }
    let here = format!("{} {unit}", six_digits(value));
    let head = format!(
        "{column} = {}. The largest changes per 1 % of a parameter, in the unit of the measure and in % of it:",
        here.trim_end()
    );
    let mut page = wrapped(&head, 0) + "\n\n";
    page += &table.text_within(console::width());
    for reason in NoSlope::ALL {
        let of_reason = slopes.unknown.iter().filter(|(_, other)| *other == reason);
        let names: Vec<&str> = of_reason.map(|(index, _)| chosen.plan.parameters()[*index].name).collect();
        if !names.is_empty() {
            let line = format!("not known ({}): {}", reason.name(), names.join(", "));
            let _ = writeln!(page, "{}", wrapped(&line, 2));
        }
    }
    Ok(page)
}
