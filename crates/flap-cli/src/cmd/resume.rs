//! `flap resume`: an interrupted sweep, from its results alone.

use crate::args::ResumeArgs;
use crate::failure::{Exit, Failure};
use crate::job::{self, Begin, Job};

pub(crate) fn run(args: &ResumeArgs) -> Result<Exit, Failure> {
    let (plan, sidecar) = job::recorded(&args.results)?;
    let origin = sidecar.origin();
    job::run(&Job { plan, out: args.results.clone(), begin: Begin::Resume, work: &args.work, origin })
}
