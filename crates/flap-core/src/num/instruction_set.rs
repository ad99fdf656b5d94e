//! Which instructions this machine has, and how code is run with them.

use core::fmt;

use fearless_simd::Level;
#[cfg(target_arch = "aarch64")]
use fearless_simd::Neon;
#[cfg(target_arch = "x86_64")]
use fearless_simd::{Avx2, Sse2};

#[cfg(target_arch = "x86_64")]
use super::avx512::Avx512;
use super::{Scalar, Simd, Unfused};

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
pub struct InstructionSet(Proof);

/// Work that is generic over SIMD instructions.
pub trait Kernel {
    /// What the work results in.
    type Output;

    /// Does the work with the instructions of `S`. Mark implementations `#[inline(always)]`.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

#[derive(Clone, Copy, Debug)]
enum Proof {
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    #[cfg(target_arch = "x86_64")]
    Sse2(Sse2),
    #[cfg(target_arch = "aarch64")]
    Neon(Neon),
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    Other(Level),
}

impl InstructionSet {
    /// The best this machine has.
    pub fn best() -> InstructionSet {
        Self::available().swap_remove(0)
    }

    /// All that this machine has, best first.
    pub fn available() -> Vec<InstructionSet> {
        let level = Level::new();
        #[cfg(target_arch = "x86_64")]
        let proofs = [
            Avx512::detect().map(Proof::Avx512),
            level.as_avx2().map(Proof::Avx2),
            level.as_sse2().map(Proof::Sse2),
        ];
        #[cfg(target_arch = "aarch64")]
        let proofs = [level.as_neon().map(Proof::Neon)];
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        let proofs = [Some(Proof::Other(level))];
        proofs.into_iter().flatten().map(InstructionSet).collect()
    }

    /// The available set with this [name](InstructionSet::name).
    pub fn by_name(name: &str) -> Option<InstructionSet> {
        Self::available().into_iter().find(|set| set.name() == name)
    }

    /// The name in the provenance of a run: `avx512`, `avx2`, `sse2` or `neon`.
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Proof::Avx512(_) => "avx512",
            #[cfg(target_arch = "x86_64")]
            Proof::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Proof::Sse2(_) => "sse2",
            #[cfg(target_arch = "aarch64")]
            Proof::Neon(_) => "neon",
            #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
            Proof::Other(_) => "scalar",
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
            Proof::Avx512(simd) => enter(simd, kernel),
            #[cfg(target_arch = "x86_64")]
            Proof::Avx2(simd) => enter(simd, kernel),
            #[cfg(target_arch = "x86_64")]
            Proof::Sse2(simd) => enter(simd, kernel),
            #[cfg(target_arch = "aarch64")]
            Proof::Neon(simd) => enter(simd, kernel),
            #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
            Proof::Other(level) => fearless_simd::dispatch!(level, simd => enter(simd, kernel)),
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
            return Simd::vectorize(simd, work);
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
