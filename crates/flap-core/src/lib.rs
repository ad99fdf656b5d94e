#![doc = include_str!("../README.md")]
//!
//! # Layers
//!
//! Each layer uses only those above it:
//!
//! - [`num`]: the numbers that models and integrators compute with, scalars or SIMD lanes
//! - [`ode`]: Dormand-Prince 5(4), for one run or for many in lanes
//! - [`parameter`]: names, units, ranges and meaning of a design point's numbers
//! - [`quadrature`], [`drive`], [`piezo`], [`linkage`], [`aero`], [`modes`]: components that models share
//! - [`model`]: the papers' models: parameters → constants → equations of motion → signals
//! - [`measure`]: measures of a motion, the same for every model
//! - [`simulate`]: design points in, rows out
//! - `experiments`: chirps, impulses and given motions of a model
//! - [`vehicle`]: several wings, whose forces and torques add up

pub mod aero;
pub mod drive;
mod experiments;
pub mod linkage;
pub mod measure;
pub mod model;
pub mod modes;
pub mod num;
pub mod ode;
pub mod parameter;
pub mod piezo;
pub mod quadrature;
pub mod simulate;
pub mod vehicle;

/// A hash of the sources of this crate, in hexadecimal digits: builds with the same one compute the same rows.
pub const SOURCES: &str = env!("FLAP_SOURCES");
