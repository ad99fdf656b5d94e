//! Sets of instructions, as types.

use super::lanes::Lanes;
use super::pair::Pair;
use super::register::Register;

/// Proof that the processor has a set of instructions: SIMD, or [`OneLane`](super::OneLane) for scalars.
pub trait Simd: Copy {
    /// The lanes that are computed with them: two registers of `f64`, or one scalar.
    type Vector: Lanes<Token = Self>;

    /// Calls `work` from a function in which the instructions are enabled. What is called there must be
    /// `#[inline(always)]` to be compiled with them.
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T;
}

/// SIMD lanes: 16 with AVX-512, 8 with AVX2, 4 with SSE2 and NEON.
pub type Vector<S> = <S as Simd>::Vector;

impl<S: fearless_simd::Simd> Simd for S {
    type Vector = Pair<Register<S>>;

    #[inline(always)]
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T {
        fearless_simd::Simd::vectorize(self, work)
    }
}
