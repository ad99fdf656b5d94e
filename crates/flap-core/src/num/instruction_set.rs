//! Which instructions this machine has, and how code is run with them.

use core::fmt;

use fearless_simd::{Level, Simd};

use super::{Scalar, Unfused};

/// Whether `mul_add` rounds once or twice. Results are equal to the last bit within a class.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// Fused multiply-add: AVX2, AVX-512, NEON.
    Fused,
    /// Separate multiplication and addition: x86-64 before FMA.
    Unfused,
}

impl Arithmetic {
    /// The name in the provenance of a run.
    pub fn name(self) -> &'static str {
        match self {
            Arithmetic::Fused => "fma",
            Arithmetic::Unfused => "no-fma",
        }
    }
}

/// A set of SIMD instructions that this machine has.
#[derive(Clone, Copy, Debug)]
pub struct InstructionSet(Level);

/// Work that is generic over SIMD instructions.
pub trait Kernel {
    /// What the work results in.
    type Output;

    /// Does the work with the instructions of `S`. Mark implementations `#[inline(always)]`.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

impl InstructionSet {
    /// The best this machine has.
    pub fn best() -> InstructionSet {
        InstructionSet(Level::new())
    }

    /// All that this machine has, best first.
    pub fn available() -> Vec<InstructionSet> {
        let best = Level::new();
        let mut sets = vec![InstructionSet(best)];
        #[cfg(target_arch = "x86_64")]
        {
            if best.as_avx512().is_some() {
                sets.extend(best.as_avx2().map(|token| InstructionSet(Level::Avx2(token))));
            }
            if best.as_avx2().is_some() {
                sets.extend(best.as_sse2().map(|token| InstructionSet(Level::Sse2(token))));
            }
        }
        sets
    }

    /// The available set with this [name](InstructionSet::name).
    pub fn by_name(name: &str) -> Option<InstructionSet> {
        Self::available().into_iter().find(|set| set.name() == name)
    }

    /// The name in the provenance of a run: `avx512`, `avx2`, `sse2` or `neon`.
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => "avx512",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Level::Sse2(_) | Level::Sse4_2(_) => "sse2",
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => "neon",
            _ => "scalar",
        }
    }

    /// The class of its arithmetic.
    pub fn arithmetic(self) -> Arithmetic {
        match self.name() {
            "avx512" | "avx2" | "neon" => Arithmetic::Fused,
            _ => Arithmetic::Unfused,
        }
    }

    /// Runs `kernel` compiled for these instructions.
    #[inline]
    pub fn dispatch<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(simd) => enter(simd, kernel),
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(simd) => enter(simd, kernel),
            // SSE4.2 adds nothing here; one copy of the code serves both.
            #[cfg(target_arch = "x86_64")]
            level => match level.as_sse2() {
                Some(simd) => enter(simd, kernel),
                None => unreachable!("x86-64 has SSE2"),
            },
            #[cfg(target_arch = "aarch64")]
            Level::Neon(simd) => enter(simd, kernel),
            #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
            _ => fearless_simd::dispatch!(self.0, simd => enter(simd, kernel)),
        }
    }
}

impl Scalar for f64 {
    /// Enables the fused multiply-add instruction, where `mul_add` would otherwise be a call into the C library
    /// (which gives the same bits).
    #[inline(always)]
    fn enter<T>(work: impl FnOnce() -> T) -> T {
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = Level::new().as_avx2() {
            return simd.vectorize(work);
        }
        work()
    }
}

impl Scalar for Unfused {
    #[inline(always)]
    fn enter<T>(work: impl FnOnce() -> T) -> T {
        work()
    }
}

/// Calls `kernel` from a function in which the instructions of `S` are enabled.
#[inline(always)]
fn enter<S: Simd, K: Kernel>(simd: S, kernel: K) -> K::Output {
    simd.vectorize(
        #[inline(always)]
        || kernel.run(simd),
    )
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
