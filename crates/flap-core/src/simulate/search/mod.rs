//! The search for the periodic orbit that a point approaches: marching, with Newton's iteration when the march is near.
//!
//! With progressive tolerances a search marches and makes the first iterations at looser tolerances, and returns to those
//! asked for only for the last steps, see `progressive`.

mod chord;
mod closing;
mod cost;
mod full;
mod march;
mod newton;
mod next;
mod precision;
mod progressive;
mod round;
mod state;

use core::ops::ControlFlow;

pub(super) use self::next::Next;
pub(super) use self::state::Search;

use self::newton::Newton;
use self::round::Round;
use self::state::Stage;
use super::settings::SolverSettings;
use crate::ode::{Ending, Outcome, Start};

impl<const N: usize> Search<N> {
    /// A search that begins at `start`; `nearby` if that is perhaps near the orbit.
    pub(super) fn new<C>(start: &Start<C, N>, solver: &SolverSettings, nearby: bool) -> Search<N> {
        let search = Search::at_full_tolerance(start, solver, nearby);
        let progressive = solver.newton && solver.progressive && !nearby;
        if progressive { search.loosened(&start.y, solver) } else { search }
    }

    /// Takes the state at the end of a period of the states alone, with the largest magnitude of each state so far, and
    /// goes on marching or breaks.
    pub(super) fn period_end(&mut self, y: &[f64; N], largest: &[f64; N]) -> ControlFlow<()> {
        match &mut self.stage {
            Stage::Nearing(chord) | Stage::Approaching(chord) | Stage::Closing(chord) => {
                chord.period_end(y);
                return ControlFlow::Break(());
            }
            Stage::Known { .. } => {
                self.coarse = self.found.and_then(|orbit| orbit.of_map(&self.scale, y));
                return ControlFlow::Break(());
            }
            Stage::Loose | Stage::Mapping | Stage::Full | Stage::Refining => {}
        }
        self.period = self.march.period_end(y, largest);
        let ready = self.march.is_to_pause(self.precision.size()) && !self.coasts();
        if self.period.is_some() || ready { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The step after periods of the states alone.
    pub(super) fn marched(&mut self, outcome: Outcome) -> Next<N> {
        if let Stage::Known { .. } = self.stage {
            self.charge(outcome);
            return Next::Measure;
        }
        let is_march = matches!(self.stage, Stage::Loose | Stage::Full);
        if is_march {
            self.cost.add_marched(outcome);
        } else {
            self.charge(outcome);
        }
        self.ending = outcome.ending;
        if self.ending != Ending::Stopped {
            return self.fall_back();
        }
        match self.stage {
            Stage::Nearing(chord) => self.near(chord),
            Stage::Approaching(chord) => self.approach(chord),
            Stage::Closing(chord) => self.close(chord),
            _ => self.pause(),
        }
    }

    /// The step after a march that has settled, is perhaps near its orbit, or is to go on with other tolerances.
    fn pause(&mut self) -> Next<N> {
        self.precision.resize(self.march.motion_size());
        match self.period {
            Some(1) => {}
            None if self.march.is_promising() => {}
            None if self.march.is_exhausted() => return self.fall_back(),
            None => return Next::March(*self.march.state()),
            Some(_) if self.fallback.is_some() => return self.fall_back(),
            Some(period) => self.round = Some(Round::new(period)),
        }
        self.newton = Newton::new(self.march.state(), &self.scale, self.tolerance);
        if let Stage::Loose = self.stage { self.iterate_loosely() } else { Next::Vary(*self.march.state()) }
    }

    /// The step after a period with its responses; `None` if the period could not be integrated.
    pub(super) fn varied<const K: usize>(&mut self, all: Option<&[f64; K]>, outcome: Outcome) -> Next<N> {
        // Each evaluation is one of the states and one of each response.
        self.cost.add_period(outcome, u32::try_from(N + 1).unwrap_or(u32::MAX));
        if let Some(round) = &mut self.round {
            return round.pass(&self.newton, all);
        }
        match self.stage {
            Stage::Loose => self.vary_loosely(all),
            Stage::Mapping => self.map(all),
            Stage::Refining => self.refined(all),
            _ => self.iterate(all),
        }
    }
}
