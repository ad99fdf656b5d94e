//! `flap vehicle --wrench-map`: a quadratic map that computes force and torque from the inputs within given
//! ranges.

use std::sync::atomic::Ordering;

use flap_core::vehicle::Vehicle;
use flap_sweep::notation::text::{self, count};
use flap_sweep::notation::units::prefixed;
use flap_sweep::run::RunOptions;
use flap_sweep::study::inputs;
use flap_sweep::study::wrench_map::{MapInput, WrenchMap, WrenchMapError, terms};
use flap_sweep::vehicle::control::COMPONENTS;
use serde_json::{Value, json};

use super::parts::{HEADINGS, refused, tidy, title};
use crate::args::{OutputFormat, VehicleArgs};
use crate::cmd::point::{self, Chosen};
use crate::console;
use crate::failure::{Exit, Failure};
use crate::print;
use crate::progress::Bar;
use crate::system;
use crate::table::{Table, six_digits};

/// Units of the components of force and torque.
const UNITS: [&str; 6] = ["mN", "mN", "mN", "uN*m", "uN*m", "uN*m"];

/// First columns of the map in csv. After these columns, the map has one column for each component of force
/// and torque.
const NAMES: [&str; 6] = ["section", "name", "unit", "from", "to", "count"];

pub(super) fn run(args: &VehicleArgs, chosen: &Chosen, vehicle: &Vehicle) -> Result<Exit, Failure> {
    let inputs = inputs(args, chosen)?;
    let options = RunOptions::with_threads(args.threads);
    let stop = system::stop();
    let mut bar = Bar::new("rows");
    let map = WrenchMap::of(&chosen.plan, &chosen.values, inputs, args.samples, &options, |progress| {
        let is_stopped = stop.load(Ordering::Relaxed);
        bar.show(progress, is_stopped);
        is_stopped
    });
    bar.clear();
    let map = map.map_err(|error| match error {
        WrenchMapError::Mistake(error) => refused("--wrench-map", error),
        WrenchMapError::Run(error) => error.into(),
    })?;
    let map = map.ok_or(Failure::Interrupted)?;
    if args.format == OutputFormat::Json {
        console::results(&object(&map, chosen, vehicle))?;
    } else {
        let names: Vec<&str> = NAMES.into_iter().chain(COMPONENTS).collect();
        let page = || format!("{}\n\n{}", title(chosen, vehicle), page(&map, chosen));
        print::table(args.format, &names, &cells(&map, chosen), page)?;
    }
    map.warnings().iter().for_each(|warning| console::warn(warning));
    Ok(Exit::Done)
}

/// Returns the inputs of the map, with their ranges from `--wrench-map`.
fn inputs(args: &VehicleArgs, chosen: &Chosen) -> Result<Vec<MapInput>, Failure> {
    let mut inputs = Vec::new();
    for range in &args.wrench_map {
        let input = inputs::input(&chosen.plan, &range.name);
        let input = input.map_err(|error| refused("--wrench-map", error))?;
        let parameter = &chosen.plan.parameters()[input.parameter];
        let option = format!("--wrench-map {}=", range.name);
        let from = point::value(parameter, &option, &range.from)?;
        let to = point::value(parameter, &option, &range.to)?;
        let place = format!("{option}{}:{}", range.from, range.to);
        inputs.push(MapInput::new(&input, from, to).map_err(|error| refused(&place, error))?);
    }
    Ok(inputs)
}

/// Returns the name of a term of the polynomial, such as `bias^2`. The constant term has the name `1`.
fn term_name(map: &WrenchMap, term: &[usize]) -> String {
    let name = |&input: &usize| map.inputs[input].name.as_str();
    match term {
        [] => "1".to_owned(),
        [one, other] if one == other => format!("{}^2", name(one)),
        _ => term.iter().map(name).collect::<Vec<_>>().join("*"),
    }
}

