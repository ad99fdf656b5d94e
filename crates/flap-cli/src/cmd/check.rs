//! `flap check`: a summary of the sweep that a grid file describes.

mod estimate;
mod trial;

use std::fmt::Write as _;

use flap_core::parameter::Parameter;
use flap_core::simulate::{Setting, SolverSettings};
use flap_core::vehicle::Vehicle;
use flap_sweep::notation::text;
use flap_sweep::plan::axes::Values;
use flap_sweep::plan::refine::{Error, Limit, Refine};
use flap_sweep::plan::sample::{Distribution, Method};
use flap_sweep::plan::{Admission, Plan};
use flap_sweep::resonance::Range;
use flap_sweep::study::deviation;
use flap_sweep::study::linked::{self, Linked};
use flap_sweep::study::survey;

use super::{deviations, grid};
use crate::args::{CheckArgs, OutputFormat};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::job::exclusion;
use crate::print;
use crate::table::{self, Table, wrapped};

pub(crate) fn run(args: &CheckArgs) -> Result<Exit, Failure> {
    let plan = grid::read(&args.grid)?;
    deviations::warn(&deviation::of(&plan));
    match args.format {
        OutputFormat::Table => console::results(&page(&plan, args))?,
        format => print::table(format, &NAMES, &rows(&plan, args), String::new)?,
    }
    Ok(Exit::Done)
}

/// Columns of the output in csv and json.
const NAMES: [&str; 4] = ["section", "name", "key", "value"];

/// Returns the summary of the sweep for csv and json, with one value per row.
fn rows(plan: &Plan, args: &CheckArgs) -> Vec<Vec<String>> {
    let row = |section: &str, name: &str, key: &str, value: String| {
        vec![section.to_owned(), name.to_owned(), key.to_owned(), value]
    };
    let excluded = Excluded::of(plan);
    let estimate = estimate::of(plan, excluded.runs, args.shard, args.threads);
    let mut rows = vec![
        row("sweep", "", "model", plan.simulator().name().to_owned()),
        row("sweep", "", "preset", plan.preset().to_owned()),
        row("sweep", "", "points", plan.len().to_string()),
        row("sweep", "", "points_run", excluded.runs.to_string()),
    ];
    if let Some(refine) = plan.refine() {
        for Limit { column, error } in &refine.measures {
            rows.push(row("refine", column, "error", error_text(*error)));
        }
        for &along in &refine.along {
            for parameter in names(plan, along) {
                rows.push(row("refine", parameter, "along", (along + 1).to_string()));
            }
        }
        rows.push(row("refine", "", "max_points", refine.max_points.to_string()));
        rows.push(row("refine", "", "halvings", refine.halvings.to_string()));
    }
    if let Some(path) = &plan.output().path {
        rows.push(row("sweep", "", "path", path.display().to_string()));
    }
    for (number, axis) in plan.axes().as_slice().iter().enumerate() {
        for (index, values) in axis.parameters() {
            let parameter = &plan.parameters()[*index];
            let [from, to] = span(parameter, values);
            let count = values.len().to_string();
            for (key, value) in
                [("axis", (number + 1).to_string()), ("from", from), ("to", to), ("count", count)]
            {
                rows.push(row("axes", parameter.name, key, value));
            }
            rows.push(row("axes", parameter.name, "unit", parameter.unit.to_owned()));
        }
    }
    for deviation in deviation::of(plan) {
        let name = deviation.parameter.name;
        rows.push(row("differs_from_preset", name, "here", deviation.shown()));
        rows.push(row("differs_from_preset", name, "preset", deviation.preset_shown()));
    }
    for Linked { parameter, value, varied, formula } in linked::of(plan) {
        rows.push(row("linked", parameter.name, "value", text::value(parameter, value)));
        rows.push(row("linked", parameter.name, "scales_with", varied.join(" ")));
        rows.push(row("linked", parameter.name, "derived", formula));
    }
    rows.extend(settings(plan.solver()).map(|(name, value)| row("solver", name, "value", value)));
    if let Some([low, high]) = estimate.seconds {
        rows.push(row("estimate", "", "seconds_from", text::float(low)));
        rows.push(row("estimate", "", "seconds_to", text::float(high)));
        rows.push(row("estimate", "", "threads", estimate.threads.to_string()));
        if let Some(bytes) = estimate.bytes {
            rows.push(row("estimate", "", "csv_bytes", format!("{bytes:.0}")));
        }
        rows.push(row("estimate", "", "points_tried", estimate.tried.to_string()));
    }
    rows.extend(estimate.invalid.map(|invalid| row("estimate", "", "invalid", invalid)));
    rows
}

