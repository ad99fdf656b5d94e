//! `flap test chirp`: the motion while the drive frequency changes.

use flap_core::simulate::ChirpRequest;
use flap_sweep::files::inputs::Inputs;
use flap_sweep::study::experiment;

use crate::args::ChirpArgs;
use crate::cmd::motion::write_file;
use crate::cmd::outputs;
use crate::cmd::point::{Chosen, check_one_wing};
use crate::console::is_stdout;
use crate::failure::{Exit, Failure};
use crate::print;

pub(super) fn run(args: &ChirpArgs) -> Result<Exit, Failure> {
    let chosen = Chosen::new(&args.point, &args.solver)?;
    let Chosen { plan, values, .. } = &chosen;
    check_one_wing(plan, &args.point.what, "`flap test chirp`")?;
    let mut inputs = Inputs::new();
    inputs.add_plan(plan);
    outputs::check_tables(&inputs, [args.trajectory.as_deref(), args.out.as_deref()])?;
    let frequency = plan.parameters().iter().position(|parameter| parameter.name == "drive_frequency");
    let request = ChirpRequest {
        from: args.from,
        to: args.to.or(frequency.map(|index| 2.0 * values[index])).unwrap_or(args.from),
        rate: args.rate,
        samples_per_cycle: if args.trajectory.is_some() { args.samples } else { 0 },
    };
    let response = experiment::chirp(plan.simulator().experiments()?, &chosen.run(), &request)?;
    if let Some(path) = &args.trajectory {
        write_file(&response.motion, path, args.overwrite.force, "sample")?;
    }
    match &args.out {
        Some(path) if !is_stdout(path) => {
            write_file(&response.envelope, path, args.overwrite.force, "cycle")?;
        }
        // Stdout has the motion.
        _ if args.trajectory.as_deref().is_some_and(is_stdout) => {}
        _ => print::motion(args.format, &response.envelope)?,
    }
    Ok(Exit::Done)
}
