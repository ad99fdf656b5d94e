//! Random numbers that are reached in constant time: each dimension has streams of its own of the ChaCha8 generator.

use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};

/// A random number of the open interval from 0 to 1.
pub(super) fn coordinate(seed: u64, dimension: usize, index: u64) -> f64 {
    let mut generator = stream(seed, dimension, false);
    // In 32-bit words.
    generator.set_word_pos(2 * u128::from(index));
    // The middle of one of 2^52 intervals, so that neither end is met.
    ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}

/// A random key for a dimension.
pub(super) fn key(seed: u64, dimension: usize) -> u64 {
    stream(seed, dimension, true).next_u64()
}

fn stream(seed: u64, dimension: usize, is_key: bool) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(2 * dimension as u64 + u64::from(is_key));
    generator
}
