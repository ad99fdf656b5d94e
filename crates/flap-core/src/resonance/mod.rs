//! The resonances of a design point, as papers determine them.
//!
//! - the natural frequencies of small undamped motions: [`Experiments::modes`](crate::simulate::Experiments::modes)
//! - [`free`]: the motion after an impulse: a damped sine fitted to it, the peaks of its spectrum
//! - the drive frequency at which the settled stroke is largest, found by the search in `flap_sweep`
//!
//! They can differ: damping that grows with the amplitude and forces that are not linear shift each of them
//! differently.

pub mod free;
