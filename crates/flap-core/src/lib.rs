//! Physics and numerics of flap.
//!
//! Layers, each using only those above it:
//!
//! - [`num`]: the numbers models and integrators compute with, scalar or SIMD lanes
//! - [`model`]: the papers' models, their parameters and presets
//!
//! This crate prints nothing, opens no file, spawns no thread and reads no clock.

pub mod model;
