//! Parameters and measures of a design, and the chart that the page shows first, as data for the page.

use std::f64::consts::PI;

use flap_core::parameter::{Kind, Parameter, Range};
use flap_sweep::notation::text;
use flap_sweep::plan::Plan;
use flap_sweep::table::labels::{self, Scale};
use flap_sweep::table::layout::{self, Layout};
use serde::Serialize;
use serde_json::{Map, Value};

use crate::opened::Opened;

/// The parameter on the x-axis of the chart that the page shows first, if the model has this parameter.
const DRIVE_FREQUENCY: &str = "drive_frequency";
const DRIVE_VOLTAGE: &str = "drive_voltage_pp";

/// Largest number of lines in the chart that the page shows first.
const MOST_LINES: usize = 8;

/// The data of the page.
#[derive(Serialize)]
pub(crate) struct Description<'a> {
    version: &'static str,
    title: &'a str,
    preset: &'a str,
    model: &'a str,
    doc: &'a str,
    parameters: Vec<ParameterText<'a>>,
    measures: Vec<MeasureText>,
    view: View<'a>,
    can: Can,
}

/// A parameter: its meaning, its value, and the range of its slider.
#[derive(Serialize)]
struct ParameterText<'a> {
    name: &'a str,
    label: String,
    group: &'a str,
    symbol: &'a str,
    doc: &'a str,
    allowed: String,
    /// The unit in which values are shown.
    unit: String,
    /// Factor from SI values to shown values.
    factor: f64,
    kind: &'static str,
    options: Option<&'a [&'a str]>,
    /// The value in SI units, or the name of an option.
    value: Value,
    published: Value,
    low: f64,
    high: f64,
    log: bool,
    /// The smallest and the largest allowed value, if the range of the parameter has two limits.
    limits: Option<[f64; 2]>,
    whole: bool,
    fitted: bool,
}

/// A column with numbers.
#[derive(Serialize)]
struct MeasureText {
    name: String,
    label: String,
    unit: String,
    doc: String,
}

/// The chart that the page shows first: a measure over a parameter, with a line for each value of another
/// parameter.
#[derive(Serialize)]
struct View<'a> {
    x: Axis<'a>,
    by: Option<Lines<'a>>,
    measure: String,
}

#[derive(Serialize)]
struct Axis<'a> {
    name: &'a str,
    from: f64,
    to: f64,
}

#[derive(Serialize)]
struct Lines<'a> {
    name: &'a str,
    values: Vec<f64>,
}

/// The features that the model supports.
#[derive(Serialize)]
struct Can {
    motion: bool,
}

