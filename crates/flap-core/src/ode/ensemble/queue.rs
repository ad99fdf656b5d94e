//! The source of an ensemble's runs.

use core::ops::ControlFlow;

use super::observer::Observer;
use crate::ode::{Ode, Outcome, Start};

/// A run to be started: the caller's note of it, and its beginning.
pub type NewRun<Run, C, const N: usize> = (Run, Start<C, N>);

/// The continuation of a run, with the same constants and the same span.
#[derive(Clone, Copy, Debug)]
pub struct Continuation<const N: usize> {
    /// The state at its beginning.
    pub y: [f64; N],
    /// As [`Start::scale`].
    pub scale: [f64; N],
    /// As [`Start::tighten`].
    pub tighten: f64,
}

impl<C, const N: usize> From<&Start<C, N>> for Continuation<N> {
    fn from(start: &Start<C, N>) -> Continuation<N> {
        Continuation { y: start.y, scale: start.scale, tighten: start.tighten }
    }
}

/// A source of runs, which also receives their results.
pub trait Queue<O: Ode<N>, V: Observer<O, N>, const N: usize> {
    /// The caller's note of a run while it is in a lane.
    type Run;

    /// The next run, or `None` if there is none for now.
    ///
    /// With `idle`, no lane is running: the call may wait, and `None` ends the ensemble.
    fn next(&mut self, idle: bool) -> Option<NewRun<Self::Run, O::Constants<f64>, N>>;

    /// Looks at a run at the end of a span, and goes on with it or breaks.
    fn span_end(&mut self, run: &mut Self::Run, y: &[f64; N], totals: &V::Totals<f64>) -> ControlFlow<()>;

    /// Takes leave of a run that has been stopped or has failed; or returns it with its continuation, for which it stays in
    /// its lane.
    fn ended(&mut self, run: Self::Run, outcome: Outcome) -> Option<(Self::Run, Continuation<N>)>;

    /// True to end at once. Runs in lanes are dropped; see [`Interrupt`](crate::ode::Interrupt).
    fn interrupted(&self) -> bool {
        false
    }
}
