//! `flap wing`: the parameters of a wing of one's own.

use flap_core::aero::{Material, Wing};
use flap_core::parameter::Parameter;
use flap_sweep::files::outline;
use flap_sweep::grid;

use super::point;
use crate::args::WingArgs;
use crate::console;
use crate::failure::{Exit, Failure};

/// Density of air (kg/m³) of models that do not say.
const AIR_DENSITY: f64 = 1.2;

pub(crate) fn run(args: &WingArgs) -> Result<Exit, Failure> {
    let plan = point::plan(&args.preset)?;
    let outline = outline::read(&args.outline)
        .map_err(|error| Failure::usage(error.to_string()).help(error.help().to_owned()))?;
    let air = Parameter::index(plan.parameters(), "air_density").and_then(|index| plan.base()[index].given());
    let wing = Wing {
        outline,
        offset: args.offset,
        material: material(args)?,
        air_density: air.unwrap_or(AIR_DENSITY),
    };
    let parameters = plan.simulator().wing(&wing);
    if parameters.is_empty() {
        let message = format!("the model {} does not take its wing from an outline", plan.simulator().name());
        return Err(Failure::usage(message));
    }
    console::results(&grid::wing(&plan, &args.preset, &parameters))?;
    if wing.material.is_none() {
        console::say(
            "without --mass, or --thickness and --density, the wing's mass and inertias stay those of the preset",
        );
    }
    if let Some(masses) = wing.masses() {
        console::say(&format!(
            "the wing has {} and {}; its centre of mass is {} from the stroke axis and {} behind the hinge's axis",
            flap_sweep::notation::units::prefixed(wing.area(), "m^2"),
            flap_sweep::notation::units::prefixed(masses.mass, "kg"),
            flap_sweep::notation::units::prefixed(masses.radius, "m"),
            flap_sweep::notation::units::prefixed(masses.depth, "m"),
        ));
    }
    Ok(Exit::Done)
}

/// The material that the options give, if they do.
fn material(args: &WingArgs) -> Result<Option<Material>, Failure> {
    let membrane = match (args.thickness, args.density) {
        (Some(thickness), Some(density)) => Some(thickness * density),
        (None, None) => None,
        _ => {
            return Err(Failure::usage("--thickness and --density go together".to_owned())
                .help("their product is the mass of the membrane per area".to_owned()));
        }
    };
    let spar = args.spar.unwrap_or(0.0);
    Ok(match (membrane, args.mass) {
        (Some(membrane), weighed) => Some(Material { membrane, spar, weighed }),
        // Weighed alone: uniform.
        (None, Some(mass)) if args.spar.is_none() => {
            Some(Material { membrane: 1.0, spar, weighed: Some(mass) })
        }
        (None, None) if args.spar.is_none() => None,
        (None, _) => {
            return Err(Failure::usage("--spar needs --thickness and --density of the membrane".to_owned()));
        }
    })
}
