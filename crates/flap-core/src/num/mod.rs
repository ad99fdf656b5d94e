//! The numbers that models and integrators compute with.
//!
//! A model's equations are written once, generic over [`Real`]. They then run on
//! `f64` (one point at a time) and on [`Vector`] (one point per SIMD lane), with the same bits from both:
//!
//! - no operation mixes lanes, so a lane never depends on its neighbours;
//! - elementary functions are the polynomials of [`functions`], never those of std or the C library;
//! - Rust neither reassociates nor contracts floating-point expressions.
//!
//! [`Number`] is arithmetic, [`Real`] adds elementary functions, and [`Lanes`] adds the access to single lanes that the
//! integrator needs. A type that implements [`Number`] and [`Float`] has the functions of [`Real`].
//!
//! `mul_add` rounds once where the processor has a fused multiply-add (AVX2, AVX-512, NEON) and twice where
//! it has not. Results of the two [arithmetic classes](Arithmetic) differ at the level of the integration
//! tolerance; within a class they are equal to the last bit.

#[cfg(target_arch = "x86_64")]
mod avx512;
mod backend;
mod float;
pub mod functions;
mod lanes;
mod number;
mod operators;
mod pair;
mod per_lane;
mod real;
mod register;
mod scalar;
mod simd;
mod unfused;

pub use backend::{Arithmetic, Backend, Kernel, ScalarKernel};
pub use float::Float;
pub use lanes::Lanes;
pub use number::Number;
pub use per_lane::PerLane;
pub use real::Real;
pub use scalar::Scalar;
pub use simd::{Simd, Vector};
pub use unfused::Unfused;