/// Returns the map as text for a terminal.
fn page(map: &WrenchMap, chosen: &Chosen) -> String {
    let width = console::width();
    let mut ranges = Table::with_headings(&["input", "from", "to"]);
    for input in &map.inputs {
        let unit = chosen.plan.parameters()[input.parameter].unit;
        ranges.row([input.name.clone(), prefixed(input.from, unit), prefixed(input.to, unit)]);
    }
    let mut quality = Table::with_headings(&["component", "unit", "R^2", "largest error"]);
    for (place, heading) in HEADINGS.into_iter().enumerate() {
        let r_squared = map.r_squared[place];
        let r_squared = if r_squared.is_nan() { "constant".to_owned() } else { six_digits(r_squared) };
        let error = six_digits(tidy(map.largest_error[place]));
        quality.row([heading.to_owned(), UNITS[place].to_owned(), r_squared, error]);
    }
    let headings: Vec<&str> = ["term"].into_iter().chain(HEADINGS).collect();
    let mut coefficients = Table::with_headings(&headings);
    for (place, term) in terms(map.inputs.len()).iter().enumerate() {
        let numbers = map.scaled.column(place);
        let numbers = numbers.iter().map(|number| six_digits(tidy(*number)));
        coefficients.row(std::iter::once(term_name(map, term)).chain(numbers).collect::<Vec<_>>());
    }
    format!(
        "{}\nQuadratic map by least squares over {}, and its error on {} outside the fit:\n\n{}\n\
         Coefficients of force (mN) and torque (uN*m), for each input scaled from -1 to 1 over its range:\n\n{}",
        ranges.text_within(width),
        count(map.fitted as u64, "row"),
        count(map.left_out as u64, "row"),
        quality.text_within(width),
        coefficients.text_within(width)
    )
}

/// Returns the map as rows for csv, with all digits. The columns are [`NAMES`] and the components of force
/// and torque.
fn cells(map: &WrenchMap, chosen: &Chosen) -> Vec<Vec<String>> {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut put = |head: [&str; 6], numbers: Vec<f64>| {
        let numbers = (0..6).map(|place| numbers.get(place).map_or_else(String::new, |n| text::float(*n)));
        rows.push(head.into_iter().map(str::to_owned).chain(numbers).collect());
    };
    for input in &map.inputs {
        let unit = chosen.plan.parameters()[input.parameter].unit;
        let (from, to) = (text::float(input.from), text::float(input.to));
        put(["input", &input.name, unit, &from, &to, ""], Vec::new());
    }
    for (name, rows) in map.rows() {
        put(["rows", name, "", "", "", &rows.to_string()], Vec::new());
    }
    put(["quality", "r_squared", "", "", "", ""], map.r_squared.to_vec());
    put(["quality", "largest_error", "", "", "", ""], map.largest_error.to_vec());
    for (section, coefficients) in [("scaled", &map.scaled), ("physical", &map.physical())] {
        for (place, term) in terms(map.inputs.len()).iter().enumerate() {
            let numbers = coefficients.column(place).iter().copied().collect();
            put([section, &term_name(map, term), "", "", "", ""], numbers);
        }
    }
    rows
}

/// Returns the map as the text of a JSON object, with one line per entry of the object.
fn object(map: &WrenchMap, chosen: &Chosen, vehicle: &Vehicle) -> String {
    let inputs = map.inputs.iter().map(|input| {
        let parameter = &chosen.plan.parameters()[input.parameter];
        json!({
            "name": input.name, "parameter": parameter.name, "unit": parameter.unit,
            "from": input.from, "to": input.to, "centre": input.centre(), "half_range": input.half_range(),
        })
    });
    let outputs = COMPONENTS.into_iter().zip(UNITS).enumerate().map(|(place, (name, unit))| {
        json!({
            "name": name, "unit": unit,
            "r_squared": map.r_squared[place], "largest_error": map.largest_error[place],
        })
    });
    let terms = terms(map.inputs.len());
    let rows = map.rows().into_iter().map(|(name, rows)| (name.to_owned(), Value::from(rows)));
    let [scaled, physical] = [&map.scaled, &map.physical()].map(|coefficients| {
        coefficients.row_iter().map(|row| json!(row.iter().copied().collect::<Vec<f64>>())).collect()
    });
    let entries: [(&str, Value); 9] = [
        ("vehicle", title(chosen, vehicle).into()),
        ("inputs", inputs.collect()),
        ("outputs", outputs.collect()),
        ("terms", terms.iter().map(|term| term_name(map, term)).collect()),
        ("powers", json!(map.powers())),
        ("scaled", scaled),
        ("physical", physical),
        ("rows", Value::Object(rows.collect())),
        ("floquet_max", json!(map.floquet_max)),
    ];
    let lines: Vec<String> =
        entries.iter().map(|(name, value)| format!("  \"{name}\": {}", listed(value))).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

/// Returns a JSON value as text. A list of lists or of objects has one line per entry.
fn listed(value: &Value) -> String {
    match value {
        Value::Array(entries) if entries.iter().any(|entry| entry.is_array() || entry.is_object()) => {
            let lines: Vec<String> = entries.iter().map(|entry| format!("    {entry}")).collect();
            format!("[\n{}\n  ]", lines.join(",\n"))
        }
        value => value.to_string(),
    }
}
