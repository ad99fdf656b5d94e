//! Number types of models and integrators.
//!
//! A model's equations are generic over [`Real`]. They run on `f64` (one point at a time) and on [`Vector`] (one
//! point per SIMD lane), with the same bits from both:
//!
//! - no operation mixes lanes, so a lane never depends on its neighbours;
//! - elementary functions are polynomials of this crate, never calls of std or the C library;
//! - Rust neither reassociates nor contracts floating-point expressions.
//!
//! [`Real`] contains all operations of the equations. [`Lanes`] adds the access to single lanes that the integrator
//! needs. [`PerLane`] is a group of numbers. A [`Backend`] chooses the instructions.
//!
//! `mul_add` rounds once on processors with a fused multiply-add (AVX2, AVX-512, NEON), and twice on other processors.
//! Results of the two [arithmetic classes](Arithmetic) differ by about the integration tolerance. Results of the same
//! class are equal to the last bit.

#[cfg(target_arch = "x86_64")]
mod avx512;
mod backend;
mod functions;
mod lanes;
mod macros;
mod pair;
mod per_lane;
mod real;
mod register;
mod scalar;

pub use backend::{Arithmetic, Backend, Kernel};
pub use lanes::{Lanes, Simd, Vector};
pub use per_lane::PerLane;
pub use real::Real;
pub use scalar::{OneLane, Scalar, Unfused};
