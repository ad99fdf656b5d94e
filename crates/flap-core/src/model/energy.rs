//! The balance of energy over a periodic orbit.

use super::signal::SignalCycle;

/// The balance of energy over a periodic orbit: the mean of a power is the sum of the means of its losses, since capacitance,
/// springs and inertia give back all energy within a period.
///
/// In a motion of small losses, or far from resonance, the quadrature's error in that exchange may exceed the mean of the
/// power; the losses have no such part. All numbers are positions in [`Model::SIGNALS`](super::Model::SIGNALS).
#[derive(Clone, Copy, Debug)]
pub struct EnergyBalance {
    /// The powers, each with its losses.
    pub powers: &'static [(usize, &'static [usize])],
    /// A power, and the signal that has the same mean but for the integration's error.
    pub audit: [usize; 2],
}

impl EnergyBalance {
    /// Replaces the means of the powers by those of the losses. The mean of a power that is not known stays not a number.
    pub fn close(&self, cycle: &mut [SignalCycle]) {
        for &(power, losses) in self.powers {
            if !cycle[power].mean.is_nan() {
                cycle[power].mean = losses.iter().map(|&loss| cycle[loss].mean).sum();
            }
        }
    }

    /// The relative difference of the two means of [`EnergyBalance::audit`], after [`EnergyBalance::close`].
    pub fn audit(&self, cycle: &[SignalCycle]) -> f64 {
        let [power, same] = self.audit;
        cycle[power].audit(&cycle[same])
    }
}
