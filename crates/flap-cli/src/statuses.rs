//! The meanings of the statuses of rows.

use flap_core::simulate::Status;

/// Returns the meaning of a status in one line, with advice.
pub(crate) fn meaning(status: Status) -> &'static str {
    match status {
        Status::Periodic => "settled on an orbit of one drive period; the row has measures",
        Status::Unstable => {
            "an unstable orbit: motions near it move away from it; only `flap respond --unstable` writes such rows"
        }
        Status::Subharmonic => {
            "settled on an orbit of 2 to 8 drive periods, in which successive periods differ; the row has no measures"
        }
        Status::Unsettled => {
            "not settled after max_cycles drive periods: quasi-periodic, chaotic or slow. `flap results rerun --status unsettled \
             --max-cycles N` runs such points longer"
        }
        Status::Diverged => {
            "the state became infinite or not a number: check the parameters against their units"
        }
        Status::StepLimit => {
            "more than max_steps integration steps in one drive period: check the parameters against their units, or \
             raise max_steps in [solver]"
        }
        Status::Invalid => {
            "the parameters are impossible together, or a derived one is out of its range; `flap run GRID --point N` \
             prints the reason"
        }
    }
}
