#![doc = include_str!("../README.md")]
//!
//! # Layers
//!
//! Each layer uses only the layers that are above it in this list:
//!
//! - [`num`]: number types of models and integrators: scalars and SIMD lanes
//! - [`ode`]: Dormand-Prince 5(4) integrator, for one simulation or for several simulations in lanes
//! - [`parameter`]: names, units, ranges and descriptions of the parameters of a design point
//! - [`quadrature`], [`drive`], [`piezo`], [`linkage`], [`springs`], [`body`], [`aero`], [`modes`]: components that several models use
//! - [`model`]: the published models: their parameters, constants, equations of motion and signals
//! - [`measure`]: computation of measures from a motion, for any model
//! - [`simulate`]: computation of the rows of design points, and of chirps, impulses and imposed motions
//! - [`vehicle`]: sums of the forces and torques of several wings

pub mod aero;
pub mod body;
pub mod drive;
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
pub mod springs;
pub mod vehicle;

/// Hash of this crate's source files, in hexadecimal digits. Two builds of flap with equal hashes compute
/// equal rows.
pub const SOURCES: &str = env!("FLAP_SOURCES");
