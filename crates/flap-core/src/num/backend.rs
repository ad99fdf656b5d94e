//! Backends of the computations. A backend is a set of SIMD instructions with its arithmetic.

use core::fmt;

#[cfg(target_arch = "x86_64")]
use fearless_simd::{Avx2, Level};
#[cfg(target_arch = "aarch64")]
use fearless_simd::{Level, Neon};

#[cfg(target_arch = "x86_64")]
use super::avx512::Avx512;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
use super::register::Instructions;
use super::{Lanes, OneLane, Simd, Unfused, Vector};

/// Arithmetic class of a backend: `mul_add` rounds its result either once or twice. Two backends of the same
/// class compute results that are equal to the last bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// Fused multiply-add, which rounds once: AVX2, AVX-512, NEON.
    Fused,
    /// Separate multiplication and addition, which round twice, for processors without a fused multiply-add.
    Unfused,
}

impl Arithmetic {
    /// Returns the name of the arithmetic class, which is also in the sidecar of a sweep.
    pub fn name(self) -> &'static str {
        match self {
            Arithmetic::Fused => "fma",
            Arithmetic::Unfused => "no-fma",
        }
    }
}

/// A set of SIMD instructions of this machine's processor, or arithmetic on scalars without SIMD.
///
/// Choose a backend once at the beginning of a computation, with [`Backend::best`] or [`Backend::by_name`],
/// and pass the backend to all functions that need it. Code that is generic over the number type can run on
/// the lanes of the backend ([`Backend::dispatch`]), or on scalars with the same [`Arithmetic`]. The results
/// on lanes and on scalars are equal to the last bit.
#[derive(Clone, Copy, Debug)]
pub struct Backend {
    name: &'static str,
    arithmetic: Arithmetic,
    proof: Proof,
}

/// A computation that is generic over SIMD instructions.
pub trait Kernel {
    /// Result of the computation.
    type Output;

    /// Runs the computation with the SIMD instructions of the type `S`. Write `#[inline(always)]` before the
    /// implementation of this function.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

/// Proof that the processor has the instructions of a backend. Code can create this value only after a check
/// of the processor.
#[derive(Clone, Copy, Debug)]
enum Proof {
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
    #[cfg(target_arch = "x86_64")]
    Avx2(Instructions<Avx2>),
    #[cfg(target_arch = "aarch64")]
    Neon(Instructions<Neon>),
    Scalar,
}

impl Backend {
    /// Returns the fastest backend of this machine.
    pub fn best() -> Backend {
        Self::available().swap_remove(0)
    }

    /// Returns all backends of this machine, beginning with the fastest backend.
    pub fn available() -> Vec<Backend> {
        let proofs = [
            #[cfg(target_arch = "x86_64")]
            ("avx512", Arithmetic::Fused, Avx512::detect().map(Proof::Avx512)),
            #[cfg(target_arch = "x86_64")]
            ("avx2", Arithmetic::Fused, Level::new().as_avx2().map(Instructions).map(Proof::Avx2)),
            #[cfg(target_arch = "aarch64")]
            ("neon", Arithmetic::Fused, Level::new().as_neon().map(Instructions).map(Proof::Neon)),
            ("scalar", Arithmetic::Unfused, Some(Proof::Scalar)),
        ];
        let backend = |(name, arithmetic, proof): (_, _, Option<_>)| {
            proof.map(|proof| Backend { name, arithmetic, proof })
        };
        proofs.into_iter().filter_map(backend).collect()
    }

    /// Returns the backend with the given [name](Backend::name). The result is `None` if this machine does
    /// not have the backend.
    pub fn by_name(name: &str) -> Option<Backend> {
        Self::available().into_iter().find(|backend| backend.name() == name)
    }

    /// Returns the name of the backend, which is `avx512`, `avx2`, `neon` or `scalar`. The sidecar of a sweep
    /// contains the name of the backend.
    pub fn name(self) -> &'static str {
        self.name
    }

    /// Returns the arithmetic class of the backend.
    pub fn arithmetic(self) -> Arithmetic {
        self.arithmetic
    }

    /// Returns the number of lanes of the backend. The number of lanes is the number of `f64` in two
    /// registers, or 1 for the backend `scalar`.
    pub fn lanes(self) -> usize {
        struct Count;

        impl Kernel for Count {
            type Output = usize;

            #[inline(always)]
            fn run<S: Simd>(self, _simd: S) -> usize {
                Vector::<S>::LANES
            }
        }

        self.dispatch(Count)
    }

    /// Runs `kernel` on SIMD lanes, compiled for the instructions of this backend.
    #[inline]
    pub fn dispatch<K: Kernel>(self, kernel: K) -> K::Output {
        match self.proof {
            #[cfg(target_arch = "x86_64")]
            Proof::Avx512(simd) => enter(simd, kernel),
            #[cfg(target_arch = "x86_64")]
            Proof::Avx2(simd) => enter(simd, kernel),
            #[cfg(target_arch = "aarch64")]
            Proof::Neon(simd) => enter(simd, kernel),
            Proof::Scalar => enter(OneLane::<Unfused>::new(), kernel),
        }
    }
}

/// Calls `kernel` in a function that the compiler translates into the SIMD instructions of the type `S`.
#[inline(always)]
fn enter<S: Simd, K: Kernel>(simd: S, kernel: K) -> K::Output {
    simd.vectorize(
        #[inline(always)]
        || kernel.run(simd),
    )
}

impl fmt::Display for Backend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
