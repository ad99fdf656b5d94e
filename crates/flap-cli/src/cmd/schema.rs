//! `flap schema`: a JSON schema of grid files, for editors.

use flap_sweep::grid::schema;

use crate::args::SchemaArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::models;

pub(crate) fn run(args: &SchemaArgs) -> Result<Exit, Failure> {
    let schema = match &args.preset {
        None => schema::of_models(models::all()),
        Some(name) => {
            let (model, preset) = models::preset(name).ok_or_else(|| unknown(name))?;
            schema::of_preset(model, preset)
        }
    };
    console::results(&format!("{schema:#}\n"))?;
    Ok(Exit::Done)
}

fn unknown(name: &str) -> Failure {
    let failure = Failure::usage(format!("there is no preset `{name}`"));
    failure.nearest(name, models::presets(), "`flap models` lists models and presets")
}
