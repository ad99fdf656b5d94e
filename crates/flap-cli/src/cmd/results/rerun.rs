//! `flap results rerun`: runs points of earlier results again with different solver settings.

use flap_sweep::files::inputs::Inputs;
use flap_sweep::files::rerun::{self, RerunError, Wanted};
use flap_sweep::files::sidecar::Origin;

use crate::args::RerunArgs;
use crate::cmd::point::with_solver;
use crate::console;
use crate::failure::{Exit, Failure};
use crate::job;

pub(super) fn run(args: &RerunArgs) -> Result<Exit, Failure> {
    let of = args.results.display();
    Inputs::new().add_results("the results", &args.results).protect_from_results(&args.out)?;
    let (mut source, plan, sidecar) = job::open_recorded(&args.results, &args.read)?;
    if plan.followed().is_some() {
        let failure =
            Failure::usage(format!("{of} holds curves of `flap respond`, whose rows depend on each other"));
        return Err(failure.help("run `flap respond` again with other solver settings"));
    }
    let unreadable = |error: RerunError| match error {
        RerunError::NoEstimate => Failure::usage(format!("{of}: {error}"))
            .help("add the column to `columns` and sweep again, or choose points with --status"),
        _ => Failure::system(format!("cannot read {of}: {error}")),
    };
    let rows = sidecar.rows();
    let accuracy = args.inaccurate.then_some(plan.solver().accuracy);
    let wanted = Wanted { statuses: args.status.clone(), accuracy };
    let list = rerun::points(&mut source.reader, &wanted, &plan, rows).map_err(unreadable)?;
    let plan = job::with_refinement(plan, &args.results, &sidecar, list.last().copied())?;
    job::tell_missed(&args.results, &source.reader);
    let statuses = wanted.words();
    if list.is_empty() {
        console::say(&format!(
            "no point in {of} is {}: nothing is left to run, and no file is written",
            statuses.join(" or ")
        ));
        return Ok(Exit::Done);
    }
    let plan = with_solver(plan.with_points(list)?, &args.solver)?;
    let origin = Some(Origin { of: of.to_string(), statuses });
    job::run(&plan, args.out.clone(), args.begin.on_existing(), &args.begin.work, origin)
}
