//! `flap results resume`: continues an interrupted sweep. The grid comes from the sidecar of the unfinished
//! results.

use flap_sweep::files::integrity::OnDamage;
use flap_sweep::files::results::Format;
use flap_sweep::files::sidecar::State;

use crate::args::ResumeArgs;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::job::{self, OnExisting};

pub(super) fn run(args: &ResumeArgs) -> Result<Exit, Failure> {
    Failure::unless_results(&args.results)?;
    Format::of(&args.results)?;
    let on_damage = args.read.on_damage();
    let results = job::to_resume(&args.results);
    let (plan, sidecar) = job::recorded(&results, on_damage)?;
    job::require_own_sidecar(&results, &sidecar)?;
    if on_damage == OnDamage::Tolerate && sidecar.state == State::Complete {
        // Nothing is left to run, even if rows are damaged.
        job::open(&results, &args.read)?;
        console::say(&format!("{} is complete: nothing is left to run", results.display()));
        return Ok(Exit::Done);
    }
    let origin = sidecar.origin().cloned();
    job::run(&plan, args.results.clone(), OnExisting::Continue, &args.work, origin)
}
