//! `flap resume`: an interrupted sweep, from its results alone.

use flap_sweep::results::Format;

use crate::args::ResumeArgs;
use crate::failure::{Exit, Failure};
use crate::job::{self, Begin};

pub(crate) fn run(args: &ResumeArgs) -> Result<Exit, Failure> {
    Format::of(&args.results)?;
    let (plan, sidecar) = job::recorded(&args.results)?;
    let origin = sidecar.origin();
    job::run(&plan, args.results.clone(), Begin::Resume, &args.work, origin)
}
