//! The steps of a search.

/// The next step of a search.
#[derive(Clone, Copy, Debug)]
pub(in crate::simulate) enum Next<const N: usize> {
    /// Periods from this state, until `Search::period_end` breaks.
    March([f64; N]),
    /// A period from this state, with its responses to changes of it.
    Vary([f64; N]),
    /// A period along the orbit and one along that of coarser tolerances, both measured: see `Search::orbit` and
    /// `Search::coarse_orbit`.
    Measure,
    /// None: the search has ended without an orbit.
    Done,
}
