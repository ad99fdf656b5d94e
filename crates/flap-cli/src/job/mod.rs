//! Work that several commands share: running a plan and writing its rows to a file, opening results, and
//! writing other files.

pub(crate) mod exclusion;
mod make;
mod open;
mod report;
mod run;
mod verdicts;

pub(crate) use flap_sweep::files::job::{OnExisting, to_resume};
pub(crate) use make::make;
pub(crate) use open::{
    open, open_recorded, plan_of, read_sidecar, recorded, require_checkpoint, require_own_sidecar, tell,
    tell_missed, with_refinement,
};
pub(crate) use run::{exit_code, run, run_and_summarize, run_with_progress};
pub(crate) use verdicts::{Lines, Verdicts};
