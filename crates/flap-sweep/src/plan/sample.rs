//! Samples of a design space: points that are spread over the design space at random or more evenly.
//!
//! [`SamplePoints`] are points in the unit cube, and a [`Distribution`] converts a coordinate to a value of a
//! parameter. Any point is computed in constant time and depends only on the seed and on the index of the
//! point.

use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};

pub use distribution::Distribution;
pub(crate) use distribution::quantile as normal_quantile;
use sobol::Sobol;

mod distribution;
mod sobol;
#[cfg(test)]
mod tests;

/// Method for spreading points over the unit cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Sobol' sequence with the direction numbers of Joe and Kuo. A hash of the digits scrambles the points
    /// (Owen scrambling).
    Sobol,
    /// Latin hypercube: along every dimension, each of `count` equal intervals contains one point at a random
    /// position.
    LatinHypercube,
    /// Independent random points.
    Random,
}

/// Points that are spread over the unit cube.
#[derive(Clone, Debug, PartialEq)]
pub struct SamplePoints {
    seed: u64,
    count: u64,
    kind: Kind,
}

/// Data with which each method computes coordinates, one item for each dimension.
#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Sobol(Vec<Sobol>),
    LatinHypercube(Vec<Permutation>),
    Random,
}

impl SamplePoints {
    /// Largest number of points: 2^32.
    pub const MAX_POINTS: u64 = 1 << 32;

    /// Largest number of dimensions.
    pub const MAX_DIMENSIONS: usize = sobol::DIRECTIONS.len() + 1;

    /// Returns `count` points in `dimensions` dimensions. `count` is at most [`SamplePoints::MAX_POINTS`],
    /// and `dimensions` is at most [`SamplePoints::MAX_DIMENSIONS`].
    pub fn new(method: Method, seed: u64, count: u64, dimensions: usize) -> SamplePoints {
        let kind = match method {
            Method::Sobol => Kind::Sobol((0..dimensions).map(|d| Sobol::new(d, key(seed, d))).collect()),
            Method::LatinHypercube => {
                let permutation = |d| Permutation::new(count, key(seed, d));
                Kind::LatinHypercube((0..dimensions).map(permutation).collect())
            }
            Method::Random => Kind::Random,
        };
        SamplePoints { seed, count, kind }
    }

    /// Returns the method that spreads the points.
    pub fn method(&self) -> Method {
        match self.kind {
            Kind::Sobol(_) => Method::Sobol,
            Kind::LatinHypercube(_) => Method::LatinHypercube,
            Kind::Random => Method::Random,
        }
    }

    /// Returns the seed of the random numbers.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Returns the number of points.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Returns the coordinate of a point along a dimension. The coordinate is more than 0 and less than 1.
    pub fn coordinate(&self, index: u64, dimension: usize) -> f64 {
        match &self.kind {
            Kind::Sobol(dimensions) => dimensions[dimension].coordinate(index),
            Kind::LatinHypercube(permutations) => {
                let interval = permutations[dimension].get(index) as f64;
                let within = coordinate(self.seed, dimension, index);
                // In the last interval the sum may be rounded up to 1.
                ((interval + within) / self.count as f64).min(1.0 - f64::EPSILON)
            }
            Kind::Random => coordinate(self.seed, dimension, index),
        }
    }
}

/// Returns a random number in the open interval from 0 to 1.
pub(crate) fn coordinate(seed: u64, dimension: usize, index: u64) -> f64 {
    let mut generator = stream(seed, dimension, false);
    // The position counts 32-bit words.
    generator.set_word_pos(2 * u128::from(index));
    // The middle of one of 2^52 intervals, which excludes both ends.
    ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

/// Returns a random number, which is used as the key for scrambling or permuting the points along a
/// dimension.
pub(super) fn key(seed: u64, dimension: usize) -> u64 {
    stream(seed, dimension, true).next_u64()
}

fn stream(seed: u64, dimension: usize, is_key: bool) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(2 * dimension as u64 + u64::from(is_key));
    generator
}

/// Number of rounds of the Feistel cipher. With a random key, four rounds give results like random
/// permutations, and two further rounds take negligible time.
const ROUNDS: u64 = 6;

/// A random permutation of the numbers from 0 to `count - 1`. The permutation is computed when it is needed,
/// and not stored.
///
/// A Feistel cipher permutes the numbers below N, where N is a power of four and at least `count`. If the
/// result is not below `count`, the cipher is applied again. After a few repetitions, the result is below
/// `count`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Permutation {
    count: u64,
    half_bits: u32,
    key: u64,
}

impl Permutation {
    /// Returns a permutation of the numbers from 0 to `count - 1`. Each `key` gives a fixed permutation.
    pub(super) fn new(count: u64, key: u64) -> Permutation {
        let bits = u64::BITS - count.saturating_sub(1).leading_zeros();
        Permutation { count, half_bits: bits.div_ceil(2).max(1), key }
    }

    /// Returns the number to which the permutation maps `index`, which must be less than `count`.
    pub(super) fn get(&self, index: u64) -> u64 {
        let mut number = self.once(index);
        while number >= self.count {
            number = self.once(number);
        }
        number
    }

    fn once(&self, number: u64) -> u64 {
        let mask = (1 << self.half_bits) - 1;
        let (mut left, mut right) = (number >> self.half_bits, number & mask);
        for round in 0..ROUNDS {
            let mixed = mix(self.key ^ mix(round << 32 ^ right));
            (left, right) = (right, left ^ (mixed & mask));
        }
        left << self.half_bits | right
    }
}

/// Applies the finaliser of SplitMix64 (Steele, Lea and Flood 2014) to `x`: each output bit depends on all input bits.
fn mix(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9E37_79B9_7F4A_7C15);
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}
