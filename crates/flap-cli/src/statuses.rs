//! The meanings of the statuses of rows.

use flap_core::simulate::Status;

/// Returns the meaning of a row's status as one line of text, with advice.
pub(crate) fn meaning(status: Status) -> &'static str {
    match status {
        Status::Periodic => "the motion has settled on an orbit of one drive period; the row has measures",
        Status::Unstable => {
            "an unstable orbit: nearby motions move away from the orbit; only `flap respond --unstable` writes such rows"
        }
        Status::Subharmonic => {
            "the motion has settled on an orbit of 2 to 8 drive periods, in which successive periods differ; the row has no measures"
        }
        Status::Unsettled => {
            "the motion has not settled after max_cycles drive periods: the motion is quasi-periodic, chaotic or slow. \
            `flap results rerun --status unsettled --max-cycles N` runs unsettled points longer"
        }
        Status::Diverged => {
            "the state became infinite or not a number: check the parameters against their units"
        }
        Status::StepLimit => {
            "one drive period needs more than max_steps integration steps: check the parameters against their units, or \
             raise max_steps in [solver]"
        }
        Status::Invalid => {
            "the combination of parameter values is impossible, or a derived parameter is out of range; `flap run GRID \
             --point N` prints the reason"
        }
    }
}
