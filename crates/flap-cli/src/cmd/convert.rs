//! `flap convert`: results in another format.

use std::io::ErrorKind;

use flap_sweep::identity::Identity;
use flap_sweep::inputs::Inputs;
use flap_sweep::results::{ConvertError, Format, Provenance, convert};
use flap_sweep::sidecar;

use crate::args::ConvertArgs;
use crate::cmd::outputs::is_stdout;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::job;

pub(crate) fn run(args: &ConvertArgs) -> Result<Exit, Failure> {
    let from = Format::of(&args.from)?;
    let to = if is_stdout(&args.to) { Format::Csv } else { Format::of(&args.to)? };
    let mut inputs = Inputs::new();
    inputs.add_results("the results", &args.from).protect_from_results(&args.to)?;
    let (plan, sidecar) = job::recorded(&args.from)?;
    inputs.add_plan(&plan).protect_from_results(&args.to)?;
    let provenance = Provenance::of(&plan, &Identity::recorded(&sidecar));
    let source = job::open(&args.from)?;
    if is_stdout(&args.to) {
        convert((source, from), (job::stdout()?, to), &provenance).map_err(|error| failure(args, &error))?;
        return Ok(Exit::Done);
    }
    let mut rows = 0;
    let made = job::make(&args.to, args.force, |target| {
        rows = convert((source, from), (target, to), &provenance)?;
        // Earlier results keep their own until the new rows are complete.
        Ok::<(), ConvertError>(sidecar.write(&sidecar::path_of(&args.to))?)
    });
    made?.map_err(|error| failure(args, &error))?;
    console::say(&format!("{rows} rows in {}", args.to.display()));
    Ok(Exit::Done)
}

fn failure(args: &ConvertArgs, error: &ConvertError) -> Failure {
    let path = match error {
        ConvertError::Write(source) if source.kind() == ErrorKind::BrokenPipe => return Failure::ClosedPipe,
        ConvertError::Read(_) | ConvertError::Columns => &args.from,
        ConvertError::Write(_) => &args.to,
    };
    Failure::System(format!("{}: {error}", path.display()), Vec::new())
}
