//! Number types of models and integrators.
//!
//! A model's equations are generic over [`Real`]. The equations run on `f64` (one point at a time) and on
//! [`Vector`] (one point for each SIMD lane). The results with the two types are equal to the last bit, for
//! these reasons:
//!
//! - no operation combines numbers of different lanes, so the result in a lane never depends on other lanes;
//! - elementary functions are polynomials in this crate, and not functions of std or the C library;
//! - the Rust compiler neither changes the order of floating-point operations nor fuses them.
//!
//! [`Real`] contains all operations of the equations. [`Lanes`] adds the access to single lanes that the
//! integrator needs. [`PerLane`] is a group of numbers, such as the constants of a point, with separate
//! values in each lane. A [`Backend`] is a set of SIMD instructions, or arithmetic on scalars.
//!
//! `mul_add` rounds once on processors with a fused multiply-add (AVX2, AVX-512, NEON), and twice on other
//! processors. Results of the two [arithmetic classes](Arithmetic) differ by about the integration tolerance.
//! Results with the same arithmetic class are equal to the last bit.

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
