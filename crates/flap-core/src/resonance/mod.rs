//! The resonances of a design point, by the ways in which papers look for them.
//!
//! - the natural frequencies of small undamped motions: [`Experiments::modes`](crate::simulate::Experiments::modes)
//! - [`free`]: the motion after an impulse: a damped sine fitted to it, the peaks of its spectrum
//! - the drive frequency at which the settled stroke is largest, which needs a search: it is in `flap_sweep`
//!
//! They need not agree: damping that grows with the amplitude and forces that are not linear move each of them
//! differently.

pub mod free;