impl<'a> Description<'a> {
    /// Returns the description of the opened design.
    pub(crate) fn of(opened: &'a Opened) -> Description<'a> {
        let plan = opened.plan();
        let simulator = plan.simulator();
        let published = opened.published();
        let parameters = (plan.parameters().iter().zip(opened.values()).zip(published).enumerate()).map(
            |(index, ((parameter, value), published))| ParameterText {
                kind: if plan.derived().parameters().any(|derived| derived == index) {
                    "derived"
                } else {
                    kind(parameter)
                },
                ..ParameterText::new(parameter, *value, published)
            },
        );
        let measures = measures(opened.published_plan());
        Description {
            version: env!("CARGO_PKG_VERSION"),
            title: &plan.source().name,
            preset: plan.preset(),
            model: simulator.name(),
            doc: simulator.doc(),
            parameters: parameters.collect(),
            view: view(plan, opened.values(), &measures),
            measures,
            can: Can { motion: simulator.motions().is_ok() },
        }
    }
}

impl<'a> ParameterText<'a> {
    fn new(parameter: &'a Parameter, value: f64, published: f64) -> ParameterText<'a> {
        let slider = Slider::of(parameter, if value.is_nan() { published } else { value });
        let Scale { factor, unit } = labels::scale(parameter.unit, slider.typical);
        ParameterText {
            name: parameter.name,
            label: labels::with_unit(parameter.name, parameter.unit).words,
            group: parameter.group,
            symbol: parameter.symbol,
            doc: parameter.doc,
            allowed: parameter.kind.describe(),
            unit,
            factor,
            kind: kind(parameter),
            options: match parameter.kind {
                Kind::Choice(options) => Some(options),
                Kind::Number(_) | Kind::Following(..) => None,
            },
            value: shown(parameter, value),
            published: shown(parameter, published),
            low: slider.low,
            high: slider.high,
            log: slider.log,
            limits: slider.limits,
            whole: matches!(parameter.kind, Kind::Number(Range::Whole(..))),
            fitted: parameter.is_fitted,
        }
    }
}

fn kind(parameter: &Parameter) -> &'static str {
    match parameter.kind {
        Kind::Number(_) => "number",
        Kind::Following(..) => "following",
        Kind::Choice(_) => "choice",
    }
}

/// Returns a value for the page: a number in SI units, the name of an option, or null.
fn shown(parameter: &Parameter, value: f64) -> Value {
    match text::option(parameter, value) {
        Some(option) => option.into(),
        None => value.into(),
    }
}

/// Returns the values of a design for the page, by parameter.
pub(crate) fn values(parameters: &[Parameter], values: &[f64]) -> Map<String, Value> {
    let shown =
        |(parameter, value): (&Parameter, &f64)| (parameter.name.to_owned(), shown(parameter, *value));
    parameters.iter().zip(values).map(shown).collect()
}

/// The range of a slider: a neighbourhood of the value, within the allowed range.
struct Slider {
    low: f64,
    high: f64,
    /// True for a logarithmic slider.
    log: bool,
    /// The smallest and the largest allowed value, if the range of the parameter has two limits.
    limits: Option<[f64; 2]>,
    /// The typical size of the parameter's values. The page shows the values in a unit that suits this size.
    typical: f64,
}

impl Slider {
    fn of(parameter: &Parameter, value: f64) -> Slider {
        let range = match parameter.kind {
            Kind::Number(range) | Kind::Following(range, _) => range,
            Kind::Choice(_) => Range::Any,
        };
        let size = if value.is_finite() && value != 0.0 { value.abs() } else { usual(parameter.unit) };
        let slider = |low: f64, high: f64, log: bool| Slider { low, high, log, limits: None, typical: size };
        let limited = |low: f64, high: f64| Slider { limits: Some([low, high]), ..slider(low, high, false) };
        match range {
            Range::Whole(first, last) => {
                let most = (4.0 * size).ceil().max(f64::from(first) + 1.0);
                let allowed = limited(f64::from(first), f64::from(last));
                Slider { high: allowed.high.min(most), ..allowed }
            }
            Range::Share => limited(0.0, 1.0),
            Range::Between(low, high) if low.is_finite() && high.is_finite() => {
                // The limits themselves are not allowed.
                let margin = 0.01 * (high - low);
                limited(low + margin, high - margin)
            }
            Range::Positive if parameter.name == DRIVE_FREQUENCY => slider(0.5 * size, 1.5 * size, false),
            Range::Positive | Range::Between(..) => slider(size / 4.0, 4.0 * size, true),
            Range::NonNegative => slider(0.0, 2.0 * size, false),
            Range::Any if value > 0.0 => slider(0.0, 2.0 * size, false),
            Range::Any => slider(-2.0 * size, 2.0 * size, false),
        }
    }
}

/// Returns a typical size of values in the unit `unit`, for parameters that are zero or not set.
fn usual(unit: &str) -> f64 {
    match unit {
        "rad" => PI / 4.0,
        "m" => 1e-3,
        "m^2" | "kg" => 1e-5,
        "kg*m^2" => 1e-12,
        "N*m*s" => 1e-9,
        "N*m/rad" => 1e-6,
        "V" => 50.0,
        "Pa" => 1e9,
        "" => 0.5,
        _ => 1.0,
    }
}

/// Returns the columns with numbers that describe motions, then the columns about stability and error.
fn measures(plan: &Plan) -> Vec<MeasureText> {
    let varied: Vec<&str> = plan.differing().map(|index| plan.parameters()[index].name).collect();
    let columns = Layout::of(plan).columns().into_iter();
    let columns = columns.filter(|column| {
        let is_number = matches!(column.kind, layout::CellKind::Number | layout::CellKind::Whole);
        is_number && column.name != "point" && !varied.contains(&column.name.as_str())
    });
    columns
        .map(|column| {
            let label = labels::with_unit(&column.name, &column.unit);
            MeasureText { label: label.words, unit: label.unit, doc: column.doc, name: column.name }
        })
        .collect()
}

/// Returns the chart that the page shows first: over the axes of the grid, or over the drive frequency for
/// several voltages.
fn view<'a>(plan: &'a Plan, values: &[f64], measures: &[MeasureText]) -> View<'a> {
    let parameters = plan.parameters();
    let is_number = |index: usize| !matches!(parameters[index].kind, Kind::Choice(_));
    let place = |name: &str| parameters.iter().position(|parameter| parameter.name == name);
    let varied: Vec<usize> = plan.axes().varied().filter(|&index| is_number(index)).collect();
    let usable = |index: &usize| is_number(*index) && values[*index].is_finite() && values[*index] != 0.0;
    let x = place(DRIVE_FREQUENCY)
        .filter(|x| varied.is_empty() || varied.contains(x))
        .or(varied.last().copied())
        .or_else(|| (0..parameters.len()).find(usable))
        .unwrap_or(0);
    let along = values_of(plan, x);
    let (from, to) = match (along.first(), along.last()) {
        (Some(from), Some(to)) if along.len() > 1 => (*from, *to),
        _ => (0.6 * values[x], 1.4 * values[x]),
    };
    let by = varied.iter().copied().find(|&index| index != x);
    let by = by.map(|index| (index, thinned(&values_of(plan, index)))).or_else(|| {
        let index = place(DRIVE_VOLTAGE).filter(|index| *index != x && usable(index))?;
        Some((index, [0.25, 0.5, 0.75, 1.0, 1.25].map(|share| share * values[index]).to_vec()))
    });
    let usual = ["lift_mean_mn", "force_up_mn", "stroke_amplitude_deg"];
    let measure = usual.into_iter().find(|name| measures.iter().any(|measure| measure.name == *name));
    let first = || measures.first().map_or_else(String::new, |measure| measure.name.clone());
    View {
        x: Axis { name: parameters[x].name, from, to },
        by: by.map(|(index, values)| Lines { name: parameters[index].name, values }),
        measure: measure.map_or_else(first, str::to_owned),
    }
}

/// Returns the different values that a parameter has at the points of a plan, in rising order. In a long list
/// of points, the function reads only every n-th point.
fn values_of(plan: &Plan, index: usize) -> Vec<f64> {
    const MOST_POINTS: u64 = 4096;
    let stride = usize::try_from(plan.len().div_ceil(MOST_POINTS)).unwrap_or(1).max(1);
    let mut values: Vec<f64> =
        (0..plan.len()).step_by(stride).map(|point| plan.point(point).values[index]).collect();
    values.retain(|value| value.is_finite());
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

/// Returns at most [`MOST_LINES`] of the given values, including the first and the last value.
fn thinned(values: &[f64]) -> Vec<f64> {
    if values.len() <= MOST_LINES {
        return values.to_vec();
    }
    (0..MOST_LINES).map(|line| values[line * (values.len() - 1) / (MOST_LINES - 1)]).collect()
}
