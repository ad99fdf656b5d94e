//! The parameters that move a measure of a point most: `flap run --gradient`.

use std::fmt::Write as _;

use flap_core::simulate::{NoSlope, Row, Status};
use flap_sweep::study::strongest;

use super::point::Chosen;
use crate::failure::Failure;
use crate::table::{Table, six_digits};

/// Parameters that are listed.
const LISTED: usize = 10;

/// The parameters by which the measure `column` of a settled row changes most, as a table.
pub(crate) fn strongest(chosen: &Chosen, row: &Row, column: &str) -> Result<String, Failure> {
    let columns = chosen.simulator().columns();
    let Some(measure) = columns.iter().position(|known| known.name == column) else {
        let failure = Failure::usage(format!("--gradient: there is no measure `{column}`"));
        let names = columns.iter().map(|column| column.name.as_str());
        return Err(failure.nearest(column, names, "`flap params` lists the measures of a model"));
    };
    if row.status != Status::Periodic {
        let status = row.status.name();
        return Err(Failure::usage(format!(
            "--gradient: the motion is {status}: only periodic ones have derivatives"
        )));
    }
    let fixed = chosen.set_parameters();
    let slopes = strongest::slopes(&chosen.plan, chosen.simulator(), &chosen.run(), row, measure, fixed)?;
    let unit = columns[measure].unit;
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
    let mut page = format!(
        "{column} = {}. The largest changes per per cent of a parameter, in the unit of the measure and in % of it:\n\n",
        here.trim_end()
    );
    page += &table.text();
    for reason in NoSlope::ALL {
        let of_reason = slopes.unknown.iter().filter(|(_, other)| *other == reason);
        let names: Vec<&str> = of_reason.map(|(index, _)| chosen.plan.parameters()[*index].name).collect();
        if !names.is_empty() {
            let _ = writeln!(page, "not known ({}): {}", reason.name(), names.join(", "));
        }
    }
    Ok(page)
}
