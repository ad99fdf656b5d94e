//! `flap device wing`: the parameters of a wing from its outline.

use flap_core::aero::{ChordTable, Material, STATIONS, Tabulated, Wing};
use flap_core::parameter::{Kind, Parameter};
use flap_sweep::files::outline;
use flap_sweep::grid;
use flap_sweep::notation::units::prefixed;
use flap_sweep::plan::{Plan, Value};

use crate::args::WingArgs;
use crate::cmd::point;
use crate::console;
use crate::failure::{Exit, Failure};

/// Density of air (kg/m³) for models that have no parameter for the density of air.
const AIR_DENSITY: f64 = 1.2;

/// If the area of the chord table and the area of the outline differ by more than this fraction, flap prints
/// a note.
const CLOSE: f64 = 5e-3;

pub(super) fn run(args: &WingArgs) -> Result<Exit, Failure> {
    let plan = point::plan(&args.preset)?;
    let outline = outline::read(&args.outline)?;
    let air = Parameter::index(plan.parameters(), "air_density").and_then(|index| plan.base()[index].given());
    let wing = Wing {
        outline,
        offset: args.offset.unwrap_or(0.0),
        material: material(args)?,
        air_density: air.unwrap_or(AIR_DENSITY),
    };
    let model = plan.simulator().description();
    let Some(parameters) = model.wing.map(|parameters| parameters(&wing)) else {
        let message = format!("the model {} cannot compute its wing from an outline", model.name);
        return Err(Failure::usage(message));
    };
    check_ranges(&plan, &wing, &parameters)?;
    console::results(&grid::wing(&plan, &args.preset, &parameters))?;
    if wing.material.is_none() {
        console::say(
            "without --mass, or --thickness and --density, the mass and inertias of the wing are the values of the preset",
        );
    }
    if let Some(masses) = wing.masses() {
        console::say(&format!(
            "the wing has {} and {}; its centre of mass is {} from the stroke axis and {} behind the hinge's axis",
            prefixed(wing.area(), "m^2"),
            prefixed(masses.mass, "kg"),
            prefixed(masses.radius, "m"),
            prefixed(masses.depth, "m"),
        ));
    }
    let offset = if args.offset.is_none() { on_offset(&plan, &args.preset) } else { None };
    for note in offset.into_iter().chain(on_area(&wing, &parameters)) {
        console::say(&note);
    }
    Ok(Exit::Done)
}

/// Returns an error if a computed parameter of the wing is outside its allowed range, for example for an
/// outline of extreme size.
fn check_ranges(plan: &Plan, wing: &Wing, parameters: &[(&str, f64)]) -> Result<(), Failure> {
    for (name, value) in parameters {
        let parameter = Parameter::index(plan.parameters(), name).map(|index| &plan.parameters()[index]);
        let Some(Parameter { unit, kind: Kind::Number(range) | Kind::Following(range, _), .. }) = parameter
        else {
            continue;
        };
        if !range.contains(*value) {
            let message = format!(
                "`{name}` of this wing is {}, but must be {}: the outline is {} long and reaches {} from the hinge's axis",
                prefixed(*value, unit),
                range.describe(),
                prefixed(wing.outline.length(), "m"),
                prefixed(wing.outline.width(), "m"),
            );
            return Err(Failure::usage(message)
                .help("check the units in the headings of the outline and in the options"));
        }
    }
    Ok(())
}

/// Returns a note if the wing root in `base`, the design from which flap starts, is not on the stroke axis.
/// Without `--offset`, the root of the new wing is on the stroke axis.
fn on_offset(plan: &Plan, base: &str) -> Option<String> {
    let index = Parameter::index(plan.parameters(), "wing_offset")?;
    let (place, remedy) = match plan.base()[index] {
        Value::Given(0.0) | Value::Resonance | Value::OfDesign => return None,
        Value::Given(offset) => {
            let offset = prefixed(offset, "m");
            let remedy = format!("--offset '{offset}' keeps that offset");
            (offset, remedy)
        }
        Value::Follows(others) => {
            let place = others.split(':').next().unwrap_or(others);
            let half = place.strip_prefix("half of ");
            let whole = half.and_then(|name| Parameter::index(plan.parameters(), name));
            match whole.and_then(|index| plan.base()[index].given()) {
                Some(whole) => {
                    let offset = prefixed(0.5 * whole, "m");
                    (format!("{place}, {offset}"), format!("--offset '{offset}' keeps that offset"))
                }
                None => (place.to_owned(), "set it with --offset".to_owned()),
            }
        }
    };
    Some(format!(
        "without --offset, the wing's root is on the stroke axis (wing_offset = 0 m), but in {base} it is at \
         {place}: {remedy}"
    ))
}

/// Returns a note if the area that results from the chord table differs from the area of the outline.
fn on_area(wing: &Wing, parameters: &[(&str, f64)]) -> Option<String> {
    let is_chord = |name: &str| name.strip_prefix("chord_").is_some_and(|rest| rest.parse::<usize>().is_ok());
    let chords = parameters.iter().filter(|(name, _)| is_chord(name)).map(|(_, chord)| *chord);
    let chords: [f64; STATIONS] = chords.collect::<Vec<_>>().try_into().ok()?;
    let tabulated = ChordTable::new(Tabulated::On, chords).mean() * wing.outline.length();
    let share = tabulated / wing.area();
    // The model rejects a table without any chord.
    if share == 0.0 || (share - 1.0).abs() <= CLOSE {
        return None;
    }
    let percent = 100.0 * (share - 1.0).abs();
    let comparison = if share < 1.0 { "less" } else { "more" };
    Some(format!(
        "chord_0 to chord_10, with straight lines between {STATIONS} stations, have {percent:.1} % {comparison} area than the \
         outline: multiply each chord by {:.4} to match the area of the outline",
        1.0 / share
    ))
}

/// Returns the masses of membrane and spar that the options describe, or `None` if the options describe no
/// mass.
fn material(args: &WingArgs) -> Result<Option<Material>, Failure> {
    let membrane = match (args.thickness, args.density) {
        (Some(thickness), Some(density)) => Some(thickness * density),
        (None, None) => None,
        _ => {
            return Err(Failure::usage("--thickness and --density are required together".to_owned())
                .help("thickness times density is the mass of the membrane per area".to_owned()));
        }
    };
    let spar = args.spar.unwrap_or(0.0);
    Ok(match (membrane, args.mass) {
        (Some(membrane), weighed) => Some(Material { membrane, spar, weighed }),
        // Without other options, the mass is spread evenly.
        (None, Some(mass)) if args.spar.is_none() => {
            Some(Material { membrane: 1.0, spar, weighed: Some(mass) })
        }
        (None, None) if args.spar.is_none() => None,
        (None, _) => {
            return Err(Failure::usage(
                "--spar requires --thickness and --density of the membrane".to_owned(),
            ));
        }
    })
}
