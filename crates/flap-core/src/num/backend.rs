//! The backend of computations, and the one place that chooses between instructions and arithmetics.

use core::fmt;

use fearless_simd::Level;
#[cfg(target_arch = "aarch64")]
use fearless_simd::Neon;
#[cfg(target_arch = "x86_64")]
use fearless_simd::{Avx2, Sse2};

#[cfg(target_arch = "x86_64")]
use super::avx512::Avx512;
use super::register::Instructions;
use super::{Lanes, Scalar, Simd, Unfused, Vector};

/// The rounding of `mul_add`: once or twice. Results are equal to the last bit within a class.
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

/// Computing hardware of this machine: its processor with one set of SIMD instructions.
///
/// Whoever starts a computation asks for a backend once, with [`Backend::best`] or [`Backend::by_name`], and hands it on.
/// Work that is generic over numbers then runs on its lanes ([`Backend::dispatch`]), or on scalars of its
/// [`Arithmetic`] with the same bits.
#[derive(Clone, Copy, Debug)]
pub struct Backend(Proof);

/// Work that is generic over SIMD instructions.
pub trait Kernel {
    /// The result of the work.
    type Output;

    /// Does the work with the instructions of `S`. Mark implementations `#[inline(always)]`.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

/// Work on one number at a time, generic over its arithmetic.
pub(crate) trait ScalarKernel {
    /// The result of the work.
    type Output;

    /// Does the work with the scalar `R`: `f64` or [`Unfused`].
    fn run<R: Scalar>(self) -> Self::Output;
}

/// Proof that the processor has the instructions of a backend.
#[derive(Clone, Copy, Debug)]
enum Proof {
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
    #[cfg(target_arch = "x86_64")]
    Avx2(Instructions<Avx2>),
    #[cfg(target_arch = "x86_64")]
    Sse2(Instructions<Sse2>),
    #[cfg(target_arch = "aarch64")]
    Neon(Instructions<Neon>),
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    Other(Level),
}

impl Backend {
    /// The fastest of this machine.
    pub fn best() -> Backend {
        Self::available().swap_remove(0)
    }

    /// All backends of this machine, the fastest first.
    pub fn available() -> Vec<Backend> {
        let level = Level::new();
        #[cfg(target_arch = "x86_64")]
        let proofs = [
            Avx512::detect().map(Proof::Avx512),
            level.as_avx2().map(Instructions).map(Proof::Avx2),
            level.as_sse2().map(Instructions).map(Proof::Sse2),
        ];
        #[cfg(target_arch = "aarch64")]
        let proofs = [level.as_neon().map(Instructions).map(Proof::Neon)];
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        let proofs = [Some(Proof::Other(level))];
        proofs.into_iter().flatten().map(Backend).collect()
    }

    /// The available backend with this [name](Backend::name).
    pub fn by_name(name: &str) -> Option<Backend> {
        Self::available().into_iter().find(|backend| backend.name() == name)
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
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Proof::Avx512(_) | Proof::Avx2(_) => Arithmetic::Fused,
            #[cfg(target_arch = "x86_64")]
            Proof::Sse2(_) => Arithmetic::Unfused,
            #[cfg(target_arch = "aarch64")]
            Proof::Neon(_) => Arithmetic::Fused,
            #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
            Proof::Other(_) => Arithmetic::Unfused,
        }
    }

    /// The number of SIMD lanes: two registers of `f64`.
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

    /// Runs `kernel` on scalars of this backend's arithmetic.
    pub(crate) fn dispatch_scalar<K: ScalarKernel>(self, kernel: K) -> K::Output {
        match self.arithmetic() {
            Arithmetic::Fused => kernel.run::<f64>(),
            Arithmetic::Unfused => kernel.run::<Unfused>(),
        }
    }

    /// Runs `kernel` on SIMD lanes, compiled for this backend's instructions.
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
            Proof::Other(level) => fearless_simd::dispatch!(level, simd => enter(Instructions(simd), kernel)),
        }
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

impl fmt::Display for Backend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
