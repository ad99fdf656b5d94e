//! Basins of attraction in bistable bands, for `flap respond --basins`.

use flap_core::parameter::Parameter;
use flap_core::simulate::never;
use flap_sweep::notation::text;
use flap_sweep::notation::units::prefixed;
use flap_sweep::plan::Plan;
use flap_sweep::run::{Outcome, RunOptions};
use flap_sweep::study::response::{Basin, Curve, Responses, Starts};

use crate::args::{OutputFormat, RespondArgs};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::{Table, assignment};

/// Prints the basins of attraction of each design in the plan of `flap respond`.
pub(super) fn run(plan: &Plan, starts: Starts, args: &RespondArgs) -> Result<Exit, Failure> {
    let Some((along, responses)) = plan.followed().zip(Responses::of(plan)) else {
        return Err(Failure::Bug("the plan follows no parameter".to_owned()));
    };
    let options = RunOptions::with_threads(args.begin.work.threads);
    let mut rows = Vec::new();
    for outcome in responses.curves(&options, 0) {
        let Outcome::Ran(curve) = outcome? else { continue };
        let basins = responses.basins(&curve, starts, &never);
        let basins = basins.map_err(|error| Failure::usage(error.to_string()))?;
        let design = design(plan, &curve);
        match (args.format, no_basin(along.parameter(plan), &curve, &basins)) {
            (OutputFormat::Table, Some(none)) => console::results(&format!("{design}{none}\n"))?,
            (OutputFormat::Table, None) => {
                let head = if design.is_empty() { "" } else { &format!("{}\n", design.trim_end()) };
                console::results(&format!("{head}{}", table(along.parameter(plan), &basins)))?;
            }
            (_, Some(none)) => console::say(&format!("{design}{none}")),
            (_, None) => rows.extend(basins.iter().map(|basin| cells(plan, &curve, basin))),
        }
    }
    if args.format != OutputFormat::Table {
        let varied = plan.axes().varied().map(|index| plan.parameters()[index].name);
        let followed = along.parameter(plan).name;
        let shares =
            ["up", "down", "other"].map(|motion| [format!("share_{motion}"), format!("error_{motion}")]);
        let names = varied.chain([followed, "starts"]).map(str::to_owned);
        let names: Vec<String> = names.chain(shares.into_iter().flatten()).collect();
        print::table(args.format, &names, &rows, String::new)?;
    }
    Ok(Exit::Done)
}

/// Returns the beginning of a printed line: the design's values of the varied parameters, and a colon. Empty
/// without varied parameters.
pub(super) fn design(plan: &Plan, curve: &Curve) -> String {
    let varied = plan.axes().varied();
    let varied = varied.map(|index| assignment(&plan.parameters()[index], curve.design.values[index]));
    let design = varied.collect::<Vec<_>>().join(", ");
    if design.is_empty() { design } else { design + ": " }
}

/// If a design has no bistable band or no response, returns the reason why flap prints no basins.
fn no_basin(parameter: &Parameter<'_>, curve: &Curve, basins: &[Basin]) -> Option<String> {
    if let Some(reason) = curve.invalid() {
        return Some(format!("no response: {reason}"));
    }
    basins.is_empty().then(|| format!("no value of {} with two stable orbits", parameter.name))
}

/// Returns the basins of attraction of a design as a table for a terminal.
fn table(parameter: &Parameter<'_>, basins: &[Basin]) -> String {
    let mut table = Table::with_names([parameter.name, "up", "down", "other"].map(str::to_owned).into());
    for basin in basins {
        let shares = basin.shares().map(|[share, error]| percent(share, error));
        table.row([vec![prefixed(basin.value, parameter.unit)], shares.to_vec()].concat());
    }
    table.text_within(console::width())
}

/// Returns a percentage with its standard error, such as `61.5 ± 2.4 %`.
fn percent(share: f64, error: f64) -> String {
    format!("{:.1} ± {:.1} %", 100.0 * share, 100.0 * error)
}

/// Returns the row for csv and json with the basins at one value of the followed parameter.
fn cells(plan: &Plan, curve: &Curve, basin: &Basin) -> Vec<String> {
    let varied = plan.axes().varied();
    let varied = varied.map(|index| text::value(&plan.parameters()[index], curve.design.values[index]));
    let shares = basin.shares().into_iter().flatten().map(text::float);
    varied.chain([text::float(basin.value), basin.count.to_string()]).chain(shares).collect()
}
