//! The multipliers of an orbit of several drive periods.

use super::newton::Newton;
use super::next::Next;
use crate::measure::multipliers::{identity, product, spectral_radius};

/// The way along a subharmonic orbit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round<const N: usize> {
    /// Drive periods to go.
    left: u32,
    /// The monodromy matrix of the way so far, see [`Newton::monodromy`]; not numbers if a period failed.
    monodromy: [[f64; N]; N],
}

impl<const N: usize> Round<N> {
    /// The way along an orbit of this many drive periods.
    pub(super) fn new(periods: u32) -> Round<N> {
        Round { left: periods, monodromy: identity() }
    }

    /// Largest modulus of the Floquet multipliers of the orbit.
    pub(super) fn floquet_max(&self) -> f64 {
        spectral_radius(&self.monodromy)
    }

    /// The step after a period of the orbit with its responses; `None` if the period could not be integrated.
    pub(super) fn pass<const K: usize>(&mut self, newton: &Newton<N>, all: Option<&[f64; K]>) -> Next<N> {
        let Some(all) = all else {
            self.monodromy = [[f64::NAN; N]; N];
            return Next::Done;
        };
        self.monodromy = product(&newton.monodromy(all), &self.monodromy);
        self.left -= 1;
        if self.left == 0 { Next::Done } else { Next::Vary(core::array::from_fn(|i| all[i])) }
    }
}
