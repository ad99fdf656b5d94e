//! `flap run --gradient`: the parameters with the largest effects on a measure of a design point.

use std::fmt::Write as _;

use flap_core::simulate::{Column, NoSlope, Row, Status};
use flap_sweep::notation::text;
use flap_sweep::resonance::DRIVE_FREQUENCY;
use flap_sweep::study::strongest::{self, Slopes};

use super::point::Chosen;
use crate::args::OutputFormat;
use crate::console;
use crate::failure::Failure;
use crate::print;
use crate::table::{Table, six_digits, wrapped};

/// Number of parameters that flap prints in the table.
const LISTED: usize = 10;

/// Returns the index of the measure called `column`, or an error if the point has no such measure.
pub(super) fn measure(chosen: &Chosen, column: &str) -> Result<usize, Failure> {
    let names = || chosen.columns().iter().map(|column| column.name.as_str());
    names().position(|name| name == column).ok_or_else(|| {
        let failure = Failure::usage(format!("--gradient: there is no measure `{column}`"));
        failure.nearest(column, names(), "`flap models MODEL` lists the measures of a model")
    })
}

/// Columns of the derivatives in csv and json.
const NAMES: [&str; 5] = ["parameter", "value", "unit", "change_per_pct", "reason"];

/// The derivatives of a measure with respect to all parameters.
pub(super) struct Gradient<'c> {
    column: &'c Column,
    /// Value of the measure at the design point.
    value: f64,
    slopes: Slopes,
    chosen: &'c Chosen,
}

impl<'c> Gradient<'c> {
    /// Computes the derivatives of a measure of `row`. Returns an error if the motion is not periodic.
    pub(super) fn of(chosen: &'c Chosen, row: &Row, measure: usize) -> Result<Gradient<'c>, Failure> {
        if row.status != Status::Periodic {
            let status = row.status.name();
            return Err(Failure::usage(format!(
                "--gradient: the motion is {status}, and only periodic motions have derivatives"
            )));
        }
        if chosen.has_found_resonance() {
            console::say(&format!("--gradient: the derivatives are at fixed {DRIVE_FREQUENCY}"));
        }
        let fixed = chosen.set_parameters();
        let slopes = strongest::slopes(&chosen.plan, chosen.simulator(), &chosen.run(), row, measure, fixed)?;
        let column = &chosen.columns()[measure];
        Ok(Gradient { column, value: row.measures[measure], slopes, chosen })
    }

    /// Prints all derivatives with all digits.
    pub(super) fn print(&self, format: OutputFormat) -> Result<(), Failure> {
        let cells = |index: usize, slope: String, reason: &str| {
            let parameter = &self.chosen.plan.parameters()[index];
            let value = text::value(parameter, self.chosen.values[index]);
            vec![parameter.name.to_owned(), value, parameter.unit.to_owned(), slope, reason.to_owned()]
        };
        let known =
            self.slopes.known.iter().map(|(index, slope)| cells(*index, text::float(0.01 * slope), ""));
        let unknown =
            self.slopes.unknown.iter().map(|(index, reason)| cells(*index, String::new(), reason.name()));
        let rows: Vec<Vec<String>> = known.chain(unknown).collect();
        print::table(format, &NAMES, &rows, String::new)
    }

    /// Returns the parameters with the largest effects as a table.
    pub(super) fn page(&self) -> String {
        let Gradient { column: Column { name: column, unit, .. }, value, slopes, chosen } = self;
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
        let here = format!("{} {unit}", six_digits(*value));
        let head = format!(
            "{column} = {}. Largest changes for a 1 % change of a parameter, in the unit of the measure and in % of the measure:",
            here.trim_end()
        );
        let mut page = wrapped(&head, 0) + "\n\n";
        page += &table.text_within(console::width());
        for reason in NoSlope::ALL {
            let of_reason = slopes.unknown.iter().filter(|(_, other)| *other == reason);
            let names: Vec<&str> =
                of_reason.map(|(index, _)| chosen.plan.parameters()[*index].name).collect();
            if !names.is_empty() {
                let line = format!("no derivative ({}): {}", reason.name(), names.join(", "));
                let _ = writeln!(page, "{}", wrapped(&line, 2));
            }
        }
        page
    }
}