fn page(plan: &Plan, args: &CheckArgs) -> String {
    let points = text::count(plan.len(), "point");
    let mut page = format!("{points} of {} from {}\n", plan.simulator().name(), plan.preset());
    page += &plan.vehicle().map(wings).unwrap_or_default();
    if !plan.axes().as_slice().is_empty() {
        page += "\n";
        page += &axes(plan);
        page += &samples(plan);
        page += "\n";
        page += &ends(plan);
    }
    page += &plan.refine().map(|refine| refinement(plan, refine)).unwrap_or_default();
    page += &deviations(plan);
    page += &links(&linked::of(plan));
    if let Some(resonance) = plan.resonance() {
        page += "\n";
        page += &at_resonance(resonance.range());
    }
    let excluded = Excluded::of(plan);
    page += &excluded.line;
    page += "\n";
    page += &solver(plan.solver());
    if let Some(path) = &plan.output().path {
        let _ = write!(page, "\nrows go to {}\n", path.display());
    }
    let estimate = estimate::of(plan, excluded.runs, args.shard, args.threads);
    for line in estimate.line().into_iter().chain(estimate.invalid) {
        let _ = write!(page, "\n{}\n", wrapped(&line, 0));
    }
    page
}

/// Returns a line that lists the wings of a vehicle.
fn wings(vehicle: &Vehicle) -> String {
    let named = vehicle
        .mounts()
        .iter()
        .map(|mount| if mount.mirrored { format!("{} (mirrored)", mount.name) } else { mount.name.clone() });
    let named: Vec<String> = named.collect();
    format!("a vehicle of {}: {}\n", text::count(named.len() as u64, "wing"), named.join(", "))
}

/// Returns a table with one line per varied parameter. Parameters that vary together have the same axis
/// number.
fn axes(plan: &Plan) -> String {
    let mut table = Table::with_headings(&["axis", "parameter", "from", "to", "count", "unit"]).with_keys(2);
    for (number, axis) in plan.axes().as_slice().iter().enumerate() {
        for (index, values) in axis.parameters() {
            let parameter = &plan.parameters()[*index];
            let [from, to] = span(parameter, values);
            table.row([
                (number + 1).to_string(),
                parameter.name.to_owned(),
                from,
                to,
                values.len().to_string(),
                parameter.unit.to_owned(),
            ]);
        }
    }
    table.text_within(console::width())
}

/// Returns a line about the points that the refinement may add.
fn refinement(plan: &Plan, refine: &Refine) -> String {
    let limits = refine.measures.iter().map(|Limit { column, error }| {
        let of = if matches!(error, Error::Share(_)) { " of its range" } else { "" };
        format!("{column} errs by at most {}{of}", error_text(*error))
    });
    let limits: Vec<String> = limits.collect();
    let along: Vec<&str> = refine.along.iter().flat_map(|&along| names(plan, along)).collect();
    let line = format!(
        "[refine] adds points to these {} along {}, up to {} in total, until linear interpolation of {}",
        text::count(plan.axes().points(), "uniform point"),
        along.join(" and "),
        refine.max_points,
        limits.join(", and of ")
    );
    format!("\n{}\n", wrapped(&line, 0))
}

/// Returns the names of the parameters of an axis.
fn names(plan: &Plan, axis: usize) -> impl Iterator<Item = &str> {
    plan.axes().as_slice()[axis].parameters().iter().map(|(index, _)| plan.parameters()[*index].name)
}

/// Returns the largest allowed interpolation error of a measure as text, in the notation of grid files.
fn error_text(error: Error) -> String {
    match error {
        Error::Share(share) => format!("{} %", 100.0 * share),
        Error::Absolute(error) => error.to_string(),
    }
}

/// Returns a table of the parameters that differ from the preset. The text is empty if no parameter differs.
fn deviations(plan: &Plan) -> String {
    let deviations = deviation::of(plan);
    if deviations.is_empty() {
        return String::new();
    }
    let mut table = Table::with_headings(&["differs from the preset", "here", "preset", "ratio"]);
    for deviation in deviations {
        let name = deviation.parameter.name.to_owned();
        table.row([name, deviation.shown(), deviation.preset_shown(), deviation.ratio()]);
    }
    "\n".to_owned() + &table.text_within(console::width())
}

