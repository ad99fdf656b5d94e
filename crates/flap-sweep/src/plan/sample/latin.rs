//! The interval that each point of a Latin hypercube takes.

/// Rounds of the cipher. Four make it as good as random, if the key is; two more cost nothing.
const ROUNDS: u64 = 6;

/// A random permutation of the numbers below `count` that is not stored.
///
/// A Feistel cipher permutes the numbers of so many bits, at least as many as needed and even; numbers that come out
/// too large go through it again, which leads back in a few times.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Permutation {
    count: u64,
    half_bits: u32,
    key: u64,
}

impl Permutation {
    /// The permutation of `count` numbers with this key.
    pub(super) fn new(count: u64, key: u64) -> Permutation {
        let bits = u64::BITS - count.saturating_sub(1).leading_zeros();
        Permutation { count, half_bits: bits.div_ceil(2).max(1), key }
    }

    /// The image of `index`, which must be less than `count`.
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

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): each bit depends on all.
fn mix(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9E37_79B9_7F4A_7C15);
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}
