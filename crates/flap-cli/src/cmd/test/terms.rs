//! `flap test terms`: effects of terms that the papers leave out of the equations of motion.

use flap_core::parameter::Parameter;
use flap_core::simulate::Status;
use flap_sweep::notation::text;
use flap_sweep::notation::units::prefixed;
use flap_sweep::study::terms::{Effect, effects};

use crate::args::TermsArgs;
use crate::cmd::point::{Chosen, check_one_wing};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::print;
use crate::table::Table;

/// Measures whose changes the table shows, with the headings of their columns.
const MEASURES: [(&str, &str); 6] = [
    ("stroke_pp_deg", "stroke"),
    ("stroke_mean_deg", "mean stroke"),
    ("pitch_pp_deg", "pitch"),
    ("lift_mean_mn", "lift"),
    ("power_mean_mw", "power"),
    ("power_supply_mw", "supply"),
];

/// The measure whose change is a difference in degrees and not a percentage, because the mean stroke of most
/// designs is zero.
const DIFFERENCE: &str = "stroke_mean_deg";

pub(super) fn run(args: &TermsArgs) -> Result<Exit, Failure> {
    let chosen = Chosen::new(&args.point, &args.solver)?;
    let plan = &chosen.plan;
    check_one_wing(plan, &args.point.what, "`flap test terms`")?;
    let simulator = plan.robot().model();
    let run = chosen.run();
    let row = simulator.run_point(&run, None);
    if row.status != Status::Periodic {
        let reason = row.reason.clone().unwrap_or_else(|| row.status.name().to_owned());
        return Err(Failure::usage(format!("the motion of this design is not periodic: {reason}"))
            .help("choose another drive frequency or voltage with --set"));
    }
    let columns: Vec<(usize, &str, &str)> = MEASURES
        .iter()
        .filter_map(|(column, header)| {
            let place = simulator.columns().iter().position(|known| known.name == *column)?;
            Some((place, *column, *header))
        })
        .collect();
    let found = effects(plan, &run, chosen.set_parameters());
    if found.is_empty() {
        return Err(Failure::usage(format!("the model {} has no terms in flap's list", simulator.name()))
            .help("`flap test terms` supports the models bimorph, direct-drive and four-bar"));
    }
    let change = |effect: &Effect, place: usize, column: &str| {
        let (before, after) = (row.measures[place], effect.measures()?[place]);
        Some(if column == DIFFERENCE { after - before } else { 100.0 * (after / before - 1.0) })
    };
    let size = |parameter: usize, value: f64| prefixed(value, simulator.parameters()[parameter].unit);
    let mut names = vec!["parameter".to_owned(), "from".to_owned(), "to".to_owned(), "status".to_owned()];
    names.extend(columns.iter().map(|(_, column, _)| {
        if *column == DIFFERENCE { format!("{column}_change") } else { format!("{column}_change_percent") }
    }));
    let rows = found.iter().map(|effect| {
        let Parameter { name, .. } = simulator.parameters()[effect.parameter];
        let mut row = vec![
            name.to_owned(),
            text::float(effect.before),
            text::float(effect.after),
            effect.row.status.name().to_owned(),
        ];
        let cells = columns.iter().map(|(place, column, _)| change(effect, *place, column).map(text::float));
        row.extend(cells.map(Option::unwrap_or_default));
        row
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let headers: Vec<&str> = names.iter().map(String::as_str).collect();
    print::table(args.format, &headers, &rows, || {
        let mut headers = vec!["parameter", "from", "to"];
        headers.extend(columns.iter().map(|(_, _, header)| *header));
        let lines = found.iter().map(|effect| {
            let name = simulator.parameters()[effect.parameter].name.to_owned();
            let mut line =
                vec![name, size(effect.parameter, effect.before), size(effect.parameter, effect.after)];
            line.extend(columns.iter().map(|(place, column, _)| match change(effect, *place, column) {
                // No sign for a change that is rounded to zero.
                Some(change) if change.abs() < 0.05 => "0".to_owned(),
                Some(change) => format!("{change:+.1}{}", if *column == DIFFERENCE { "°" } else { " %" }),
                None => effect.row.status.name().to_owned(),
            }));
            line
        });
        let table = Table::of(&headers, lines.collect::<Vec<_>>()).text_within(console::width());
        format!("{}\nchanges of the measures if one parameter changes\n\n{table}", chosen.title())
    })?;
    Ok(Exit::Done)
}
