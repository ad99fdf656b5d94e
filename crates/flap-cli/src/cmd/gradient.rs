//! The parameters that move a measure of a point most: `flap run --gradient`.

use std::fmt::Write as _;

use flap_core::parameter::{Kind, Range};
use flap_core::simulate::{Change, NoSlope, Row, Status};

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
    let parameters = changing(chosen);
    let changes = parameters.iter().map(|&index| Change {
        ahead: chosen.changed(index, Change::SHARE),
        behind: chosen.changed(index, -Change::SHARE),
        size: Change::SHARE,
    });
    let changes: Vec<Change> = changes.collect();
    let gradient = chosen.simulator().motions()?.gradient(&chosen.run(), &row.state, &changes)?;
    let slopes = parameters.iter().zip(&gradient.slopes).map(|(&index, slopes)| (index, slopes[measure]));
    let (mut known, unknown): (Vec<_>, Vec<_>) = slopes.partition(|(_, slope)| slope.is_ok());
    let size = |slope: &Result<f64, NoSlope>| slope.map_or(0.0, f64::abs);
    known.sort_by(|(_, one), (_, other)| size(other).total_cmp(&size(one)));
    let unit = columns[measure].unit;
    let value = row.measures[measure];
    let mut table = Table::with_headings(&["parameter", "value", "unit", "change per %", "% per %"]);
    for (index, slope) in known.iter().take(LISTED) {
        let (parameter, slope) = (&chosen.plan.parameters()[*index], slope.unwrap_or(f64::NAN));
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
        let of_reason = unknown.iter().filter(|(_, slope)| slope == &Err(reason));
        let names: Vec<&str> = of_reason.map(|(index, _)| chosen.plan.parameters()[*index].name).collect();
        if !names.is_empty() {
            let _ = writeln!(page, "not known ({}): {}", reason.name(), names.join(", "));
        }
    }
    Ok(page)
}

/// The parameters with a share that can change: numbers that are set, and neither zero, whole nor derived.
fn changing(chosen: &Chosen) -> Vec<usize> {
    let parameters = chosen.plan.parameters().iter().enumerate();
    let changing = parameters.filter(|(index, parameter)| {
        let value = chosen.values[*index];
        let has_shares = match parameter.kind {
            Kind::Choice(_) | Kind::Number(Range::Whole(..)) => false,
            Kind::Number(_) | Kind::Following(..) => value.is_finite() && value != 0.0,
        };
        has_shares && !chosen.plan.derived().parameters().any(|derived| derived == *index)
    });
    changing.map(|(index, _)| index).collect()
}
