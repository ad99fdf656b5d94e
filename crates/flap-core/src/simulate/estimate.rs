//! The estimate of a row's error.
//!
//! An orbit is measured twice: at the point's tolerances, and at tolerances coarser by a factor of 64. The orbit of the
//! coarser tolerances follows from the other by one period and the monodromy matrix. The error of the method is about
//! proportional to its tolerance, so about a sixty-fourth of the difference would be expected as the error. A single
//! difference may be small by chance, so half of it counts.

use crate::measure::cycle::Sums;
use crate::model::{Model, SignalCycle};
use crate::ode::{Ending, Outcome};

/// The share of the difference between both orbits that counts as error.
const SHARE: f64 = 0.5;

/// The share of its signal's size below which a measure counts as nothing beside the signal: its error is then relative to
/// this share of the size.
const NOTHING: f64 = 1e-3;

/// The least error that a row is said to have, in units of the relative tolerance: about that of finding extrema between
/// the ends of steps.
pub(super) const LEAST: f64 = 5.0;

/// Crossings of the switching surface in a period beyond which the motion counts as sliding along the surface: others
/// cross it twice, or some times more. The error of a sliding motion does not fall as the method's does.
pub(super) const MANY_SWITCHES: u64 = 16;

/// A period of the orbit, and one of the orbit that coarser integration has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Compared<const S: usize> {
    /// Totals of the orbit's period, unless it failed.
    pub(super) fine: Option<Sums<f64, S>>,
    /// The ending of the orbit's period.
    pub(super) ending: Ending,
    /// The orbit slides along the switching surface.
    pub(super) slides: bool,
    /// Totals of the other period, unless that failed.
    pub(super) coarse: Option<Sums<f64, S>>,
}

impl<const S: usize> Compared<S> {
    /// Before anything has been integrated.
    pub(super) fn new() -> Compared<S> {
        Compared { fine: None, ending: Ending::Stopped, slides: false, coarse: None }
    }

    /// Takes the totals of the orbit's period, unless it failed.
    pub(super) fn take_fine(&mut self, totals: Option<Sums<f64, S>>, outcome: Outcome) {
        self.fine = totals;
        self.ending = outcome.ending;
        self.slides = outcome.switches > MANY_SWITCHES;
    }
}

/// The largest relative error of the model's principal measures, such as stroke, pitch, lift and power. Infinite if it
/// cannot be estimated: the coarser integration failed, or the motion slides along the switching surface.
pub(super) fn estimate<M: Model<N, S>, const N: usize, const S: usize>(
    fine: &[SignalCycle; S],
    coarse: Option<&[SignalCycle; S]>,
    slides: bool,
) -> f64 {
    let Some(coarse) = coarse.filter(|_| !slides) else { return f64::INFINITY };
    let mut largest = 0.0_f64;
    for (i, signal) in M::SIGNALS.iter().enumerate() {
        let Some(principal) = signal.principal else { continue };
        let [value, other] = [fine, coarse].map(|cycle| cycle[i].measure(principal.measure()));
        let difference = (other - value).abs();
        // A prescribed stroke has no power, and a wing at rest nothing.
        if difference > 0.0 {
            largest = largest.max(SHARE * difference / value.abs().max(NOTHING * fine[i].size()));
        }
    }
    largest
}
