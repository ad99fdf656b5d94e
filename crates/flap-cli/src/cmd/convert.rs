//! `flap convert`: results in another format.

use flap_sweep::identity::Identity;
use flap_sweep::results::{ConvertError, Format, Provenance, convert};
use flap_sweep::sidecar;

use crate::args::ConvertArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::job;

pub(crate) fn run(args: &ConvertArgs) -> Result<Exit, Failure> {
    let (from, to) = (Format::of(&args.from)?, Format::of(&args.to)?);
    let (plan, sidecar) = job::recorded(&args.from)?;
    let provenance = Provenance::of(&plan, &Identity::recorded(&sidecar));
    let source = job::open(&args.from)?;
    let mut rows = 0;
    let made = job::make(&args.to, args.force, |target| {
        convert((source, from), (target, to), &provenance).map(|converted| rows = converted)
    });
    made?.map_err(|error| failure(args, &error))?;
    let path = sidecar::path_of(&args.to);
    sidecar.write(&path).map_err(|error| Failure::cannot_write(&path, &error))?;
    console::say(&format!("{rows} rows in {}", args.to.display()));
    Ok(Exit::Done)
}

fn failure(args: &ConvertArgs, error: &ConvertError) -> Failure {
    let path = match error {
        ConvertError::Read(_) | ConvertError::Columns => &args.from,
        ConvertError::Write(_) => &args.to,
    };
    Failure::System(format!("{}: {error}", path.display()), Vec::new())
}
