//! Experiments on single points of a model: the implementation of [`Experiments`](crate::simulate::Experiments).
//!
//! - `chirp`: a drive whose frequency changes steadily
//! - `impulse`: the free motion after an impulse, with the drive held still
//! - `runner`: forces along a given motion

mod chirp;
mod impulse;
mod runner;