/// Returns a text about parameters that are constant although they usually change with a varied parameter.
/// The text proposes a formula for each constant parameter. The text is empty if `linked` is empty.
fn links(linked: &[Linked<'_>]) -> String {
    if linked.is_empty() {
        return String::new();
    }
    let mut text = "\n".to_owned();
    for Linked { parameter, value, varied, .. } in linked {
        let value = table::assignment(parameter, *value);
        let _ = writeln!(text, "{value} stays the same while {} varies", varied.join(" and "));
    }
    text += "in most robots these parameters change together; if they do in yours, add to the grid file:\n  [derived]\n";
    for Linked { parameter, formula, .. } in linked {
        let _ = writeln!(text, "  {} = \"{formula}\"", parameter.name);
    }
    text
}

/// Returns as text the first and the last value of a parameter on an axis, or the distribution of a sampled
/// parameter.
fn span(parameter: &Parameter, values: &Values) -> [String; 2] {
    let show = |value| text::value(parameter, value);
    if let Values::Correlated { mean, sd, .. } = values {
        return [format!("mean {}", show(*mean)), format!("sd {}, of the device", show(*sd))];
    }
    let Values::Sampled { distribution, .. } = values else {
        return [0, values.len() - 1].map(|position| show(values.get(position)));
    };
    match distribution {
        Distribution::Among(list) => {
            let listed: Vec<String> = list.iter().map(|value| show(*value)).collect();
            [format!("one of {}", listed.join(", ")), String::new()]
        }
        Distribution::Uniform { from, to } => [*from, *to].map(show),
        Distribution::LogUniform { from, to } => [show(*from), show(*to) + " log"],
        Distribution::Normal { mean, sd, from, to } => {
            let mut bounds = String::new();
            if from.is_finite() {
                let _ = write!(bounds, ", from {}", show(*from));
            }
            if to.is_finite() {
                let _ = write!(bounds, ", to {}", show(*to));
            }
            [format!("mean {}", show(*mean)), format!("sd {}{bounds}", show(*sd))]
        }
    }
}

/// Returns as text the sampling method and the seed of each sample, and the name of a file that contains
/// points.
fn samples(plan: &Plan) -> String {
    let mut text = String::new();
    for (number, axis) in plan.axes().as_slice().iter().enumerate() {
        if let Some((_, Values::Sampled { sample, .. } | Values::Correlated { sample, .. })) =
            axis.parameters().first()
        {
            let method = match sample.method() {
                Method::Sobol => "scrambled Sobol' sequence",
                Method::LatinHypercube => "Latin hypercube",
                Method::Random => "random points",
            };
            let _ = write!(text, "\naxis {}: {method}, seed {}\n", number + 1, sample.seed());
        }
    }
    if let Some(file) = plan.points_file() {
        let _ = write!(text, "\npoints from {}\n", file.path.display());
    }
    text
}

/// Largest number of points that flap checks to count the excluded points.
const MOST_COUNTED: u64 = 1_000_000;

/// The points that `[where]` excludes.
struct Excluded {
    /// A text about the number of excluded points. The text is empty for a grid without conditions.
    line: String,
    /// Number of points that a sweep of the grid runs. For a large grid, the number of points is approximate.
    runs: u64,
}

impl Excluded {
    fn of(plan: &Plan) -> Excluded {
        if plan.conditions().is_empty() {
            return Excluded { line: String::new(), runs: plan.len() };
        }
        let found = survey::exclusions(plan, MOST_COUNTED);
        let line = exclusion::text(found.excluded, &found.unsatisfied);
        if found.looked_at == plan.len() {
            return Excluded { line: format!("\n{line}\n"), runs: plan.len() - found.excluded };
        }
        let share = 1.0 - found.excluded as f64 / found.looked_at as f64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of the points")]
        let runs = (plan.len() as f64 * share) as u64;
        let looked_at = found.looked_at;
        let line = format!(
            "\nthe grid is too large to check every point; of {looked_at} points spread over the grid, {line}\n"
        );
        Excluded { line, runs }
    }
}

/// Returns as text the varied and derived parameters of the first and the last point, and whether these
/// points are excluded or invalid.
fn ends(plan: &Plan) -> String {
    let mut text = String::new();
    for (which, index) in [("first", 0), ("last", plan.len() - 1)] {
        let point = plan.point(index);
        let shown = plan.differing();
        let shown = shown.map(|index| table::assignment(&plan.parameters()[index], point.values[index]));
        let verdict = match plan.judge(&point.values) {
            Admission::Runs => String::new(),
            Admission::Excluded(_) => " (excluded)".to_owned(),
            Admission::Invalid(invalid) => format!(" (invalid: {invalid})"),
        };
        let line = format!("{which} point, {index}: {}{verdict}", shown.collect::<Vec<_>>().join(", "));
        let _ = writeln!(text, "{}", wrapped(&line, 2));
    }
    text
}

/// Returns a text about a drive frequency that is set to the resonance: the range and the tolerance of the
/// search.
fn at_resonance(range: &Range) -> String {
    let Range { of, from, to, tolerance } = range;
    let from =
        from.map_or_else(|| "half of the lower natural frequency".to_owned(), |from| format!("{from} Hz"));
    let to = to.map_or_else(
        || "one and a half times the upper natural frequency".to_owned(),
        |to| format!("{to} Hz"),
    );
    let of = of.name();
    let line =
        format!("drive_frequency: at the largest {of}, searched from {from} to {to}, within {tolerance} Hz");
    wrapped(&line, 2) + "\n"
}

fn solver(solver: &SolverSettings) -> String {
    let line =
        settings(solver).map(|(name, value)| format!("{name} = {value}")).collect::<Vec<_>>().join(", ");
    wrapped(&line, 0) + "\n"
}

/// Returns names and values of the solver's settings.
fn settings(solver: &SolverSettings) -> impl Iterator<Item = (&'static str, String)> {
    SolverSettings::TABLE.iter().map(|Setting { name, kind, .. }| (*name, text::setting(*kind, solver)))
}
